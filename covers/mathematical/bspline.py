"""Tensor-product B-spline covers: smooth weights on boxes of knot spans."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Self

import numpy as np
import numpy.typing as npt

from covers.mathematical.polynomial_cover import PolynomialCover
from covers.mathematical.regular_grids import grid_cells, grid_vertices, regular_net
from covers.small_matrices import inverses
from integration.arrays import Floats
from integration.monomials import count, multiply


@dataclass(frozen=True, eq=False)
class BSplines(PolynomialCover):
    """Products of uniform B-splines of degree ``order``, ``order - 1`` times differentiable.

    Cells are knot spans; ``(order + 1)^2`` patches of ``(order + 1)^2`` spans are active in each.
    Order 2 with constant local functions has continuous strains.
    """

    order: int

    @property
    def precision(self) -> int:
        """All polynomials up to the degree of the splines."""
        return self.order

    @classmethod
    def regular(
        cls,
        bounds: npt.ArrayLike,
        size: float | tuple[float, float],
        *,
        degree: int = 2,
        angle: float = 0.0,
        shift: tuple[float, float] = (0.0, 0.0),
    ) -> Self:
        """Return uniform splines over a box; patches reach beyond it on all sides.

        Parameters
        ----------
        bounds : (2, 2)
            lower and upper corner of the box, m.
        size
            edge of a knot span, or its two edges, m.
        degree : int
            degree of the splines, 1 to 5.
        angle, shift
            rotation of the grid, rad, and its shift in fractions of the edges.

        Raises
        ------
        ValueError
            The degree is out of range.
        """
        if degree not in range(1, 6):
            raise ValueError(
                f"bspline: degree = {degree}: expected 1 to 5: 2 gives continuous strains"
            )
        edges = np.broadcast_to(np.asarray(size, dtype=float), 2)
        net = regular_net(bounds, (edges[0], edges[1]), angle, shift)
        vertices, cells = grid_vertices(net), grid_cells(net.columns, net.rows)
        across = net.columns + degree
        i, j = np.meshgrid(np.arange(net.columns), np.arange(net.rows))
        a, b = np.meshgrid(np.arange(degree + 1), np.arange(degree + 1))
        patches = (i + j * across).reshape(-1, 1) + (a + b * across).reshape(1, -1)
        middle = (1 - degree) / 2
        i, j = np.meshgrid(np.arange(across), np.arange(net.rows + degree))
        centre = net.points(i.ravel() + middle, j.ravel() + middle)
        return cls(
            vertices=vertices,
            cell_vertices=cells,
            cell_patches=patches,
            patch_centre=centre,
            patch_size=np.full(len(centre), (degree + 1) / 2 * np.hypot(*edges)),
            cell_shape=np.zeros(len(cells), dtype=np.int64),
            cell_origin=vertices[cells[:, 0]],
            cell_matrix=np.broadcast_to(inverses(net.axes.T), (len(cells), 2, 2)),
            table=_tensor_table(degree),
            degree=2 * degree,
            order=degree,
        )


@cache
def _tensor_table(degree: int) -> Floats:
    """Coefficients ((degree + 1)^2, K(2 degree)) of the products on the unit square."""
    pieces = cardinal_pieces(degree)
    powers = np.arange(degree + 1)
    along = np.zeros((len(pieces), count(degree)))
    across = along.copy()
    along[:, powers * (powers + 1) // 2] = pieces
    across[:, powers * (powers + 1) // 2 + powers] = pieces
    return multiply(along[None], degree, across[:, None], degree).reshape(len(pieces) ** 2, -1)


def cardinal_pieces(degree: int) -> Floats:
    """Coefficients (degree + 1, degree + 1) in t on [0, 1] of the splines active in a span.

    Row ``a`` is the spline that begins ``degree - a`` spans before, column ``p`` the factor of t^p.
    The recursion of Cox and de Boor for knots at the integers (de Boor 1978, X).
    """
    pieces = np.ones((1, 1))
    for k in range(1, degree + 1):
        lower = np.zeros((k + 2, k + 1))
        lower[1:-1, :-1] = pieces
        # Piece m of degree k from pieces m and m - 1 of degree k - 1, m = k - a.
        m = np.arange(k, -1, -1)[:, None]
        same, earlier = lower[:-1], lower[1:]
        shifted = np.pad(same - earlier, ((0, 0), (1, 0)))[:, :-1]
        pieces = (m * same + (k + 1 - m) * earlier + shifted) / k
    return pieces
