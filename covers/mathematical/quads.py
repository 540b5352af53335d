"""Covers of rectangles and parallelograms: bilinear weights on the stars of nodes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Self

import numpy as np
import numpy.typing as npt

from covers.mathematical.polynomial_cover import PolynomialCover
from covers.mathematical.regular_grids import grid_cells, grid_vertices, regular_net
from covers.mathematical.stars import counter_clockwise, star_sizes
from integration.arrays import Floats, Ints

if TYPE_CHECKING:
    from skfem import MeshQuad

    from covers.mathematical.distorted_quads import DistortedQuads

# (1 - x)(1 - y), x (1 - y), x y, (1 - x) y over 1, x, y, x2, xy, y2.
BILINEAR = np.array(
    [
        [1.0, -1.0, -1.0, 0.0, 1.0, 0.0],
        [0.0, 1.0, 0.0, 0.0, -1.0, 0.0],
        [0.0, 0.0, 0.0, 0.0, 1.0, 0.0],
        [0.0, 0.0, 1.0, 0.0, -1.0, 0.0],
    ]
)
PARALLEL = 1e-13


class Quads(PolynomialCover):
    """Patches are the stars of nodes, weights the bilinear hats; four patches in a cell.

    With local functions of degree 1 and more the unknowns are linearly dependent on regular grids
    in a number that grows with the mesh (`covers.approximation.dependence`); triangles do not have
    that defect.
    """

    @property
    def precision(self) -> int:
        """Linear polynomials."""
        return 1

    @classmethod
    def regular(
        cls,
        bounds: npt.ArrayLike,
        size: float | tuple[float, float],
        *,
        angle: float = 0.0,
        shift: tuple[float, float] = (0.0, 0.0),
    ) -> Self:
        """Return a net of rectangles over a box.

        Parameters
        ----------
        bounds : (2, 2)
            lower and upper corner of the box, m.
        size
            edge of a square, or the two edges of a rectangle, m.
        angle, shift
            turn of the net, rad, and its displacement in fractions of the edges.
        """
        edges = np.broadcast_to(np.asarray(size, dtype=float), 2)
        net = regular_net(bounds, (edges[0], edges[1]), angle, shift)
        vertices, cells = grid_vertices(net), grid_cells(net.columns, net.rows)
        sizes = np.full(len(vertices), np.hypot(*edges))
        return cls._of(vertices, cells, sizes, np.zeros(len(cells), dtype=np.int64))

    @staticmethod
    def from_mesh(mesh: MeshQuad) -> Quads | DistortedQuads:
        """Return the cover on a scikit-fem mesh of quadrilaterals.

        Parallelograms keep polynomial weights; any other convex quadrilateral makes the weights
        rational and the cover one of `covers.mathematical.distorted_quads`.
        """
        from covers.mathematical.distorted_quads import DistortedQuads

        vertices = np.ascontiguousarray(mesh.p.T, dtype=float)
        cells = counter_clockwise(vertices, np.ascontiguousarray(mesh.t.T, dtype=np.int64))
        sizes = star_sizes(vertices, cells)
        shapes = np.full(len(cells), -1, dtype=np.int64)
        corner = vertices[cells]
        skew = np.linalg.norm(corner[:, 0] - corner[:, 1] + corner[:, 2] - corner[:, 3], axis=1)
        if (skew <= PARALLEL * sizes[cells[:, 0]]).all():
            return Quads._of(vertices, cells, sizes, shapes)
        return DistortedQuads(vertices, cells, cells, vertices, sizes, shapes)

    @classmethod
    def _of(cls, vertices: Floats, cells: Ints, sizes: Floats, shapes: Ints) -> Self:
        return cls._of_stars(vertices, cells, sizes, shapes, BILINEAR, 2)
