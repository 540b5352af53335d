"""Weighted many-to-many relations between old and new things."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from integration.arrays import Floats, Ints
from integration.sparse import coo_array, csr_array


@dataclass(frozen=True)
class Relation:
    """Pairs of a parent and a child, with the measure of what they have in common.

    Attributes
    ----------
    parent, child
        (k,) numbers of old and new things.
    common
        (k,) common area (m2) or length (m).
    n_parents, n_children
        Number of old and of new things.
    """

    parent: Ints
    child: Ints
    common: Floats
    n_parents: int
    n_children: int

    @cached_property
    def matrix(self) -> csr_array:
        """The common measures as a matrix (n_parents, n_children)."""
        place = (self.parent, self.child)
        return csr_array(coo_array((self.common, place), shape=(self.n_parents, self.n_children)))

    @cached_property
    def main(self) -> Ints:
        """(n_children,) parent with the largest common measure; -1 without any."""
        found = np.full(self.n_children, -1, dtype=np.int64)
        order = np.lexsort((-self.parent, self.common))
        found[self.child[order]] = self.parent[order]
        return found

    def mean(self, values: Floats, fallback: Floats) -> Floats:
        """Return means (n_children, ...) over parents of ``values`` (n_parents, ...), weighted.

        Children without parents take ``fallback`` (n_children, ...).
        """
        flat = np.asarray(values, dtype=float).reshape(self.n_parents, -1)
        total = np.bincount(self.child, self.common, minlength=self.n_children)
        sums = (self.matrix.T @ flat).reshape(self.n_children, *np.shape(values)[1:])
        shape = (-1,) + (1,) * (sums.ndim - 1)
        known = (total > 0).reshape(shape)
        return np.asarray(
            np.where(known, sums / np.maximum(total, 1e-300).reshape(shape), fallback)
        )

    def gathered(self, of: tuple[Ints, Ints], sizes: tuple[int, int]) -> "Relation":
        """Return the relation of the wholes that parents and children are parts ``of``."""
        parent, child = of[0][self.parent], of[1][self.child]
        pairs, which = np.unique(parent * sizes[1] + child, return_inverse=True)
        common = np.bincount(which, self.common, minlength=len(pairs))
        return Relation(*np.divmod(pairs, sizes[1]), np.asarray(common), *sizes)


def identity(measure: Floats) -> Relation:
    """Return the identity: each is the only child of its only parent, of ``measure`` (n,)."""
    n = len(measure)
    every = np.arange(n, dtype=np.int64)
    return Relation(every, every, measure, n, n)
