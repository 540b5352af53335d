"""Which links and slips of bars are joined, and the tridiagonal matrix of slips."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.sparse import csr_array
from scipy.sparse.csgraph import connected_components

from integration.arrays import Floats, Ints

NONE = np.zeros(0, dtype=np.int64)


@dataclass(frozen=True)
class SlipLayout:
    """Where the slips of chains are; those of a chain are consecutive.

    Attributes
    ----------
    left, right
        (m,) number of the slip at either end of a link; -1 for a fixed end.
    count
        Number p of slips.
    """

    left: Ints
    right: Ints
    count: int

    @cached_property
    def opening(self) -> csr_array:
        """(m, p) from slips to the elongations of links."""
        rows, columns, values = [], [], []
        for end, sign in ((self.right, 1.0), (self.left, -1.0)):
            at = np.flatnonzero(end >= 0)
            rows.append(at)
            columns.append(end[at])
            values.append(np.full(len(at), sign))
        parts = np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))
        return csr_array(parts, shape=(len(self.left), self.count))

    def opened(self, slip: Floats) -> Floats:
        """Elongations (m,) of links by slips (p,)."""
        ends = np.append(slip, 0.0)  # -1 is a fixed end
        return np.asarray(ends[self.right] - ends[self.left])

    def pulled(self, force: Floats) -> Floats:
        """Forces (p,) at slips of axial forces (m,)."""
        ends = self.count + 1  # -1 is a fixed end
        pulled = np.bincount(self.right % ends, force, ends)
        return np.asarray(pulled - np.bincount(self.left % ends, force, ends))[:-1]

    def matrix(self, axial: Floats, bond: Floats) -> Floats:
        """Stiffness of slips in upper banded form (2, p)."""
        band = np.zeros((2, self.count))
        band[1] = bond
        for end in (self.left, self.right):
            at = end >= 0
            band[1] += np.bincount(end[at], axial[at], minlength=self.count)
        both = (self.left >= 0) & (self.right >= 0)
        band[0, self.right[both]] = -axial[both]
        return band

    @cached_property
    def bars(self) -> list[tuple[Ints, Ints, Floats]]:
        """Links, slips and `opening` of each connected chain."""
        joined = csr_array(abs(self.opening.T) @ abs(self.opening))
        count, label = connected_components(joined, directed=False)
        end = np.maximum(self.left, self.right)
        of_link = np.where(end >= 0, label[np.maximum(end, 0)], -1) if len(label) else end
        parts = [(np.flatnonzero(of_link == n), np.flatnonzero(label == n)) for n in range(count)]
        parts += [(np.array([link]), NONE) for link in np.flatnonzero(of_link < 0)]
        return [(links, slips, self.opening[links][:, slips].toarray()) for links, slips in parts]

    @cached_property
    def places(self) -> tuple[Ints, Ints]:
        """Rows and columns of the tangents of all chains."""
        pairs = [np.meshgrid(links, links, indexing="ij") for links, *_ in self.bars]
        row, column = (np.concatenate([pair[i].ravel() for pair in pairs]) for i in (0, 1))
        return row, column
