"""Dense factors of a few unknowns: LAPACK's LU, where sparse ones cost more to set up."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
import numpy.typing as npt

from integration.arrays import Floats
from integration.sparse import csc_array
from nmm.solvers.factor import RankDeficientError
from nmm.solvers.linear import LinearSolver


@dataclass(frozen=True)
class Factors:
    """Both triangles in one array, and the rows that were exchanged."""

    triangles: Floats
    exchanged: npt.NDArray[np.int32]

    def solve(self, rhs: Floats) -> Floats:
        """Return the solution of one right-hand side (n,) or of several (n, k)."""
        from scipy.linalg.lapack import dgetrs

        found, _ = dgetrs(self.triangles, self.exchanged, rhs)
        return np.asarray(found)


@dataclass(frozen=True)
class Dense(LinearSolver):
    """``P A = L U`` of the full matrix, pivots from whole columns: for any nonsingular one."""

    name: ClassVar[str] = "dense"

    def decompose(self, matrix: csc_array) -> Factors:
        """Factorise; `RankDeficientError` at a zero pivot."""
        from scipy.linalg.lapack import dgetrf

        triangles, exchanged, bad = dgetrf(matrix.toarray(order="F"), overwrite_a=True)
        if bad > 0:
            raise RankDeficientError(f"the pivot in place {bad} is zero")
        return Factors(triangles, exchanged)
