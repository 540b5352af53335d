"""What flush neighbours hide: stretches of edges, and corners inside an even face.

Bodies that stand beside each other form one face, a floor or a course of a wall. A body that slides
along it must meet neither the edges in the joints nor the corners as those of one body alone. A
*ray* is the direction in which one of the two edges at a vertex leaves it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from integration.arrays import Bools, Floats, Ints
from integration.plane_vectors import cross, dot
from nmm.contact.detection.measures import flush_distance, thinner
from nmm.contact.detection.surface import Surface
from nmm.contact.detection.tolerances import MERGED_BODIES, RANKED, Rules


@dataclass(frozen=True, eq=False)
class Covers:
    """Edges of other bodies that lie flush on the two edges of each vertex, next to it; or -1."""

    own: Ints
    before: Ints


def convex_vertices(surface: Surface, rules: Rules) -> Bools:
    """Vertices whose solid angle is at most a half turn, within the angular tolerance."""
    turn = cross(surface.direction[surface.previous], surface.direction)
    return np.asarray(turn >= -rules.sine)


def find_covers(
    surface: Surface, v: Ints, e: Ints, along: Floats, gap: Floats, rules: Rules
) -> Covers:
    """Find, for both edges at each vertex, the flush opposite edge that runs along them furthest.

    A corner pressed into the joint between two bodies is flush with both for its own depth only.
    """
    cosine = np.sqrt(1.0 - rules.sine**2)
    other = surface.body[v] != surface.body[e]
    flush = flush_distance(surface, v, e, rules)
    found = []
    for side, inward in ((v, 1.0), (surface.previous[v], -1.0)):
        opposite = dot(surface.direction[side], surface.direction[e]) <= -cosine
        # Length of the edge that lies beside the side, counted from the vertex.
        beside = along if inward > 0.0 else surface.length[e] - along
        close = other & opposite & (np.abs(gap) <= flush)
        close &= (beside > flush) & (beside <= surface.length[e] + flush)
        rows = np.flatnonzero(close)
        rows = rows[np.lexsort((e[rows], -beside[rows], v[rows]))]
        vertex, first = np.unique(v[rows], return_index=True)
        cover = np.full(len(surface), -1, dtype=np.int64)
        cover[vertex] = e[rows[first]]
        found.append(cover)
    return Covers(*found)


def rays(
    surface: Surface, covers: Covers, v: Ints, partner: Ints, mate: Ints, rules: Rules
) -> tuple[Floats, Floats]:
    """Rays of the vertices ``v`` as bodies other than the flush neighbours meet them.

    A vertex is merged with the bodies that lie flush on its sides, the partner and its ``mate``
    apart (-1 for none), as long as the union is convex; else its own rays stand.
    """
    own, before = surface.direction[v], -surface.direction[surface.previous[v]]
    apart = np.stack([partner, mate, surface.body[v]])
    ray_own, walked = _walk(surface, covers, v, apart, own, before, True, rules)
    ray_before, also = _walk(surface, covers, v, apart, before, ray_own, False, rules)
    good = (walked & also)[:, None]
    return np.where(good, ray_own, own), np.where(good, ray_before, before)


def _walk(
    surface: Surface,
    covers: Covers,
    v: Ints,
    apart: Ints,
    ray: Floats,
    across: Floats,
    forward: bool,
    rules: Rules,
) -> tuple[Floats, Bools]:
    """Turn one ray of each vertex over its flush neighbours; tell where the union stays convex."""
    convex = convex_vertices(surface, rules)
    cover = covers.own if forward else covers.before
    at, ray, good = v.copy(), ray.copy(), np.ones(len(v), dtype=bool)
    going = np.ones(len(v), dtype=bool)
    for _ in range(MERGED_BODIES):
        x = np.where(going, cover[at], -1)
        going = (x >= 0) & (surface.body[x] != apart).all(axis=0)
        rows = np.flatnonzero(going & good)
        if not len(rows):
            break
        edge, here = x[rows], at[rows]
        corner = surface.next[edge] if forward else edge
        meets = _meet(surface, here, edge, corner, rules)
        turned = (
            surface.direction[corner] if forward else -surface.direction[surface.previous[corner]]
        )
        turn = cross(turned, across[rows]) if forward else cross(across[rows], turned)
        flat_or_less = turn >= -rules.sine
        full = (turn <= rules.sine) & (dot(turned, across[rows]) > 0.0)
        good[rows] = meets & convex[corner] & flat_or_less & ~full
        at[rows], ray[rows] = corner, turned
    return ray, good


def _meet(surface: Surface, at: Ints, edge: Ints, corner: Ints, rules: Rules) -> Bools:
    """Whether corners (m,) of edges that are flush at the vertices ``at`` lie there."""
    offset = surface.start[corner] - surface.start[at]
    return np.asarray(np.hypot(*offset.T) <= 2.0 * flush_distance(surface, at, edge, rules))


def _beyond(
    surface: Surface, covers: Covers, moves: Ints, e: Ints, end: Bools, rules: Rules
) -> Ints:
    """Edges (m,) that go on beyond an ``end`` of edges, of what moves not as ``moves``; or -1.

    Pieces of one body may lie between.
    """
    at = np.where(end, surface.next[e], e)
    other, last = np.full(len(e), -1), np.full(len(e), -1)
    going, broken = np.ones(len(e), dtype=bool), np.zeros(len(e), dtype=bool)
    for _ in range(MERGED_BODIES):
        x = np.where(end, covers.own[at], covers.before[at])
        going = going & (x >= 0) & (surface.moves[x] != moves)
        going &= surface.body[x] != surface.body[e]
        going &= (last < 0) | (surface.moves[x] == surface.moves[last])
        corner = np.where(end, surface.next[x], x)
        broken |= going & ~_meet(surface, at, x, corner, rules)
        at, last = np.where(going, corner, at), np.where(going, x, last)
        other = np.where(going, np.where(end, corner, surface.previous[corner]), other)
    return np.where(broken, -1, other)


def _turned(surface: Surface, e: Ints, end: Bools, other: Ints, rules: Rules) -> Bools:
    """Whether edges (m,) and the ``other`` ones beyond their ``end`` turn towards each other."""
    turn = cross(surface.direction[other], surface.direction[e])
    return np.asarray((other >= 0) & (np.where(end, -turn, turn) < -rules.sine))


def beside_kinks(
    surface: Surface, covers: Covers, moves: Ints, e: Ints, end: Bools, rules: Rules
) -> Ints:
    """Edges (m,) beyond an ``end`` of edges that make a kink with them; or -1. See `_beyond`."""
    other = _beyond(surface, covers, moves, e, end, rules)
    return np.where(_turned(surface, e, end, other, rules), other, -1)


def _depth(surface: Surface, e: Ints, other: Ints) -> Floats:
    """Angles (m,) of the kinks of edges with the ``other`` ones (rad), or 0 where there is none."""
    ways = surface.direction[other], surface.direction[e]
    return np.where(other >= 0, np.arctan2(np.abs(cross(*ways)), dot(*ways)), 0.0)


def _along(surface: Surface, vectors: Floats, other: Ints, end: Bools) -> Floats:
    """What of vectors (m, 2) goes along edges beyond an ``end`` to the corner there, from 0 on."""
    rate = dot(vectors, surface.direction[other])
    return np.asarray(np.maximum(np.where(end, -rate, rate), 0.0))


def _reentrant(
    surface: Surface,
    covers: Covers,
    v: Ints,
    e: Ints,
    further: Bools,
    motion: Floats,
    rules: Rules,
) -> Bools:
    """Whether vertices (m,) lie in kinks of their body and a flush one that bound no way of edges.

    Of two kinks that is the deeper one, unless weight or motion drives one body past the other.
    """
    ends, deep = [np.full(len(v), end) for end in (False, True)], np.zeros(len(v))
    sides, mates = (v, surface.previous[v]), []
    for side, end in zip(sides, ends, strict=True):
        mate = _beyond(surface, covers, surface.moves[e], side, end, rules)
        turned = _turned(surface, side, end, mate, rules)
        deep = np.where(turned, np.maximum(deep, _depth(surface, side, mate)), deep)
        mates.append(mate)
    other = beside_kinks(surface, covers, surface.moves[v], e, further, rules)
    mate, at = np.where(further, *mates), np.where(further, surface.next[e], e)
    ahead = np.zeros(len(v))
    for drive in (surface.falls, motion):
        rate = _along(surface, drive[v], other, further)
        rate -= _along(surface, drive[at], mate, ~further)
        size = np.hypot(*drive.T)
        clear = (mate >= 0) & (np.abs(rate) > RANKED * (size[v] + size[at]))
        ahead = np.where((ahead == 0.0) & clear, rate, ahead)
    passed = np.where(ahead == 0.0, deep > _depth(surface, e, other), ahead < 0.0)
    return np.where(other < 0, deep > 0.0, passed & (np.maximum(*mates) >= 0))


def within_kinks(
    surface: Surface, covers: Covers, v: Ints, e: Ints, side: Ints, rules: Rules
) -> Bools:
    """Whether edges (m,) end in a kink of two, within which the ``side`` next to them lies."""
    found = np.zeros(len(e), dtype=bool)
    for end, beside in ((True, surface.next), (False, surface.previous)):
        ends = np.full(len(e), end)
        kink = beside_kinks(surface, covers, surface.moves[v], e, ends, rules) >= 0
        found |= kink & (side == beside[e])
    return found


def leaves(
    surface: Surface,
    covers: Covers,
    v: Ints,
    e: Ints,
    along: Floats,
    motion: Floats,
    rules: Rules,
) -> Bools:
    """First-order entrance condition, for the vertex alone and with its flush neighbours.

    In a kink of its body and a flush one a vertex meets only edges along its sides, and those that
    end in another past which its body goes, or in a deeper one.
    """
    own, before = surface.direction[v], -surface.direction[surface.previous[v]]
    alone = _outward(surface, e, own, before, rules)
    further = along > 0.5 * surface.length[e]
    reentrant = _reentrant(surface, covers, v, e, further, motion, rules)
    reentrant &= (covers.own[v] != e) & (covers.before[v] != e)
    other = beside_kinks(surface, covers, surface.moves[v], e, further, rules)
    mate = np.where(other >= 0, surface.body[other], -1)
    merged = rays(surface, covers, v, surface.body[e], mate, rules)
    return alone & ~reentrant & _outward(surface, e, *merged, rules)


def _outward(surface: Surface, e: Ints, own: Floats, before: Floats, rules: Rules) -> Bools:
    """Whether both rays leave the edge's solid, and so does all between them."""
    normal = surface.normal[e]
    out_own, out_before = dot(own, normal), dot(before, normal)
    # Of two rays along the edge, those of a vertex of the far side run the other way about.
    flat = np.maximum(out_own, out_before) <= rules.sine
    back = flat & (dot(own, surface.direction[e]) > 0.0)
    return np.asarray((np.minimum(out_own, out_before) >= -rules.sine) & ~back)


def _closed(opening: Floats, aside: Floats, flush: Floats) -> Floats:
    """How far (m,) from its touching end an edge that opens from another is still flush (m)."""
    left = np.maximum(flush - aside, 0.0)
    return np.divide(left, opening, out=np.full_like(left, np.inf), where=opening > 0.0)


def covered_kinks(
    surface: Surface, covers: Covers, v: Ints, e: Ints, end: Bools, rules: Rules
) -> Bools:
    """Edges (m,) with a kink at an ``end``, beside which a body other than the vertices' covers."""
    corner = np.where(end, surface.next[e], e)
    x = np.where(end, covers.before[corner], covers.own[e])
    kink = ~convex_vertices(surface, rules)[corner]
    kink |= beside_kinks(surface, covers, surface.moves[v], e, end, rules) >= 0
    return np.asarray(kink & (x >= 0) & (surface.body[x] != surface.body[v]))


def shielded(
    surface: Surface,
    covers: Covers,
    v: Ints,
    e: Ints,
    along: Floats,
    gap: Floats,
    rules: Rules,
) -> Bools:
    """Feet of vertices on a stretch of edge, next to one of its ends, that a third body covers.

    The third body must leave less room than the vertex' own body needs: what is squeezed between
    two bodies that are flush for their size is no less there.
    """
    length, partner = surface.length[e], surface.body[v]
    room = rules.depth * surface.thickness[v] + rules.rounding
    foot = np.clip(along, 0.0, length)
    hidden = np.zeros(len(e), dtype=bool)
    total = np.zeros(len(e))
    for x, corner, far, distance, sense in (
        (covers.own[e], surface.start[e], surface.start, foot, 1.0),
        (covers.before[surface.next[e]], surface.end[e], surface.end, length - foot, -1.0),
    ):
        third = (x >= 0) & (surface.body[x] != partner)
        aside = np.abs(cross(surface.direction[x], corner - surface.start[x]))
        third &= aside <= room
        beside = np.abs(dot(far[x] - corner, surface.direction[e]))
        opening = sense * cross(surface.direction[e], surface.direction[x])
        beside = np.minimum(beside, _closed(opening, aside, flush_distance(surface, e, x, rules)))
        covered = np.where(third, beside, 0.0)
        whole = covered >= length - flush_distance(surface, e, x, rules)
        margin = np.minimum(rules.depth * thinner(surface, e, x), 0.5 * covered)
        inside = distance <= covered - margin
        hidden |= third & (inside | whole)
        total += covered
    hidden |= total >= length - rules.flush * surface.thickness[e]
    beside = np.minimum(foot, length - foot)
    at_end = np.maximum(beside, np.abs(gap)) <= flush_distance(surface, v, e, rules)
    return np.asarray(
        hidden & ~(at_end & covered_kinks(surface, covers, v, e, foot > beside, rules))
    )
