"""Covers of convex quadrilaterals: isoparametric bilinear weights, rational in space."""

from __future__ import annotations

import numpy as np

from covers.mathematical.base import Cover
from covers.small_matrices import inverses
from integration.arrays import Floats, Ints

NEWTON_PASSES = 30
PRECISION = 1e-14


class DistortedQuads(Cover):
    """Patches are the stars of nodes; weights are bilinear in the reference square of each cell.

    Points are mapped to the reference square by Newton's method, which needs convex cells
    (`Quads.from_mesh` refuses others).
    """

    @property
    def precision(self) -> int:
        """Linear polynomials."""
        return 1

    def evaluate(self, cells: Ints, points: Floats) -> tuple[Floats, Floats]:
        """Weights (m, 4) and gradients (m, 4, 2), 1/m.

        Raises
        ------
        ValueError
            A point is so far outside its cell that it has no reference coordinates.
        """
        corners = self.vertices[self.cell_vertices[cells]]
        xi = _to_reference(corners, points)
        slopes = _slopes(xi)
        jacobian = np.einsum("mkj,mki->mij", slopes, corners)
        return _bilinear(xi), np.einsum("mki,mij->mkj", slopes, inverses(jacobian))


def _bilinear(xi: Floats) -> Floats:
    x, y = xi.T
    return np.stack([(1 - x) * (1 - y), x * (1 - y), x * y, (1 - x) * y], axis=1)


def _slopes(xi: Floats) -> Floats:
    """Derivatives (m, 4, 2) of the bilinear weights in the reference square."""
    x, y = xi.T
    along = np.stack([y - 1, 1 - y, y, -y], axis=1)
    across = np.stack([x - 1, -x, x, 1 - x], axis=1)
    return np.stack([along, across], axis=2)


def _to_reference(corners: Floats, points: Floats) -> Floats:
    """Reference coordinates (m, 2) of points in quadrilaterals (m, 4, 2)."""
    xi = np.full(points.shape, 0.5)
    size = np.ptp(corners, axis=1).max(axis=1, initial=0.0)
    far = np.zeros(len(points), dtype=bool)
    for _ in range(NEWTON_PASSES):  # for all points at once
        miss = points - np.einsum("mk,mki->mi", _bilinear(xi), corners)
        far = ~(np.abs(miss).max(axis=1, initial=0.0) <= PRECISION * size)
        jacobian = np.einsum("mkj,mki->mij", _slopes(xi), corners)
        step = np.einsum("mij,mj->mi", inverses(jacobian), miss)
        if not far.any():
            return xi + np.where(np.isfinite(step), step, 0.0)
        xi = np.clip(np.where(np.isfinite(step), xi + step, xi), -1.0, 2.0)
    row = int(np.flatnonzero(far)[0])
    raise ValueError(
        f"point {points[row].tolist()}: no place in its cell {corners[row].tolist()}: "
        "a point in or near the cell expected: pass the cell that holds the point"
    )
