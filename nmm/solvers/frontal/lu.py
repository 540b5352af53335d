"""Multifrontal LU factorisation in compiled code, kept only where its answers are good."""

from dataclasses import dataclass
from functools import lru_cache
from typing import ClassVar

import numpy as np
from scipy.sparse import csc_array

from integration.arrays import Floats
from nmm.solvers.factor import Decomposition
from nmm.solvers.frontal.frontal_factor import FrontalFactor
from nmm.solvers.frontal.ordering import orders
from nmm.solvers.frontal.symbolic import any_plan
from nmm.solvers.libraries.superlu import DefiniteSolver, SuperLU
from nmm.solvers.linear import sorted_rows
from nmm.solvers.unchecked import product

TRUSTED = 1e-5
"""Largest residual of a load of ones of either sign. On contact problems SuperLU leaves as much
as the fronts do, 1e-11 to 4e-7, and 1e-6 to 7e-6 where a shift holds functions that depend on one
another; each turn of refinement takes off that part of what is left."""
ROUGH = 1e-2
"""The same in single precision: the next step of an iteration has what is left of this one. On
slopes and walls the interior point leaves 5e-6 to 2e-3."""


@dataclass(frozen=True)
class FrontalLU(DefiniteSolver):
    """``A = L U`` by dense fronts (Duff, Reid 1984), pivots searched within a front's own block.

    For matrices whose pattern is nearly symmetric and whose diagonal blocks are good pivots. Each
    factor is tried on one load; a matrix it does not serve is left to SuperLU, which searches
    pivots farther. On walls of bricks a factorisation takes a third of SuperLU's time once the
    pattern is known (benchmark `benchmarks/bench_contact.py`).
    """

    name: ClassVar[str] = "lu"

    def decompose(self, matrix: csc_array) -> Decomposition:
        """Factorise a scaled matrix; `RankDeficientError` at a zero pivot."""
        matrix = sorted_rows(matrix)
        found = FrontalFactor.lu(matrix, any_plan(matrix))
        if found is not None and _residual(matrix, found) <= TRUSTED:
            return found
        return SuperLU(self.refinements, self.shift).unsymmetric().decompose(matrix)

    def describe(self, unknowns: int) -> str:
        return f"{self.name} with orders of {orders()}"

    def unsymmetric(self) -> "FrontalLU":
        """Return this solver: it is for such matrices."""
        return self

    def rough(self) -> "RoughLU":
        """Return the solver in single precision."""
        return RoughLU(self.refinements, self.shift)


@dataclass(frozen=True)
class RoughLU(FrontalLU):
    """The same in single precision, double where that leaves too much.

    Fronts take 0.6 of their time, and solutions too: half as many bytes, and twice as many numbers
    in a vector.
    """

    def decompose(self, matrix: csc_array) -> Decomposition:
        """Factorise a scaled matrix; `RankDeficientError` at a zero pivot."""
        matrix = sorted_rows(matrix)
        found = FrontalFactor.lu(matrix, any_plan(matrix), single=True)
        if found is not None and _residual(matrix, found) <= ROUGH:
            return found
        return super().decompose(matrix)


def _residual(matrix: csc_array, found: Decomposition) -> float:
    """Largest residual of a load of ones of either sign; above nothing for what is no number."""
    load = _ones(matrix.shape[0])
    return float(np.abs(load - product(matrix, found.solve(load))).max())


@lru_cache(maxsize=4)
def _ones(n: int) -> Floats:
    return np.random.default_rng(0).choice([-1.0, 1.0], size=n)
