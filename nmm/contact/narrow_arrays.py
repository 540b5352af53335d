"""Narrow phase over whole arrays: the slower form that the compiled one is tested against.

The rules are told in `narrow`. A *row* is a candidate pair of a vertex and an edge, a *ray* the
direction in which one of the two edges at a vertex leaves it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from integration.arrays import Bools, Floats, Ints
from nmm.contact.surface import Surface

# Bodies around one point that a vertex may be merged with, on either side.
WALK = 4


class Rules(NamedTuple):
    """Numbers of the narrow phase, see `narrow`.

    Attributes
    ----------
    reach, grain, rounding
        Largest gap, the step in which gaps are ranked, and the rounding of coordinates (m).
    depth, flush
        Fractions of the thickness of the thinner body.
    sine
        Of the angular tolerance.
    """

    reach: float
    grain: float
    rounding: float
    depth: float
    flush: float
    sine: float


@dataclass(frozen=True, eq=False)
class Pairs:
    """Candidate rows, sorted by vertex, then edge; those of ``v`` begin at ``offset[v]``."""

    vertex: Ints
    edge: Ints
    offset: Ints

    def __len__(self) -> int:
        return len(self.vertex)

    @property
    def key(self) -> Ints:
        """(m,) rising numbers of the rows."""
        return self.vertex * (len(self.offset) - 1) + self.edge


@dataclass(frozen=True, eq=False)
class Covers:
    """Edges of other bodies that lie flush on the two edges of each vertex, next to it; or -1."""

    own: Ints
    before: Ints


def select(
    surface: Surface, pairs: Pairs, rules: Rules, last: Bools, motion: Floats
) -> tuple[Ints, Floats, Floats]:
    """Return kept (m,), along (m,) and gap (m,) of all rows.

    ``kept`` is 0 for no contact, 1 for a vertex over an edge, 2 for a vertex beyond its end;
    ``along`` the foot's distance from the start of the edge. ``last`` marks rows that were
    contacts before, ``motion`` (n, 2) is what each vertex is expected to move.
    """
    v, e = pairs.vertex, pairs.edge
    along, gap = measure(surface, v, e)
    covers = _covers(surface, v, e, along, gap, rules)
    length = surface.length[e]
    # A contact stays a little beyond the end of its edge, lest two vertices take turns.
    slop = np.where(last, _flush(surface, v, e, rules), 1e-9 * length + rules.rounding)
    interior = (along >= -slop) & (along <= length + slop)
    # In one body the far face of a thin neck looks like a face that is overlapped.
    trusted = last | (surface.body[v] != surface.body[e])
    depth = np.where(trusted, rules.depth, rules.flush) * _thinner(surface, v, e)
    usable = _convex(surface, rules)[v] & (gap >= -depth) & (gap <= rules.reach)
    usable &= _leaves(surface, covers, v, e, rules)
    usable &= ~_shielded(surface, covers, e, along, surface.body[v], rules)
    rank = _rank(surface, v, e, along, gap, last, motion, rules)
    kept = np.where(interior & usable, 1, 0)
    kept[_dominated(surface, pairs, kept == 1, interior, gap, rank, rules)] = -1
    _pair_rule(surface, pairs, covers, kept, usable, rank, rules)
    return np.maximum(kept, 0), along, gap


def measure(surface: Surface, v: Ints, e: Ints) -> tuple[Floats, Floats]:
    """Foot along the edge and signed distance of its line, both from the nearer end."""
    p, t, length = surface.start[v], surface.direction[e], surface.length[e]
    from_start, from_end = p - surface.start[e], p - surface.end[e]
    first = _dot(from_start, t) <= 0.5 * length
    offset = np.where(first[:, None], from_start, from_end)
    return _dot(offset, t) + np.where(first, 0.0, length), -_cross(t, offset)


def _dot(a: Floats, b: Floats) -> Floats:
    return np.asarray(a[:, 0] * b[:, 0] + a[:, 1] * b[:, 1])


def _cross(a: Floats, b: Floats) -> Floats:
    return np.asarray(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])


def _convex(surface: Surface, rules: Rules) -> Bools:
    """Vertices whose solid angle is at most a half turn, within the angular tolerance."""
    turn = _cross(surface.direction[surface.previous], surface.direction)
    return np.asarray(turn >= -rules.sine)


def _thinner(surface: Surface, one: Ints, other: Ints) -> Floats:
    """Thickness (m) of the thinner of two bodies, each given by an edge."""
    return np.minimum(surface.thickness[one], surface.thickness[other])


def _flush(surface: Surface, one: Ints, other: Ints, rules: Rules) -> Floats:
    """Distance (m) below which the edges of two bodies count as flush."""
    return np.asarray(rules.flush * _thinner(surface, one, other) + rules.rounding)


def _covers(surface: Surface, v: Ints, e: Ints, along: Floats, gap: Floats, rules: Rules) -> Covers:
    """Find, for both edges at each vertex, the flush opposite edge that runs along them furthest.

    A corner pressed into the joint between two bodies is flush with both for its own depth only.
    """
    cosine = np.sqrt(1.0 - rules.sine**2)
    other = surface.body[v] != surface.body[e]
    flush = _flush(surface, v, e, rules)
    found = []
    for side, inward in ((v, 1.0), (surface.previous[v], -1.0)):
        opposite = _dot(surface.direction[side], surface.direction[e]) <= -cosine
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


def _rays(
    surface: Surface, covers: Covers, v: Ints, partner: Ints, rules: Rules
) -> tuple[Floats, Floats]:
    """Rays of the vertices ``v`` as bodies other than the flush neighbours meet them.

    A vertex is merged with the bodies that lie flush on its sides, the partner apart, as long as
    the union is convex; else its own rays stand.
    """
    own, before = surface.direction[v], -surface.direction[surface.previous[v]]
    ray_own, walked = _walk(surface, covers, v, partner, own, before, True, rules)
    ray_before, also = _walk(surface, covers, v, partner, before, ray_own, False, rules)
    good = (walked & also)[:, None]
    return np.where(good, ray_own, own), np.where(good, ray_before, before)


def _walk(
    surface: Surface,
    covers: Covers,
    v: Ints,
    partner: Ints,
    ray: Floats,
    across: Floats,
    forward: bool,
    rules: Rules,
) -> tuple[Floats, Bools]:
    """Turn one ray of each vertex over its flush neighbours; tell where the union stays convex."""
    convex = _convex(surface, rules)
    cover = covers.own if forward else covers.before
    at, ray, good = v.copy(), ray.copy(), np.ones(len(v), dtype=bool)
    going = np.ones(len(v), dtype=bool)
    for _ in range(WALK):
        x = np.where(going, cover[at], -1)
        body = surface.body[x]
        going = (x >= 0) & (body != partner) & (body != surface.body[v])
        rows = np.flatnonzero(going & good)
        if not len(rows):
            break
        edge, here = x[rows], at[rows]
        corner = surface.next[edge] if forward else edge
        offset = surface.start[corner] - surface.start[here]
        meets = np.hypot(*offset.T) <= 2.0 * _flush(surface, here, edge, rules)
        turned = (
            surface.direction[corner] if forward else -surface.direction[surface.previous[corner]]
        )
        turn = _cross(turned, across[rows]) if forward else _cross(across[rows], turned)
        flat_or_less = turn >= -rules.sine
        full = (turn <= rules.sine) & (_dot(turned, across[rows]) > 0.0)
        good[rows] = meets & convex[corner] & flat_or_less & ~full
        at[rows], ray[rows] = corner, turned
    return ray, good


def _leaves(surface: Surface, covers: Covers, v: Ints, e: Ints, rules: Rules) -> Bools:
    """First-order entrance condition, for the vertex alone and with its flush neighbours."""
    own, before = surface.direction[v], -surface.direction[surface.previous[v]]
    alone = _outward(surface, e, own, before, rules)
    merged = _rays(surface, covers, v, surface.body[e], rules)
    return alone & _outward(surface, e, *merged, rules)


def _outward(surface: Surface, e: Ints, own: Floats, before: Floats, rules: Rules) -> Bools:
    """Whether both rays leave the edge's solid, and so does all between them."""
    normal = surface.normal[e]
    out_own, out_before = _dot(own, normal), _dot(before, normal)
    # Of two rays along the edge, those of a vertex of the far side run the other way about.
    flat = np.maximum(out_own, out_before) <= rules.sine
    back = flat & (_dot(own, surface.direction[e]) > 0.0)
    return np.asarray((np.minimum(out_own, out_before) >= -rules.sine) & ~back)


def _shielded(
    surface: Surface, covers: Covers, e: Ints, along: Floats, partner: Ints, rules: Rules
) -> Bools:
    """Feet on a stretch of edge, next to one of its ends, that a third body covers."""
    length = surface.length[e]
    foot = np.clip(along, 0.0, length)
    hidden = np.zeros(len(e), dtype=bool)
    total = np.zeros(len(e))
    for x, corner, far, distance in (
        (covers.own[e], surface.start[e], surface.start, foot),
        (covers.before[surface.next[e]], surface.end[e], surface.end, length - foot),
    ):
        third = (x >= 0) & (surface.body[x] != partner)
        covered = np.where(third, np.abs(_dot(far[x] - corner, surface.direction[e])), 0.0)
        whole = covered >= length - _flush(surface, e, x, rules)
        margin = np.minimum(rules.depth * _thinner(surface, e, x), 0.5 * covered)
        inside = distance <= covered - margin
        hidden |= third & (inside | whole)
        total += covered
    return np.asarray(hidden | (total >= length - rules.flush * surface.thickness[e]))


def _rank(
    surface: Surface,
    v: Ints,
    e: Ints,
    along: Floats,
    gap: Floats,
    last: Bools,
    motion: Floats,
    rules: Rules,
) -> Floats:
    """Smallest gap over the step in whole grains, so that rounding does not choose."""
    s = np.clip(along / np.where(surface.length[e] > 0.0, surface.length[e], 1.0), 0.0, 1.0)
    of_edge = motion[e] + s[:, None] * (motion[surface.next[e]] - motion[e])
    ahead = gap + _dot(motion[v] - of_edge, surface.normal[e])
    hold = rules.flush * _thinner(surface, v, e)
    rank = np.minimum(gap, ahead) + np.where(last, hold, 0.0)
    return np.asarray(np.floor(rank / rules.grain + 0.5))


def _dominated(
    surface: Surface,
    pairs: Pairs,
    tentative: Bools,
    interior: Bools,
    gap: Floats,
    rank: Floats,
    rules: Rules,
) -> Bools:
    """Rows over which another edge of the same body stands, seen from the same vertex.

    Of edges that bound a convex part of the body the one least penetrated is the entrance; and a
    vertex outside one of them has not entered through another.
    """
    e = pairs.edge
    i, j = _same_vertex(pairs, np.flatnonzero(tentative))
    keep = interior[j] & (i != j) & (surface.body[e[i]] == surface.body[e[j]])
    i, j = i[keep], j[keep]
    mutual = _inside(surface, e[i], e[j], rules) & _inside(surface, e[j], e[i], rules)
    i, j = i[mutual], j[mutual]
    better = (rank[j] > rank[i]) | ((rank[j] == rank[i]) & (e[j] < e[i]))
    outside = ~tentative[j] & (gap[j] > rules.grain) & (gap[i] < 0.0)
    dominated = np.zeros(len(e), dtype=bool)
    dominated[i[(tentative[j] & better) | outside]] = True
    return dominated


def _same_vertex(pairs: Pairs, rows: Ints) -> tuple[Ints, Ints]:
    """All (row, other row) with the same vertex."""
    low, high = pairs.offset[pairs.vertex[rows]], pairs.offset[pairs.vertex[rows] + 1]
    count = high - low
    i = np.repeat(rows, count)
    j = np.arange(count.sum()) + np.repeat(low - (np.cumsum(count) - count), count)
    return i, j


def _inside(surface: Surface, one: Ints, other: Ints, rules: Rules) -> Bools:
    """Whether the middle of one edge is not outside the line of the other."""
    middle = 0.5 * (surface.start[one] + surface.end[one]) - surface.start[other]
    allowed = 0.5 * rules.sine * (surface.length[one] + surface.length[other])
    return np.asarray(_dot(middle, surface.normal[other]) <= allowed)


def _pair_rule(
    surface: Surface,
    pairs: Pairs,
    covers: Covers,
    kept: Ints,
    usable: Bools,
    rank: Floats,
    rules: Rules,
) -> None:
    """Judge the four lines at each pair of near vertices as a whole; change ``kept`` in place."""
    convex = _convex(surface, rules)
    rows = np.flatnonzero((pairs.vertex < pairs.edge) & convex[pairs.vertex] & convex[pairs.edge])
    v, w = pairs.vertex[rows], pairs.edge[rows]
    offset = surface.start[v] - surface.start[w]
    radius = np.maximum(rules.reach, rules.depth * _thinner(surface, v, w))
    near = np.hypot(*offset.T) <= radius
    v, w, offset = v[near], w[near], offset[near]
    before = surface.previous
    four = ((v, w), (v, before[w]), (w, v), (w, before[v]))
    lines = np.stack([_find(pairs, vertex, edge) for vertex, edge in four])
    exists = lines >= 0
    normal = surface.normal[pairs.edge[lines]] * np.array([1.0, 1.0, -1.0, -1.0])[:, None, None]
    standing = exists & (kept[lines] == 1)
    entered = (exists & (kept[lines] != 0)).any(axis=0)

    best = _best(pairs, lines, standing, rank)
    picked = lines[best, np.arange(len(v))]
    chosen = normal[best, np.arange(len(v))]
    agree = np.einsum("kij,ij->ki", normal, chosen) >= 1.0 - 2.0 * rules.sine**2
    # Contacts that are one above the other are one, however wide the gap.
    beside = np.abs(_cross(chosen, offset))
    merged = beside <= _flush(surface, v, w, rules)
    drop = standing & (~agree | merged) & (lines != picked)

    longest = np.stack([surface.length[k] for k in (v, before[v], w, before[w])]).max(axis=0)
    slop = 1e-9 * longest + rules.rounding
    apart = _beyond(surface, covers, w, surface.body[v], offset, slop, rules)
    apart &= _beyond(surface, covers, v, surface.body[w], -offset, slop, rules)
    free = exists & usable[lines]
    corner = apart & ~entered & free.any(axis=0)
    best = _best(pairs, lines, free, rank)
    kept[lines[drop]] = -1
    kept[lines[best, np.arange(len(v))][corner]] = 2


def _beyond(
    surface: Surface,
    covers: Covers,
    w: Ints,
    partner: Ints,
    offset: Floats,
    slop: Floats,
    rules: Rules,
) -> Bools:
    """Whether a point at ``offset`` from the vertex has its foot on neither of the rays."""
    own, before = _rays(surface, covers, w, partner, rules)
    return np.asarray((_dot(offset, own) <= slop) & (_dot(offset, before) <= slop))


def _best(pairs: Pairs, lines: Ints, among: Bools, rank: Floats) -> Ints:
    """Index of the line of highest rank, the smallest (vertex, edge) among equals."""
    value = np.where(among, rank[lines], -np.inf)
    top = among & (value == value.max(axis=0))
    return np.asarray(np.where(top, lines, len(pairs)).argmin(axis=0))


def _find(pairs: Pairs, vertex: Ints, edge: Ints) -> Ints:
    """Rows of (vertex, edge), -1 where the pair is no candidate."""
    key = pairs.key
    wanted = vertex * (len(pairs.offset) - 1) + edge
    row = np.minimum(np.searchsorted(key, wanted), max(len(key) - 1, 0))
    return np.where(key[row] == wanted, row, -1).astype(np.int64)
