"""Boundary edges of bodies in reference coordinates, on which contact, supports and loads act."""

from dataclasses import dataclass, field

from covers.concatenate import numbers
from integration.arrays import Floats, Ints
from integration.permutations import inverse
from integration.polygons import Polygons


@dataclass(frozen=True)
class BoundaryEdges:
    """Boundary edges of bodies, with the material on the left of start -> end.

    Attributes
    ----------
    start, end
        (n, 2) reference coordinates.
    element, body
        (n,) element and body of each edge.
    next, previous
        (n,) next and previous edge along the boundary of the body.
    """

    start: Floats
    end: Floats
    element: Ints = field(metadata=numbers("element"))
    body: Ints = field(metadata=numbers("body"))
    next: Ints = field(metadata=numbers("edge"))
    previous: Ints = field(metadata=numbers("edge"))

    def __len__(self) -> int:
        return len(self.element)

    def at(self, edge: Ints, parameter: Floats) -> Floats:
        """Return reference places (m, 2) on edges (m,) at parameters (m,) from 0 to 1."""
        return self.start[edge] + parameter[:, None] * (self.end[edge] - self.start[edge])


def ring_edges(polygons: Polygons, body: Ints) -> BoundaryEdges:
    """Return all edges of all rings as boundary, for bodies of one element each."""
    follower = polygons.next_point
    previous = inverse(follower)
    element = polygons.polygon_of_point
    return BoundaryEdges(
        start=polygons.points,
        end=polygons.points[follower],
        element=element,
        body=body[element],
        next=follower,
        previous=previous,
    )
