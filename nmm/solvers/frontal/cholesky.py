"""Multifrontal Cholesky factorisation in compiled code, the order kept while the pattern stands."""

from dataclasses import dataclass
from typing import ClassVar

from scipy.sparse import csc_array

from nmm.solvers.factor import Decomposition
from nmm.solvers.frontal.frontal_factor import FrontalFactor
from nmm.solvers.frontal.lu import FrontalLU
from nmm.solvers.frontal.ordering import orders
from nmm.solvers.frontal.symbolic import symmetric_plan
from nmm.solvers.libraries.superlu import DefiniteSolver, SuperLU
from nmm.solvers.linear import sorted_rows


@dataclass(frozen=True)
class Cholesky(DefiniteSolver):
    """``A = L L^T`` by dense fronts (Duff, Reid 1983; LAPACK within a front).

    A matrix that is not positive definite is left to `FrontalLU`, one that is not symmetric to
    rounding to SuperLU. On walls of bricks a factorisation takes a fifth of SuperLU's time once
    the pattern is known (benchmark `benchmarks/bench_contact.py`).
    """

    name: ClassVar[str] = "cholesky"

    def decompose(self, matrix: csc_array) -> Decomposition:
        """Factorise a scaled matrix; `RankDeficientError` at a zero pivot."""
        matrix = sorted_rows(matrix)
        plan = symmetric_plan(matrix)
        if plan is None:
            return SuperLU(self.refinements, self.shift).decompose(matrix)
        found = FrontalFactor.cholesky(matrix, plan)
        return self.unsymmetric().decompose(matrix) if found is None else found

    def describe(self, unknowns: int) -> str:
        return f"{self.name} with orders of {orders()}"

    def unsymmetric(self) -> FrontalLU:
        """LU on the same fronts, refined twice."""
        return FrontalLU(max(self.refinements, 2), self.shift)
