"""The rules of `nmm.contact.detection.narrow_phase`, one vertex after the other.

Numba's functions are written for the machine: no row leaves the cache between its tests, and the
names are those of the array form (`nmm.testing.detection`), which the tests hold equal to this one.
"""

import numpy as np

from integration.arrays import Bools, Floats, Ints
from nmm.compiled import compiled
from nmm.contact.detection.narrow.columns import Columns, describe
from nmm.contact.detection.narrow.edges import cover, measure
from nmm.contact.detection.narrow.lines import USABLE, dominate, judge, rank_of
from nmm.contact.detection.narrow.pairs import pair
from nmm.contact.detection.narrow.tables import EdgesOfVertex, Shape, Small, offsets, shape_of
from nmm.contact.detection.surface import Surface
from nmm.contact.detection.tolerances import Rules


@compiled
def _known(edge: Ints, offset: Ints, last: Ints) -> Bools:
    """Which rows were contacts before; both lists rise, so one walk along them tells."""
    n = len(offset) - 1
    known = np.zeros(len(edge), np.bool_)
    at = 0
    for v in range(n):
        for k in range(offset[v], offset[v + 1]):
            key = v * n + edge[k]
            while at < len(last) and last[at] < key:
                at += 1
            known[k] = at < len(last) and last[at] == key
    return known


@compiled
def select(
    shape: Shape, vertex: Ints, edge: Ints, offset: Ints, last: Ints, motion: Floats, rules: Rules
) -> tuple[Ints, Small, Floats, Floats]:
    """Return the kept rows, and kept, along and gap of all rows.

    ``kept`` is 0 for no contact, 1 for a vertex over an edge, 2 for one beyond its end; ``along``
    the foot's distance from the start of the edge; ``last`` keys of the last contacts, rising.
    """
    m, n = len(vertex), len(offset) - 1
    s, gap = np.empty(m), np.empty(m)
    for v in range(n):
        low, high = offset[v], offset[v + 1]
        for k in range(low, high):
            s[k], gap[k] = measure(shape, v, edge[k])
        cover(shape, v, EdgesOfVertex(edge, low, high, s, gap), rules)
    state, kept = np.empty(m, np.int8), np.empty(m, np.int8)
    rank = np.empty(m)
    known = _known(edge, offset, last)
    for v in range(n):
        low, high = offset[v], offset[v + 1]
        before = EdgesOfVertex(edge, low, high, s, gap)
        judge(shape, v, before, known, state, rules)
        for k in range(low, high):
            if state[k] & USABLE:
                rank[k] = rank_of(shape, motion, v, edge[k], s[k], gap[k], known[k], rules)
        dominate(shape, v, before, state, rank, kept, rules)
    final = kept.copy()
    for k in range(m):
        v, w = vertex[k], edge[k]
        if v < w and shape[v].convex and shape[w].convex:
            pair(shape, v, w, edge, offset, state, rank, kept, final, rules)
    rows, count = np.empty(m, np.int64), 0
    for k in range(m):
        if final[k] > 0:
            rows[count] = k
            count += 1
    return rows[:count].copy(), final, s, gap


@compiled
def _contacts(
    start: Floats,
    end: Floats,
    body: Ints,
    moves: Ints,
    weight: Floats,
    following: Ints,
    previous: Ints,
    vertex: Ints,
    edge: Ints,
    last: Ints,
    motion: Floats,
    rules: Rules,
) -> tuple[bool, Columns]:
    """Whether both lists rise, and if so the columns of `contacts.Contacts`."""
    offset, rising = offsets(vertex, edge, len(start))
    for k in range(1, len(last)):
        rising &= last[k] >= last[k - 1]
    if not rising:
        vertex, edge = vertex[:0], edge[:0]
        offset[:] = 0
    shape = shape_of(start, end, body, moves, (weight, motion), following, previous, rules.sine)
    rows, final, s, gap = select(shape, vertex, edge, offset, last, motion, rules)
    return rising, describe(shape, vertex, edge, rows, final, s, gap, rules)


def find(
    surface: Surface, vertex: Ints, edge: Ints, last: Ints, motion: Floats, rules: Rules
) -> Columns:
    """Columns of `contacts.Contacts`; candidates in any order, ``last`` keys in any order."""
    start, end = np.ascontiguousarray(surface.start), np.ascontiguousarray(surface.end)
    weight = np.ascontiguousarray(surface.falls)
    rings = start, end, surface.body, surface.moves, weight, surface.next, surface.previous
    rising, columns = _contacts(*rings, vertex, edge, last, motion, rules)
    if not rising:
        key = np.unique(vertex * len(start) + edge)
        vertex, edge = key // len(start), key % len(start)
        _, columns = _contacts(*rings, vertex, edge, np.sort(last), motion, rules)
    return columns
