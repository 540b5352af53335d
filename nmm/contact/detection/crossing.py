"""No body passes through another: vertices that went through an edge within a step, and when."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from covers.concatenate import some_of
from integration.arrays import Bools, Floats, Ints
from integration.plane_vectors import cross
from integration.ragged import within
from nmm.contact.detection.surface import Surface
from nmm.contact.detection.tolerances import ANGLE, CROSSED_FIRST, FLUSH


@dataclass(frozen=True, eq=False)
class Crossings:
    """Vertices that end a step further inside another body than contact looks.

    Attributes
    ----------
    vertex, edge
        (m,) the vertex and the edge that it went through.
    fraction
        (m,) of the step, when the vertex touched the edge; for one that began inside, when it came
        too deep.
    """

    vertex: Ints
    edge: Ints
    fraction: Floats

    def __len__(self) -> int:
        return len(self.vertex)

    def take(self, chosen: Bools) -> Crossings:
        """Return some of them (m,)."""
        return some_of(self, chosen)

    @property
    def free_fraction(self) -> float:
        """Largest fraction of the step that holds no crossing; 1 for a step without any."""
        return float(self.fraction.min(initial=1.0))


@dataclass(frozen=True, eq=False)
class Motion:
    """A step of all edges.

    Attributes
    ----------
    before, after
        The edges at its start and end.
    pairs
        Vertex and edge (m,) of all that can meet.
    near
        (k,) rows of the pairs that need a closer look.
    """

    before: Surface
    after: Surface
    pairs: tuple[Ints, Ints]
    near: Ints

    @property
    def harmless(self) -> bool:
        """Whether nothing can have crossed anything."""
        return not len(self.near)


def motion_of(before: Surface, after: Surface, pairs: tuple[Ints, Ints], share: float) -> Motion:
    """Return a step with the pairs that can come deeper in it than ``share``, or begin so."""
    # Compiled code is loaded by the first search, not by whoever names this module.
    from nmm.contact.detection.crossing_kernel import can_meet

    edges = before.start, before.end, after.start, before.next, before.body
    return Motion(before, after, pairs, can_meet(*edges, *pairs, share))


def crossings_in(motion: Motion, share: float) -> Crossings:
    """Find the vertices that crossed an edge while all points moved straight and evenly.

    A vertex crosses an edge where it comes deeper than a share of the thinner body's thickness,
    over the edge itself: less than `DEPTH` is the penetration that enforcement allows and search
    finds again. A vertex that leaves over the end of the edge has not crossed, nor has one that
    began inside and slides into the depth close below the surface of another edge.

    Parameters
    ----------
    motion
        The step.
    share
        Of the thickness of the thinner body, which is too deep; not less than the motion was made
        for.

    Notes
    -----
    The signed area of vertex and edge is a quadratic in time, so that the test is exact for a thin
    body that is left on its far side within the step (Provot 1997, for triangles in space).
    """
    before, after, pairs = motion.before, motion.after, motion.pairs
    v, e = pairs[0][motion.near], pairs[1][motion.near]
    if not len(v):
        return Crossings(v, e, np.empty(0))
    edge0, edge1 = before.end[e] - before.start[e], after.end[e] - after.start[e]
    offset0, offset1 = before.start[v] - before.start[e], after.start[v] - after.start[e]
    # Twice the area, positive inside: c0 + c1 t + c2 t^2.
    c0, both = cross(edge0, offset0), cross(edge1 - edge0, offset1 - offset0)
    c1 = cross(edge0, offset1 - offset0) + cross(edge1 - edge0, offset0)
    allowed = share * np.minimum(before.thickness[v], before.thickness[e]) * before.length[e]
    deep = _first_root(c0 - allowed, c1, both)
    touch = np.where(c0 < 0.0, _first_root(c0, c1, both), deep)

    t = np.where(deep <= 1.0, deep, 0.0)[:, None]
    edge, offset = edge0 + t * (edge1 - edge0), offset0 + t * (offset1 - offset0)
    along, square = (edge * offset).sum(axis=1), (edge * edge).sum(axis=1)
    hit = np.flatnonzero((deep <= 1.0) & (along >= 0.0) & (along <= square) & (square > 0.0))
    if len(hit):
        length = before.length[e[hit]]
        depth = np.column_stack([c0[hit], allowed[hit]]) / length[:, None]
        hit = hit[~_along_another(before, after, pairs, v[hit], e[hit], deep[hit], depth)]
    return Crossings(v[hit], e[hit], np.minimum(touch, deep)[hit])


def over_seams(found: Crossings, motion: Motion, pairs: tuple[Ints, Ints]) -> Bools:
    """Which crossings (m,) are corners that slide from one body on to the next, flush with it.

    The corner of a block on a floor lies lower than it by its own penetration. Where the floor ends
    and another body goes on at its level, it comes in through the side of that body just below the
    end of it, and the corners of both floors come in through the side of the block just above its
    corner: no more than `FLUSH` of the thinner body's thickness. The floor that goes on bears it.

    Parameters
    ----------
    found, motion
        The crossings of a step.
    pairs
        Vertex and edge (k,) of the contacts of the step.
    """
    before, edge, vertex = motion.before, found.edge, found.vertex
    flush = FLUSH * np.minimum(before.thickness[vertex], before.thickness[edge])
    over = np.zeros(len(found), dtype=bool)
    for corner, beyond in ((edge, before.previous[edge]), (before.next[edge], before.next[edge])):
        either = (vertex[:, None] == pairs[0]) | (corner[:, None] == pairs[0])
        one, other = np.nonzero((_apart(motion, found, corner) < flush)[:, None] & either)
        floor, low = pairs[1][other], flush[one]
        turn = cross(before.direction[floor], before.direction[beyond[one]])
        level = np.abs(turn) < np.sin(ANGLE)
        for point in (vertex[one], corner[one]):
            level &= np.abs(_height(before, point, floor)) < low
        over[one[level]] = True
    return over


def _apart(motion: Motion, found: Crossings, corner: Ints) -> Floats:
    """Distances (m,) of the crossing vertices from other ones when they come in (m).

    Those that began inside, as a corner that stands on the end of its floor, did so before.
    """
    began = _height(motion.before, found.vertex, found.edge) <= 0.0
    time = np.where(began, 0.0, found.fraction)[:, None]
    offset = (1 - time) * (motion.before.start[found.vertex] - motion.before.start[corner])
    offset += time * (motion.after.start[found.vertex] - motion.after.start[corner])
    return np.asarray(np.hypot(*offset.T))


def _height(surface: Surface, vertex: Ints, edge: Ints) -> Floats:
    """Signed distance (m,) of vertices from the lines of edges (m), positive outside."""
    offset = surface.start[vertex] - surface.start[edge]
    return np.asarray((offset * surface.normal[edge]).sum(axis=1))


def _along_another(
    before: Surface,
    after: Surface,
    pairs: tuple[Ints, Ints],
    v: Ints,
    e: Ints,
    time: Floats,
    depth: Floats,
) -> Bools:
    """Vertices (m,) nearer to another edge of the body than ``depth``, at 0 and at ``time``."""
    first, last = np.searchsorted(pairs[0], v), np.searchsorted(pairs[0], v, side="right")
    hit = np.repeat(np.arange(len(v)), last - first)
    other = pairs[1][first[hit] + within(last - first)]
    keep = (other != e[hit]) & (before.body[other] == before.body[e[hit]])
    hit, other = hit[keep], other[keep]
    near = np.ones(len(hit), dtype=bool)
    for t, below in zip((np.zeros_like(time), time), depth.T, strict=True):  # two moments
        distance = _distance(before, after, v[hit], other, t[hit, None])
        near &= distance < below[hit] * (1.0 - CROSSED_FIRST)
    along = np.zeros(len(v), dtype=bool)
    along[hit[near]] = True
    return along


def _distance(before: Surface, after: Surface, v: Ints, e: Ints, t: Floats) -> Floats:
    """Distance (m,) of vertices from segments at the times ``t`` (m, 1)."""
    start = (1.0 - t) * before.start[e] + t * after.start[e]
    edge = (1.0 - t) * before.end[e] + t * after.end[e] - start
    offset = (1.0 - t) * before.start[v] + t * after.start[v] - start
    foot = np.clip((offset * edge).sum(axis=1) / (edge * edge).sum(axis=1), 0.0, 1.0)
    return np.asarray(np.linalg.norm(offset - foot[:, None] * edge, axis=1))


def _first_root(c0: Floats, c1: Floats, c2: Floats) -> Floats:
    """When ``c0 + c1 t + c2 t^2`` rises through zero first, for t > 0; infinite if it never does.

    Of the two forms of the root, the one that adds terms of one sign loses no digits (Press et
    al., section 5.6).
    """
    root = np.sqrt(np.maximum(c1 * c1 - 4.0 * c2 * c0, 0.0))
    falling = c1 < 0.0
    above = np.where(falling, root - c1, -2.0 * c0)
    below = np.where(falling, 2.0 * c2, c1 + root)
    good = (c0 < 0.0) & (c1 * c1 >= 4.0 * c2 * c0) & (below > 0.0)
    return np.divide(above, below, out=np.full_like(c0, np.inf), where=good)
