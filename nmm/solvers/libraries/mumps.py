"""MUMPS, a multifrontal solver in Fortran, where the package python-mumps is installed."""

from dataclasses import dataclass, replace
from typing import Any, ClassVar

import numpy as np
from scipy.sparse import coo_matrix, csc_array

from integration.arrays import Floats
from nmm.solvers.factor import Decomposition, RankDeficientError
from nmm.solvers.libraries.optional import MUMPS
from nmm.solvers.libraries.superlu import PivotingSolver


@dataclass(frozen=True)
class MumpsFactor:
    """Factors that MUMPS keeps."""

    context: Any

    def solve(self, rhs: Floats) -> Floats:
        """Return the solution of one right-hand side."""
        return np.asarray(self.context.solve(np.ascontiguousarray(rhs, dtype=np.float64)))


@dataclass(frozen=True)
class Mumps(PivotingSolver):
    """``A = L D L^T``, or ``L U`` of what is not symmetric (Amestoy et al. 2001), pivots searched.

    Attributes
    ----------
    pivot_threshold
        A diagonal pivot is kept when it is at least this part (-) of the largest entry of its
        column.
    symmetric
        Whether the upper triangle stands for the whole matrix.
    """

    name: ClassVar[str] = "mumps"
    pivot_threshold: float = 0.01
    symmetric: bool = True

    def decompose(self, matrix: csc_array) -> Decomposition:
        """Factorise a scaled matrix; `RankDeficientError` where it is singular."""
        mumps = MUMPS.load(self.name)
        context = mumps.Context()
        context.set_matrix(coo_matrix(matrix), symmetric=self.symmetric)
        try:
            context.factor(pivot_tol=self.pivot_threshold)
        except mumps.MUMPSError as fault:
            raise RankDeficientError(str(fault)) from fault
        return MumpsFactor(context)

    def indefinite(self) -> "Mumps":
        """Equilibrated and refined twice."""
        return replace(self, equilibrate=True, refinements=max(self.refinements, 2))

    def unsymmetric(self) -> "Mumps":
        """Both triangles, refined twice."""
        return replace(self, symmetric=False, refinements=max(self.refinements, 2))
