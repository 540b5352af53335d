"""The four lines of two near vertices, judged as a whole, over whole arrays."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from integration.arrays import Bools, Floats, Ints
from integration.plane_vectors import cross, dot
from nmm.contact.detection.measures import flush_distance, thinner
from nmm.contact.detection.surface import Surface
from nmm.contact.detection.tolerances import Rules
from nmm.testing.detection.flush import Covers, convex_vertices, rays


@dataclass(frozen=True, eq=False)
class VertexPairs:
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


def pair_rule(
    surface: Surface,
    pairs: VertexPairs,
    covers: Covers,
    kept: Ints,
    usable: Bools,
    rank: Floats,
    rules: Rules,
) -> None:
    """Judge the four lines at each pair of near vertices as a whole; change ``kept`` in place."""
    convex = convex_vertices(surface, rules)
    rows = np.flatnonzero((pairs.vertex < pairs.edge) & convex[pairs.vertex] & convex[pairs.edge])
    v, w = pairs.vertex[rows], pairs.edge[rows]
    offset = surface.start[v] - surface.start[w]
    radius = np.maximum(rules.reach, rules.depth * thinner(surface, v, w))
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
    beside = np.abs(cross(chosen, offset))
    merged = beside <= flush_distance(surface, v, w, rules)
    drop = standing & (~agree | merged) & (lines != picked)

    longest = np.stack([surface.length[k] for k in (v, before[v], w, before[w])]).max(axis=0)
    slop = rules.end * longest + rules.rounding
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
    own, before = rays(surface, covers, w, partner, np.full(len(w), -1), rules)
    return np.asarray((dot(offset, own) <= slop) & (dot(offset, before) <= slop))


def _best(pairs: VertexPairs, lines: Ints, among: Bools, rank: Floats) -> Ints:
    """Index of the line of highest rank, the smallest (vertex, edge) among equals."""
    value = np.where(among, rank[lines], -np.inf)
    top = among & (value == value.max(axis=0))
    return np.asarray(np.where(top, lines, len(pairs)).argmin(axis=0))


def _find(pairs: VertexPairs, vertex: Ints, edge: Ints) -> Ints:
    """Rows of (vertex, edge), -1 where the pair is no candidate."""
    key = pairs.key
    wanted = vertex * (len(pairs.offset) - 1) + edge
    row = np.minimum(np.searchsorted(key, wanted), max(len(key) - 1, 0))
    return np.where(key[row] == wanted, row, -1).astype(np.int64)
