"""Covers whose weights are the same polynomials of affine coordinates in every cell."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np

from covers.mathematical.base import Cover
from covers.small_matrices import inverses
from integration.arrays import Floats, Ints
from integration.monomials import affine, differentiate, evaluate


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
    table: Floats
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
        shift = self.reference(cells, origin)
        rows = np.tile(self.table, (len(cells), 1))
        moved = affine(rows, self.degree, np.repeat(matrix, k, axis=0), np.repeat(shift, k, axis=0))
        return moved.reshape(len(cells), k, -1), self.degree
