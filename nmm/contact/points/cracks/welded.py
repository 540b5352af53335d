"""Places on the faces of a crack that no unknown moves apart: its tip, and where covers end it.

A condition there has no row: it says nothing, and exact enforcements would not find its force.
"""

from dataclasses import dataclass
from typing import Self

import numpy as np

from covers.cutting.cut_boundary import CutBoundary
from integration.arrays import Bools, Ints
from integration.sparse import csr_array
from nmm.contact.detection.contacts import Contacts, FaceContacts
from nmm.contact.detection.tolerances import SAME_ROWS
from nmm.contact.points.boundary_points import Sides
from nmm.solvers.unchecked import largest


@dataclass(frozen=True)
class WeldedVertices:
    """Vertices of faces that move as one.

    Attributes
    ----------
    place
        (n,) number of the place that the start of each edge is.
    next
        (n,) the edge behind each.
    tips
        (n,) which edges begin at the tip of a crack: where both its faces meet.
    """

    place: Ints
    next: Ints
    tips: Bools

    @classmethod
    def of(cls, boundary: CutBoundary, sides: Sides) -> Self | None:
        """Return the places of a boundary; None without faces of cracks."""
        face = np.flatnonzero((boundary.crack >= 0) & (boundary.opposite >= 0))
        if not len(face):
            return None
        from scipy.sparse.csgraph import connected_components  # no other scene needs it

        across, n = boundary.next[boundary.opposite[face]], len(boundary)
        one = _moved(sides, face) - _moved(sides, across)
        size = SAME_ROWS * np.abs(sides.start.rows.values[face]).max(axis=(1, 2))
        alike = largest(one).reshape(-1, 2).max(axis=1) <= size
        pairs = (np.ones(int(alike.sum())), (face[alike], across[alike]))
        _, place = connected_components(csr_array(pairs, shape=(n, n)), directed=False)
        before = boundary.previous
        tips = (boundary.crack >= 0) & (boundary.opposite == before)
        return cls(place.astype(np.int64), boundary.next, tips)

    @property
    def beside(self) -> Bools:
        """Which edges (n,) begin or end at a place that several share: at a tip, and before one."""
        shared = np.bincount(self.place)[self.place] > 1
        shared |= self.tips
        return np.asarray(shared | shared[self.next])

    def apart(self, contacts: Contacts) -> Bools:
        """Return which contacts (m,) are of two places."""
        v, e, t = contacts.vertex, contacts.edge, contacts.parameter
        s = contacts.parameter_a if isinstance(contacts, FaceContacts) else np.zeros(len(v))
        place, end = self.place, self.place[self.next]
        first = np.where(t > 0, place[v] == end[e], place[v] == place[e])
        last = np.where(t < 1, end[v] == place[e], end[v] == end[e])
        inner = (s > 0) & (s < 1)
        # A corner within an edge is at no end of it.
        corner = first & ((t == 0) | (t == 1))
        return np.asarray(~np.where(inner, first & last, np.where(s > 0, last, corner)))


def _moved(sides: Sides, edge: Ints) -> csr_array:
    """Rows (2 m, n) of the starts of edges (m,)."""
    return sides.start.rows.take(edge).matrix(sides.manifold.n_unknowns)
