"""Corners that stand in a kink of two bodies side by side, and both edges that bound their way."""

import numpy as np

from integration.arrays import Ints
from integration.plane_vectors import cross, dot
from integration.ragged import within
from nmm.contact.detection.measures import SINE
from nmm.contact.detection.surface import Surface


def in_kinks(surface: Surface, vertex: Ints, edge: Ints, reach: float) -> tuple[Ints, Ints]:
    """Return those pairs of a vertex and an edge that meet in a kink of two bodies.

    One edge ends there and another, of a third body, begins; they turn towards each other, and the
    corner at the vertex fits between them. The search of a step leaves out the edge that a flush
    neighbour of the vertex covers there.

    Parameters
    ----------
    vertex, edge
        (m,) pairs of different bodies, complete up to the reach.
    reach
        Largest distance of the vertex from the ends of both edges (m).
    """
    found = np.unique(np.concatenate(_bounding(surface, vertex, edge, reach)))
    return vertex[found], edge[found]


def _bounding(surface: Surface, vertex: Ints, edge: Ints, reach: float) -> tuple[Ints, Ints]:
    """Return rows (k,) of pairs whose edge ends and begins in a kink that the corner fits into."""
    own, back = surface.direction[vertex], -surface.direction[surface.previous[vertex]]
    out = np.minimum(dot(own, surface.normal[edge]), dot(back, surface.normal[edge])) >= -SINE
    out &= cross(own, back) > 0.0
    apart = (
        np.hypot(*(surface.start[vertex] - end[edge]).T) for end in (surface.end, surface.start)
    )
    ending, beginning = (np.flatnonzero(out & (way <= reach)) for way in apart)
    # Every two at one vertex, in order of vertices: runs of `beginning` beside each of `ending`.
    low, high = (
        np.searchsorted(vertex[beginning], vertex[ending], side) for side in ("left", "right")
    )
    first = np.repeat(ending, high - low)
    second = beginning[np.repeat(low, high - low) + within(high - low)]
    one, other = edge[first], edge[second]
    kink = cross(surface.direction[one], surface.direction[other]) < -SINE
    kink &= surface.body[one] != surface.body[other]
    return first[kink], second[kink]
