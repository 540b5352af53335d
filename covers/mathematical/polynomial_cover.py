"""Covers whose weights are the same polynomials of affine coordinates in every cell."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import Self

import numpy as np

from covers.concatenate import SHARED
from covers.mathematical.base import Cover
from covers.small_matrices import inverses
from integration.arrays import Floats, Ints
from integration.monomials import affine, differentiate, evaluate

# Corners of the unit triangle and the unit square, in the order of a cell's vertices.
UNIT_CORNERS = {
    3: np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]),
    4: np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]),
}
# Coefficients of moved tables below this share of the largest are the rounding of what cancels:
# the least that does not, of splines of degree 5, is 1/120^2.
CANCELLED = 1e-13


@dataclass(frozen=True, eq=False)
class PolynomialCover(Cover):
    """A cover with one table of weights over reference coordinates.

    Attributes
    ----------
    cell_origin, cell_matrix : (C, 2), (C, 2, 2)
        reference coordinates ``xi = matrix (x - origin)`` of each cell.
    table : (k, K)
        coefficients of the k weights over the monomials of ``xi``.
    degree : int
        total degree of the table.
    """

    cell_origin: Floats
    cell_matrix: Floats
    table: Floats = field(metadata=SHARED)
    degree: int

    @classmethod
    def _of_stars(
        cls, vertices: Floats, cells: Ints, sizes: Floats, shapes: Ints, table: Floats, degree: int
    ) -> Self:
        """Patches about the vertices; cells are images of the unit triangle or square.

        Reference coordinates run from the first corner to the second and to the last.
        """
        corner = vertices[cells]
        sides = np.stack([corner[:, 1] - corner[:, 0], corner[:, -1] - corner[:, 0]], axis=2)
        return cls(
            vertices=vertices,
            cell_vertices=cells,
            cell_patches=cells,
            patch_centre=vertices,
            patch_size=sizes,
            cell_shape=shapes,
            cell_origin=corner[:, 0],
            cell_matrix=inverses(sides),
            table=table,
            degree=degree,
        )

    @property
    def weight_degree(self) -> int:
        """Total degree of the weights."""
        return self.degree

    def reference(self, cells: Ints, points: Floats) -> Floats:
        """Reference coordinates (m, 2) of ``points`` in ``cells``."""
        offset = points - self.cell_origin[cells]
        return np.asarray(np.einsum("mij,mj->mi", self.cell_matrix[cells], offset))

    def weights(self, cells: Ints, points: Floats) -> Floats:
        """Weights (m, k) at ``points`` (m, 2), each in the cell of the same row."""
        return np.asarray(evaluate(self.reference(cells, points), self.degree) @ self.table.T)

    def evaluate(self, cells: Ints, points: Floats) -> tuple[Floats, Floats]:
        """Weights (m, k) and gradients (m, k, 2), 1/m."""
        xi = self.reference(cells, points)
        lower = evaluate(xi, max(self.degree - 1, 0))
        slopes = [lower @ differentiate(self.table, self.degree, axis).T for axis in (0, 1)]
        gradients = np.einsum("imk,mij->mkj", np.stack(slopes), self.cell_matrix[cells])
        return evaluate(xi, self.degree) @ self.table.T, gradients

    def weight_tables(self, cells: Ints, origin: Floats, scale: Floats) -> tuple[Floats, int]:
        """Coefficients (m, k, K) of the weights over monomials of (x - origin) / scale, degree.

        Parameters
        ----------
        cells, origin, scale : (m,), (m, 2), (m,)
            the cell of each row and the coordinates wanted in it.
        """
        k = len(self.table)
        matrix = self.cell_matrix[cells] * scale[:, None, None]
        nearest, shift = self._from_corner(cells, origin)
        rows = self._corner_tables[nearest].reshape(len(cells) * k, -1)
        moved = affine(rows, self.degree, np.repeat(matrix, k, axis=0), np.repeat(shift, k, axis=0))
        return moved.reshape(len(cells), k, -1), self.degree

    @cached_property
    def _corner_tables(self) -> Floats:
        """Tables (v, k, K) of the weights in reference coordinates that begin at each corner.

        A weight that vanishes towards a corner has no constant there. On a sliver of 1e-9 of the
        cell beside it a spline of degree 2 is 1e-18: less than the rounding of its terms about
        another corner.
        """
        corners = UNIT_CORNERS[self.cell_vertices.shape[1]]
        v, k = len(corners), len(self.table)
        rows = np.tile(self.table, (v, 1))
        moved = affine(rows, self.degree, np.eye(2), np.repeat(corners, k, axis=0))
        moved[np.abs(moved) < CANCELLED * np.abs(self.table).max()] = 0.0
        return np.asarray(moved.reshape(v, k, -1))

    def _from_corner(self, cells: Ints, points: Floats) -> tuple[Ints, Floats]:
        """Nearest corner (m,) of each cell, and reference coordinates (m, 2) from there."""
        corners = UNIT_CORNERS[self.cell_vertices.shape[1]]
        away = np.linalg.norm(self.reference(cells, points)[:, None] - corners, axis=2)
        nearest = np.argmin(away, axis=1)
        offset = points - self.vertices[self.cell_vertices[cells, nearest]]
        return nearest, np.asarray(np.einsum("mij,mj->mi", self.cell_matrix[cells], offset))
