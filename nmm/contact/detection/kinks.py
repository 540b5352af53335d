"""Corners that stand in a kink of two bodies side by side, and both edges that bound their way."""

import numpy as np

from integration.arrays import Bools, Floats, Ints
from integration.plane_vectors import cross, dot
from integration.ragged import within
from nmm.contact.detection.contacts import Contacts
from nmm.contact.detection.measures import SINE
from nmm.contact.detection.surface import Surface, pair_key
from nmm.contact.detection.tolerances import ANGLE, FLUSH


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
    both = _bounding(surface, vertex, edge, np.full(len(vertex), reach))
    return _pairs_of(vertex, edge, both)


def standing(surface: Surface, vertex: Ints, edge: Ints) -> tuple[Ints, Ints]:
    """Return pairs in kinks within `FLUSH` whose edge the corner meets with none of its sides.

    Cells that fit meet by their sides, which are contacts; what stands beside a flush block meets
    the edge below that block at its corner alone.

    Parameters
    ----------
    vertex, edge
        (m,) pairs of different bodies that are near each other.
    """
    flush = FLUSH * np.minimum(surface.thickness[vertex], surface.thickness[edge])
    ending, beginning = _bounding(surface, vertex, edge, flush)
    ending = ending[~_sided(surface, vertex[ending], -surface.direction[edge[ending]])]
    beginning = beginning[~_sided(surface, vertex[beginning], surface.direction[edge[beginning]])]
    return _pairs_of(vertex, edge, (ending, beginning))


def from_below(surface: Surface, found: Contacts, stands: tuple[Ints, Ints]) -> Bools:
    """Return which contacts (m,) are of a kink's corner before a side of what stands there.

    Where two corners meet either bounds the other's way. What stands on an edge of the kink may
    slide along it, which the corner that the edge ends at would prevent.
    """
    vertex, edge = stands
    corner = _corner(surface, vertex, edge)
    before, after = (pair_key(surface, corner, side) for side in (vertex, surface.previous[vertex]))
    return np.isin(found.key, np.concatenate([before, after]))


def _corner(surface: Surface, vertex: Ints, edge: Ints) -> Ints:
    """Return the vertices (k,) at the ends of the edges that are nearer to the corners."""
    start, end = (surface.start[vertex] - at[edge] for at in (surface.start, surface.end))
    nearer = (start * start).sum(axis=1) <= (end * end).sum(axis=1)
    return np.where(nearer, edge, surface.next[edge])


def _pairs_of(vertex: Ints, edge: Ints, rows: tuple[Ints, Ints]) -> tuple[Ints, Ints]:
    """Return the pairs at rows (k,) of edges that end in kinks or begin there, each once."""
    found = np.unique(np.concatenate(rows))
    return vertex[found], edge[found]


def _bounding(surface: Surface, vertex: Ints, edge: Ints, reach: Floats) -> tuple[Ints, Ints]:
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


def _sided(surface: Surface, vertex: Ints, along: Floats) -> Bools:
    """Return which vertices (k,) have a side along the directions (k, 2)."""
    sides = surface.direction[vertex], -surface.direction[surface.previous[vertex]]
    one, other = (np.hypot(*(side - along).T) <= ANGLE for side in sides)
    return np.asarray(one | other)
