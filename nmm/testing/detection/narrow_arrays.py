"""Narrow phase over whole arrays: the slower form that the compiled one is tested against.

The rules are told in `nmm.contact.detection.narrow_phase`. A *row* is a candidate pair of a vertex
and an edge.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from integration.arrays import Bools, Floats, Ints
from integration.plane_vectors import dot
from nmm.contact.detection.contacts import VERTEX_EDGE, Contacts
from nmm.contact.detection.measures import flush_distance, measure, rules_of, thinner
from nmm.contact.detection.narrow_phase import contacts_of
from nmm.contact.detection.surface import Surface, pair_key
from nmm.contact.detection.tolerances import Rules
from nmm.testing.detection.flush import (
    Covers,
    beside_kinks,
    convex_vertices,
    covered_kinks,
    find_covers,
    leaves,
    shielded,
    within_kinks,
)
from nmm.testing.detection.pair_arrays import VertexPairs, pair_rule


def find_by_arrays(
    surface: Surface,
    vertex: Ints,
    edge: Ints,
    reach: float,
    last: Contacts | None = None,
    motion: Floats | None = None,
) -> Contacts:
    """Return what `nmm.contact.detection.narrow_phase.find_contacts` does."""
    rules = rules_of(surface, reach)
    motion = np.zeros_like(surface.start) if motion is None else motion
    key = np.unique(pair_key(surface, vertex, edge))
    vertex, edge = np.divmod(key, max(len(surface), 1))
    known = np.zeros(len(key), dtype=bool) if last is None else np.isin(key, last.key)
    offset = np.searchsorted(vertex, np.arange(len(surface) + 1)).astype(np.int64)
    kept, along, gap = select(surface, VertexPairs(vertex, edge, offset), rules, known, motion)
    rows = np.flatnonzero(kept)
    parts = (vertex[rows], edge[rows], along[rows], gap[rows], kept[rows] == 2)
    found = contacts_of(surface, *parts, rules)
    # In a kink of two a corner stands for one edge alone.
    covers = find_covers(surface, vertex, edge, along, gap, rules)
    moves, ends = surface.moves[found.vertex], found.parameter > 0.5
    apart = beside_kinks(surface, covers, moves, found.edge, ends, rules) >= 0
    return replace(found, kind=np.where(apart, VERTEX_EDGE, found.kind))


def select(
    surface: Surface, pairs: VertexPairs, rules: Rules, last: Bools, motion: Floats
) -> tuple[Ints, Floats, Floats]:
    """Return kept (m,), along (m,) and gap (m,) of all rows.

    ``kept`` is 0 for no contact, 1 for a vertex over an edge, 2 for a vertex beyond its end;
    ``along`` the foot's distance from the start of the edge. ``last`` marks rows that were
    contacts before, ``motion`` (n, 2) is what each vertex is expected to move.
    """
    v, e = pairs.vertex, pairs.edge
    along, gap = measure(surface, v, e)
    covers = find_covers(surface, v, e, along, gap, rules)
    length = surface.length[e]
    # A contact stays a little beyond the end of its edge, lest two vertices take turns; in a
    # covered kink both edges bound the way.
    flush, sharp = flush_distance(surface, v, e, rules), rules.end * length + rules.rounding
    convex = convex_vertices(surface, rules)
    ends = (np.full(len(e), end) for end in (False, True))
    kinks = [last | covered_kinks(surface, covers, v, e, end, rules) for end in ends]
    interior = along >= -np.where(kinks[0], flush, sharp)
    interior &= along <= length + np.where(kinks[1], flush, sharp)
    # In one body the far face of a thin neck looks like a face that is overlapped.
    trusted = last | (surface.body[v] != surface.body[e])
    depth = np.where(trusted, rules.depth, rules.flush) * thinner(surface, v, e)
    usable = (length > 0.0) & convex[v]
    usable &= (gap >= -depth) & (gap <= rules.reach)
    usable &= leaves(surface, covers, v, e, along, motion, rules)
    usable &= ~shielded(surface, covers, v, e, along, gap, rules)
    rank = _rank(surface, v, e, along, gap, last, motion, rules)
    kept = np.where(interior & usable, 1, 0)
    kept[_dominated(surface, pairs, covers, kept == 1, interior, along, gap, rank, rules)] = -1
    pair_rule(surface, pairs, covers, kept, usable, rank, rules)
    return np.maximum(kept, 0), along, gap


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
    ahead = gap + dot(motion[v] - of_edge, surface.normal[e])
    hold = rules.flush * thinner(surface, v, e)
    rank = np.minimum(gap, ahead) + np.where(last, hold, 0.0)
    return np.asarray(np.floor(rank / rules.grain + 0.5))


def _dominated(
    surface: Surface,
    pairs: VertexPairs,
    covers: Covers,
    tentative: Bools,
    interior: Bools,
    along: Floats,
    gap: Floats,
    rank: Floats,
    rules: Rules,
) -> Bools:
    """Rows over which another edge of the same body stands, seen from the same vertex.

    Of edges that bound a convex part of the body the one least penetrated is the entrance; and a
    vertex outside one of them has not entered through another, unless its own edges do pass there.
    """
    e = pairs.edge
    i, j = _same_vertex(pairs, np.flatnonzero(tentative))
    keep = interior[j] & (i != j) & (surface.body[e[i]] == surface.body[e[j]])
    i, j = i[keep], j[keep]
    mutual = _inside(surface, e[i], e[j], rules) & _inside(surface, e[j], e[i], rules)
    i, j = i[mutual], j[mutual]
    better = (rank[j] > rank[i]) | ((rank[j] == rank[i]) & (e[j] < e[i]))
    outside = ~tentative[j] & (gap[j] > rules.grain) & (gap[i] < 0.0)
    some = np.flatnonzero(outside)
    row = j[some]
    outside[some] = ~_passes(surface, pairs.vertex[row], e[row], along[row], gap[row])
    some = np.flatnonzero(outside)
    known = pairs.vertex[i[some]], e[i[some]], e[j[some]]
    outside[some] = ~within_kinks(surface, covers, *known, rules)
    dominated = np.zeros(len(e), dtype=bool)
    dominated[i[(tentative[j] & better) | outside]] = True
    return dominated


def _same_vertex(pairs: VertexPairs, rows: Ints) -> tuple[Ints, Ints]:
    """All (row, other row) with the same vertex."""
    low, high = pairs.offset[pairs.vertex[rows]], pairs.offset[pairs.vertex[rows] + 1]
    count = high - low
    i = np.repeat(rows, count)
    j = np.arange(count.sum()) + np.repeat(low - (np.cumsum(count) - count), count)
    return i, j


def _passes(surface: Surface, v: Ints, e: Ints, along: Floats, gap: Floats) -> Bools:
    """Whether one of the edges at a vertex outside an edge passes through it."""
    found = np.zeros(len(v), dtype=bool)
    before = surface.previous[v]
    for ray, length in (
        (surface.direction[v], surface.length[v]),
        (-surface.direction[before], surface.length[before]),
    ):
        down = -dot(ray, surface.normal[e])
        there = (down > 0.0) & (gap <= down * length)
        way = np.divide(gap, down, out=np.zeros_like(gap), where=there)
        at = along + way * dot(ray, surface.direction[e])
        found |= there & (at > 0.0) & (at < surface.length[e])
    return found


def _inside(surface: Surface, one: Ints, other: Ints, rules: Rules) -> Bools:
    """Whether the middle of one edge is not outside the line of the other."""
    middle = 0.5 * (surface.start[one] + surface.end[one]) - surface.start[other]
    allowed = 0.5 * rules.sine * (surface.length[one] + surface.length[other])
    return np.asarray(dot(middle, surface.normal[other]) <= allowed)
