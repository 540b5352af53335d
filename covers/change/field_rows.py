"""A field, its slopes and its strains at points, as rows over the unknowns of a manifold."""

from dataclasses import dataclass

import numpy as np

from covers.approximation.rows import Rows
from integration.arrays import Floats, Ints
from integration.sparse import csr_array


@dataclass(frozen=True)
class FieldRows:
    """Rows (Q, 3, 2, L) of a field and its slopes along x and y over unknowns (Q, L)."""

    unknowns: Ints
    values: Floats

    @classmethod
    def of(cls, unknowns: Ints, values: Floats) -> "FieldRows":
        """Return what `Manifold.both_rows` found; without a point it knows no components."""
        return cls(unknowns, values.reshape(len(unknowns), 3, 2, unknowns.shape[1]))

    @property
    def rows(self) -> Rows:
        """Rows of the displacement."""
        return Rows(self.unknowns, self.values[:, 0])

    @property
    def strains(self) -> "StrainRows":
        """Rows of the strains (xx, yy, 2 xy)."""
        g = self.values
        values = np.stack([g[:, 1, 0], g[:, 2, 1], g[:, 2, 0] + g[:, 1, 1]], axis=1)
        return StrainRows(self.unknowns, values)


@dataclass(frozen=True)
class StrainRows:
    """Rows (Q, 3, L) over unknowns (Q, L)."""

    unknowns: Ints
    values: Floats

    def times(self, matrices: Floats) -> "StrainRows":
        """Return the rows multiplied by matrices (Q, 3, 3)."""
        return StrainRows(self.unknowns, np.matmul(matrices, self.values))

    def matrix(self, n_unknowns: int) -> csr_array:
        """Return the sparse matrix (3 Q, n)."""
        q, rows, length = self.values.shape
        columns = np.repeat(self.unknowns[:, None, :], rows, axis=1).ravel()
        offsets = np.arange(rows * q + 1) * length
        return csr_array((self.values.ravel(), columns, offsets), shape=(rows * q, n_unknowns))
