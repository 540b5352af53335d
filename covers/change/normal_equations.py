"""Normal equations of least squares, which are singular for linearly dependent functions."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from integration.arrays import Floats
from integration.sparse import csc_array, diags_array, eye_array

# Regularisation of a matrix of unit diagonal: far below its eigenvalues of independent functions,
# and removed by iterative refinement.
SHIFT = 1e-12
# Largest number of refinements, which end when the correction no longer falls by half.
REFINEMENTS = 40


@dataclass(frozen=True)
class NormalEquations:
    """A positive semidefinite matrix (n, n); right-hand sides lie in its range."""

    matrix: csc_array

    @cached_property
    def _scale(self) -> Floats:
        diagonal = self.matrix.diagonal()
        return np.asarray(1 / np.sqrt(np.where(diagonal > 0, diagonal, 1.0)))

    @cached_property
    def _factor(self) -> Any:
        from scipy.sparse.linalg import splu

        scale = diags_array(self._scale)
        matrix = scale @ self.matrix @ scale
        empty = diags_array((self.matrix.diagonal() <= 0).astype(float))
        shifted = csc_array(matrix + empty + SHIFT * eye_array(matrix.shape[0]))
        return splu(shifted, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0)

    def solve(self, side: Floats) -> Floats:
        """Solve for one right-hand side (n,)."""
        return self.iterated(self.matrix, side, np.zeros_like(side), lambda found: found)

    def iterated(
        self,
        matrix: csc_array,
        side: Floats,
        start: Floats,
        kept: Callable[[Floats], Floats],
    ) -> Floats:
        """Solve ``matrix @ x = side`` iteratively from ``start``, preconditioned by this matrix.

        ``kept`` removes from each correction the part that must stay as in ``start``.
        """
        found, last = start, np.inf
        for _ in range(REFINEMENTS):
            change = kept(self._once(side - matrix @ found))
            size = float(np.linalg.norm(change / self._scale))
            if not size < last / 2:
                break
            found, last = found + change, size
        return found

    def _once(self, side: Floats) -> Floats:
        return np.asarray(self._scale * self._factor.solve(self._scale * side))
