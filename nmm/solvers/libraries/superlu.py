"""SuperLU of scipy with settings for symmetric matrices; always available."""

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from integration.arrays import Floats
from integration.sparse import csc_array
from nmm.solvers.factor import RankDeficientError
from nmm.solvers.linear import LinearSolver
from nmm.solvers.saddle import equilibrated_scale

if TYPE_CHECKING:
    from scipy.sparse.linalg import SuperLU as Decomposed


@dataclass(frozen=True)
class PivotingSolver(LinearSolver):
    """Base of solvers that search pivots, for matrices whose diagonals may vanish as well.

    Attributes
    ----------
    equilibrate
        Scale by the largest entries of rows and columns instead of the diagonal.
    """

    equilibrate: bool = field(default=False, kw_only=True)

    def scaling(self, matrix: csc_array) -> Floats:
        """By the diagonal, or by the largest entries where diagonals may vanish."""
        return equilibrated_scale(matrix) if self.equilibrate else super().scaling(matrix)


@dataclass(frozen=True)
class SuperLU(PivotingSolver):
    """Sparse LU (Demmel et al. 1999) on the pattern of ``A + A^T``, pivots from the diagonal.

    Attributes
    ----------
    pivot_threshold
        A diagonal pivot is kept when it is at least this part of the largest entry of its
        column: 0 for positive definite matrices (no search, symmetric fill), 0.1 for indefinite
        ones.
    """

    name: ClassVar[str] = "superlu"
    pivot_threshold: float = 0.0

    def decompose(self, matrix: csc_array) -> "Decomposed":
        """Factorise; `RankDeficientError` at a zero pivot."""
        from scipy.sparse.linalg import splu

        indices = matrix.indices.astype(np.intc, copy=False)
        indptr = matrix.indptr.astype(np.intc, copy=False)
        try:
            return splu(
                csc_array((matrix.data, indices, indptr), shape=matrix.shape),
                permc_spec="MMD_AT_PLUS_A",
                diag_pivot_thresh=self.pivot_threshold,
                options={"SymmetricMode": True},
            )
        except RuntimeError as fault:
            # SuperLU reports a zero pivot, or trips over the supernode that holds it.
            raise RankDeficientError(str(fault)) from fault

    def indefinite(self) -> "SuperLU":
        """Equilibrated, pivots within a factor 10 of the largest entry, refined twice."""
        return replace(self.unsymmetric(), equilibrate=True)

    def unsymmetric(self) -> "SuperLU":
        """Pivots within a factor 10 of the largest entry, refined twice."""
        return replace(self, pivot_threshold=0.1, refinements=max(self.refinements, 2))


@dataclass(frozen=True)
class DefiniteSolver(LinearSolver):
    """Base of solvers without a search of pivots: SuperLU takes the matrices that need one."""

    def indefinite(self) -> LinearSolver:
        """SuperLU, which searches pivots."""
        return SuperLU(self.refinements, self.shift).indefinite()

    def unsymmetric(self) -> LinearSolver:
        """SuperLU, unless the solver has factors of its own for such matrices."""
        return SuperLU(self.refinements, self.shift).unsymmetric()
