"""Triangular covers: hat weights on the stars of nodes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Self

import numpy as np
import numpy.typing as npt

from covers.mathematical.polynomial_cover import PolynomialCover
from covers.mathematical.regular_grids import regular_net
from covers.mathematical.stars import counter_clockwise, star_sizes
from integration.arrays import Floats, Ints

if TYPE_CHECKING:
    from skfem import MeshTri

HATS = np.array([[1.0, -1.0, -1.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])


class Triangles(PolynomialCover):
    """Patches are the stars of nodes, weights the linear hats; three patches in a cell."""

    @property
    def precision(self) -> int:
        """Linear polynomials."""
        return 1

    @classmethod
    def regular(
        cls,
        bounds: npt.ArrayLike,
        size: float,
        *,
        angle: float = 0.0,
        shift: tuple[float, float] = (0.0, 0.0),
    ) -> Self:
        """Return Shi's net of equilateral triangles over a box (Shi 1991): hexagonal patches.

        Rows are ``size sqrt(3) / 2`` apart, odd rows moved by half an edge.

        Parameters
        ----------
        bounds : (2, 2)
            lower and upper corner of the box, m.
        size : float
            edge of a triangle, m.
        angle, shift
            turn of the net, rad, and its displacement in fractions of an edge and of two rows.
        """
        net = regular_net(bounds, (size, size * np.sqrt(3.0)), angle, shift)
        columns, rows = net.columns, 2 * net.rows
        i, j = np.meshgrid(np.arange(columns + 2), np.arange(rows + 1))
        vertices = net.points((i - 0.5 * (j % 2)).ravel(), (j / 2).ravel())
        cells, shapes = _rows_of_triangles(columns, rows)
        return cls._of(vertices, cells, np.full(len(vertices), float(size)), shapes)

    @classmethod
    def from_mesh(cls, mesh: MeshTri) -> Self:
        """Return the cover on a scikit-fem mesh of triangles."""
        vertices = np.ascontiguousarray(mesh.p.T, dtype=float)
        cells = counter_clockwise(vertices, np.ascontiguousarray(mesh.t.T, dtype=np.int64))
        shapes = np.full(len(cells), -1, dtype=np.int64)
        return cls._of(vertices, cells, star_sizes(vertices, cells), shapes)

    @classmethod
    def _of(cls, vertices: Floats, cells: Ints, sizes: Floats, shapes: Ints) -> Self:
        return cls._of_stars(vertices, cells, sizes, shapes, HATS, 1)


def _rows_of_triangles(columns: int, rows: int) -> tuple[Ints, Ints]:
    """Corners of the triangles between rows of ``columns + 2`` nodes; 0 points up, 1 down."""
    i, j = np.meshgrid(np.arange(columns + 1), np.arange(rows))
    below = (i + j * (columns + 2)).ravel()
    above = below + columns + 2
    odd = (j % 2).ravel()
    up = np.stack([below, below + 1, above + 1 - odd], axis=1)
    down = np.stack([below + odd, above + 1, above], axis=1)
    cells = np.stack([up, down], axis=1).reshape(-1, 3)
    return cells, np.tile(np.arange(2), len(up))
