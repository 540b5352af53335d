"""Edges of bodies in reference coordinates: where contact, supports and loads act."""

from dataclasses import dataclass, field

from covers.concatenate import numbers
from integration.arrays import Floats, Ints
from integration.permutations import inverse
from integration.polygons import Polygons


@dataclass(frozen=True)
class BoundaryEdges:
    """Free or interface edges of bodies, the material on the left hand of start -> end.

    Attributes
    ----------
    start, end
        (n, 2) reference coordinates.
    element, body
        (n,) the element whose edge it is and the body it belongs to.
    next, previous
        (n,) the edges that follow and precede it along the body's boundary.
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
        """Places (m, 2) in the reference on edges (m,), from 0 at their start to 1 at their end."""
        return self.start[edge] + parameter[:, None] * (self.end[edge] - self.start[edge])


def ring_edges(polygons: Polygons, body: Ints) -> BoundaryEdges:
    """Return all edges of all rings as boundary: the case of one element a body."""
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
