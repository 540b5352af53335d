"""Evaluation rows: the displacement at points as a linear function of the unknowns.

They are all that contact, supports, point loads and monitors need to know of covers.
"""

from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats, Ints
from integration.contraction import contract
from integration.sparse import csr_array


@dataclass(frozen=True)
class Rows:
    """Rows ``u(point) = sum_a values[:, :, a] d[unknowns[:, a]]``, padded with zeros.

    Attributes
    ----------
    unknowns
        (m, L) global unknowns.
    values
        (m, 2, L) rows of both components.
    """

    unknowns: Ints
    values: Floats

    def __len__(self) -> int:
        return len(self.unknowns)

    def apply(self, unknowns: Floats) -> Floats:
        """Displacement (m, 2) at the points for the vector (n,) of all unknowns."""
        return contract("mcl,ml->mc", self.values, unknowns[self.unknowns])

    def along(self, directions: Floats) -> Floats:
        """Rows (m, L) of the displacement along a direction (m, 2) at each point."""
        return contract("mcl,mc->ml", self.values, directions)

    def spread(self, directions: Floats, n_unknowns: int) -> Floats:
        """Return the load vector (n,) of forces (m, 2) at the points."""
        terms = self.along(directions)
        found = np.bincount(self.unknowns.ravel(), terms.ravel(), minlength=n_unknowns)
        return np.asarray(found, dtype=np.float64)

    def take(self, index: Ints) -> "Rows":
        """Return the rows of selected points."""
        return Rows(self.unknowns[index], self.values[index])

    def matrix(self, n_unknowns: int) -> csr_array:
        """Return the sparse matrix (2m, n_unknowns), both components of a point together."""
        m, components, length = self.values.shape
        values = self.values.reshape(components * m, length)
        return row_matrix(np.repeat(self.unknowns, components, axis=0), values, n_unknowns)


def row_matrix(unknowns: Ints, values: Floats, n: int, merged: bool = False) -> csr_array:
    """Return the matrix (m, n) of row values (m, L) at unknowns (m, L).

    An unknown that occurs twice in a row has two entries, or with ``merged`` their sum.
    """
    m, length = values.shape
    # A copy of the columns, as merging sorts them in place.
    found = csr_array((values.ravel(), unknowns.flatten(), np.arange(m + 1) * length), shape=(m, n))
    if merged:
        found.sum_duplicates()
    return found


def stack_groups(parts: list[tuple[Ints, Ints, Floats]], n_points: int) -> tuple[Ints, Floats]:
    """Return rows of several element groups together, padded to the longest.

    Parameters
    ----------
    parts
        For each group: positions (k,) among the points, unknowns (k, L), values (k, ..., L).
    n_points
        Number of points.

    Returns
    -------
    unknowns (n_points, L_max), values (n_points, ..., L_max)
    """
    if len(parts) == 1:
        return parts[0][1], parts[0][2]
    length = max((unknowns.shape[1] for _, unknowns, _ in parts), default=0)
    inner = parts[0][2].shape[1:-1] if parts else (2,)
    all_unknowns = np.zeros((n_points, length), dtype=np.int64)
    all_values = np.zeros((n_points, *inner, length))
    for position, unknowns, values in parts:  # a handful of groups, not elements
        all_unknowns[position, : unknowns.shape[1]] = unknowns
        all_values[position, ..., : values.shape[-1]] = values
    return all_unknowns, all_values
