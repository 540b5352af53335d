"""The solver that costs least: chosen by size and by what is imported already."""

import sys
from dataclasses import dataclass
from typing import ClassVar

from scipy.sparse import csc_array

from nmm.solvers.linear import Decomposition, LinearSolver
from nmm.solvers.superlu import SuperLU

FEW, MANY = 60, 20000
"""Unknowns below which, and from which on, compiled code never or always pays."""


@dataclass(frozen=True)
class Auto(LinearSolver):
    """Cholesky's factorisation where compiled code is at hand or pays its import, else SuperLU."""

    name: ClassVar[str] = "auto"

    def decompose(self, matrix: csc_array) -> Decomposition:
        """Factorise a scaled matrix; `RankDeficientError` at a zero pivot."""
        if _compiled(matrix):
            from nmm.solvers.frontal.cholesky import Cholesky

            return Cholesky(self.refinements, self.shift).decompose(matrix)
        return SuperLU(self.refinements, self.shift).decompose(matrix)

    def indefinite(self) -> SuperLU:
        """SuperLU, which searches pivots."""
        return SuperLU(self.refinements, self.shift).indefinite()

    def unsymmetric(self) -> "AutoLU":
        """LU on the fronts of Cholesky's factorisation where that is taken, refined twice."""
        return AutoLU(max(self.refinements, 2), self.shift)


@dataclass(frozen=True)
class AutoLU(LinearSolver):
    """LU in compiled code where it is at hand or pays its import, else SuperLU."""

    name: ClassVar[str] = "auto"

    def decompose(self, matrix: csc_array) -> Decomposition:
        """Factorise a scaled matrix; `RankDeficientError` at a zero pivot."""
        if _compiled(matrix):
            from nmm.solvers.frontal.lu import FrontalLU

            return FrontalLU(self.refinements, self.shift).decompose(matrix)
        return SuperLU(self.refinements, self.shift).unsymmetric().decompose(matrix)

    def indefinite(self) -> SuperLU:
        """SuperLU, which searches pivots."""
        return SuperLU(self.refinements, self.shift).indefinite()

    def unsymmetric(self) -> "AutoLU":
        """Return this solver: it is for such matrices."""
        return self


def _compiled(matrix: csc_array) -> bool:
    n = matrix.shape[0]
    return bool(n >= MANY or (n >= FEW and "numba" in sys.modules))
