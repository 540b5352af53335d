"""Compiled grid: all (vertex, edge) pairs within a distance, whatever the mixture of lengths."""

import math

import numpy as np

from integration.arrays import Floats, Ints
from integration.ragged import offsets
from nmm.compiled import compiled
from nmm.contact.detection.surface import Surface
from nmm.contact.detection.tolerances import REENTRANT
from nmm.solvers.kernels.ascending import extended


@compiled
def _column(a: Floats, b: Floats, left: float, right: float, reach: float) -> tuple[float, float]:
    """Range of y that a segment inflated by ``reach`` may take over a column of the grid."""
    if a[0] > b[0]:
        a, b = b, a
    dx, dy = b[0] - a[0], b[1] - a[1]
    low, high = a[1], b[1]
    if dx > 0.0:
        s0 = min(max((left - reach - a[0]) / dx, 0.0), 1.0)
        s1 = min(max((right + reach - a[0]) / dx, 0.0), 1.0)
        low, high = a[1] + s0 * dy, a[1] + s1 * dy
    return min(low, high) - reach, max(low, high) + reach


@compiled
def _entries(
    start: Floats,
    end: Floats,
    reaches: Floats,
    cell: float,
    rows: int,
    mask: int,
    count: Ints,
    edges: Ints,
    keys: Ints,
) -> None:
    """Visit the cells of every edge: count them by bucket, or store them when ``edges`` has room.

    A bucket holds several cells, so each entry keeps the key of its cell.
    """
    store = len(edges) > 0
    for e in range(len(start)):
        a, b, reach = start[e], end[e], reaches[e]
        first = math.floor((min(a[0], b[0]) - reach) / cell)
        last = math.floor((max(a[0], b[0]) + reach) / cell)
        for i in range(first, last + 1):
            low, high = _column(a, b, i * cell, (i + 1) * cell, reach)
            for j in range(math.floor(low / cell), math.floor(high / cell) + 1):
                bucket = _bucket(i, j, rows, mask)
                if store:
                    edges[count[bucket]] = e
                    keys[count[bucket]] = _key(i, j)
                count[bucket] += 1


@compiled
def _key(i: int, j: int) -> int:
    return (i << 32) ^ (j & 0xFFFFFFFF)


@compiled
def _bucket(i: int, j: int, rows: int, mask: int) -> int:
    """Cells in rows, wrapped around: neighbours stay neighbours, empty space costs nothing."""
    return (i * rows + j) & mask


@compiled
def _distance2(p: Floats, a: Floats, b: Floats) -> float:
    dx, dy = b[0] - a[0], b[1] - a[1]
    px, py = p[0] - a[0], p[1] - a[1]
    length2 = dx * dx + dy * dy
    if length2 > 0.0:
        s = min(max((px * dx + py * dy) / length2, 0.0), 1.0)
        px -= s * dx
        py -= s * dy
    return float(px * px + py * py)


@compiled
def _apart(start: Floats, end: Floats, following: Ints, previous: Ints, v: int, e: int) -> bool:
    """Whether vertex and edge of one body can meet: across a reentrant corner at the nearest."""
    before = previous[v]
    if e in (v, before):
        return False
    if e == following[v]:
        return _reentrant(start[v], end[v], end[e])
    if e == previous[before]:
        return _reentrant(start[e], end[e], start[v])
    return True


@compiled
def _reentrant(a: Floats, b: Floats, c: Floats) -> bool:
    """Whether a corner turns to the right, or straight back as the tip of a slit does."""
    ux, uy, wx, wy = b[0] - a[0], b[1] - a[1], c[0] - b[0], c[1] - b[1]
    turn, size = ux * wy - uy * wx, math.sqrt((ux * ux + uy * uy) * (wx * wx + wy * wy))
    return bool(turn <= REENTRANT * size and (turn < 0.0 or ux * wx + uy * wy < 0.0))


@compiled
def _search(
    start: Floats,
    end: Floats,
    body: Ints,
    following: Ints,
    previous: Ints,
    reaches: Floats,
    within: bool,
    cell: float,
    rows: int,
    offset: Ints,
    edges: Ints,
    keys: Ints,
) -> tuple[Ints, Ints]:
    """Test each vertex against the edges of its cell; rows come sorted by vertex, then edge."""
    n = len(start)
    mask = len(offset) - 2
    vertex = np.empty(4 * n + 16, np.int64)
    edge = np.empty(4 * n + 16, np.int64)
    found = 0
    for v in range(n):
        p = start[v]
        i, j = math.floor(p[0] / cell), math.floor(p[1] / cell)
        key, bucket = _key(i, j), _bucket(i, j, rows, mask)
        own, reach = body[v], reaches[v]
        for k in range(offset[bucket], offset[bucket + 1]):
            if keys[k] != key:
                continue
            e = edges[k]
            if body[e] == own and not (within and _apart(start, end, following, previous, v, e)):
                continue
            distance = min(reach, reaches[e])
            if _distance2(p, start[e], end[e]) > distance * distance:
                continue
            if found == len(vertex):
                vertex, edge = extended(vertex, 2 * found), extended(edge, 2 * found)
            vertex[found] = v
            edge[found] = e
            found += 1
    return vertex[:found].copy(), edge[:found].copy()


@compiled
def spread(now: Floats, then: Floats) -> float:
    """Return the diagonal of the box of all displacements: no two points moved apart by more."""
    low_x = high_x = low_y = high_y = 0.0
    for k in range(len(now)):
        x, y = now[k, 0] - then[k, 0], now[k, 1] - then[k, 1]
        if k == 0:
            low_x = high_x = x
            low_y = high_y = y
        low_x, high_x = min(low_x, x), max(high_x, x)
        low_y, high_y = min(low_y, y), max(high_y, y)
    return math.hypot(high_x - low_x, high_y - low_y)


def pairs_by_grid(surface: Surface, distance: Floats, within_bodies: bool) -> tuple[Ints, Ints]:
    """Return vertex and edge (m,) of all near pairs, sorted by vertex, then edge.

    A pair is near within the smaller ``distance`` (n,) of its two members. Edges are entered in
    every cell that they pass within their distance, and a vertex looks into its own cell only.
    Cells share buckets where the grid is sparse; their size is the geometric mean of the edges, so
    that neither many short edges share a cell nor long ones fill too many.
    """
    if not len(surface):
        return np.empty(0, np.int64), np.empty(0, np.int64)
    origin = surface.start.min(axis=0)
    start, end = (np.ascontiguousarray(one - origin) for one in (surface.start, surface.end))
    length = np.hypot(*(end - start).T)
    long = length[length > 0.0]
    typical = float(np.exp(np.log(long).mean())) if len(long) else 1.0
    # The second bound keeps the walk along very long edges at some tens of cells an edge.
    cell = max(typical, float((length + distance).mean()) / 64.0)
    # Larger than asked by rounding, lest a pair at the very distance is missed.
    reaches = distance * (1.0 + 1e-9) + 1e-12 * cell

    mask = (1 << max(4, int(2 * len(start)).bit_length())) - 1
    rows = int((start[:, 1].max() + reaches.max()) / cell) + 3
    nothing = np.empty(0, np.int64)
    count = np.zeros(mask + 1, np.int64)
    _entries(start, end, reaches, cell, rows, mask, count, nothing, nothing)
    offset = offsets(count)
    edges, keys = np.empty(offset[-1], np.int64), np.empty(offset[-1], np.int64)
    _entries(start, end, reaches, cell, rows, mask, offset[:-1].copy(), edges, keys)
    rings = start, end, surface.body, surface.next, surface.previous
    return _search(*rings, reaches, within_bodies, cell, rows, offset, edges, keys)
