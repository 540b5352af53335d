"""Tables of the compiled narrow phase: edges as they go in, contacts as they come out."""

import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from integration.arrays import Floats, Ints
from nmm.compiled import compiled
from nmm.contact.detection.tolerances import Rules

Small = npt.NDArray[np.int8]
"""States of rows."""
Columns = tuple[Ints, Ints, Floats, Floats, Floats, Ints, Ints, Ints, Ints]
"""Those of `narrow_phase.Contacts`."""

# Columns of Shape.real: start, end and unit direction, length of the edge, thickness of its body.
SX, SY, EX, EY, TX, TY, LENGTH, THICK = range(8)
# Columns of Shape.link: body, neighbours in the ring, whether the vertex is convex, and the flush
# covers of its two edges (`edges.cover`).
BODY, NEXT, PREVIOUS, CONVEX, OWN, BEFORE = range(6)


class Shape(NamedTuple):
    """All that is known of an edge and its first vertex, side by side in memory."""

    real: Floats  # (n, 8)
    link: Ints  # (n, 6)


@compiled
def shape_of(
    start: Floats, end: Floats, body: Ints, following: Ints, previous: Ints, sine: float
) -> Shape:
    """Directions, lengths, convexity of vertices and thickness of bodies."""
    n = len(start)
    real, link = np.zeros((n, 8)), np.empty((n, 6), np.int64)
    top = -1
    for e in range(n):
        real[e, SX], real[e, SY] = start[e, 0], start[e, 1]
        real[e, EX], real[e, EY] = end[e, 0], end[e, 1]
        dx, dy = end[e, 0] - start[e, 0], end[e, 1] - start[e, 1]
        size = math.sqrt(dx * dx + dy * dy)
        real[e, LENGTH] = size
        if size > 0.0:
            real[e, TX], real[e, TY] = dx / size, dy / size
        link[e, BODY], link[e, NEXT], link[e, PREVIOUS] = body[e], following[e], previous[e]
        link[e, OWN], link[e, BEFORE] = -1, -1
        top = max(top, body[e])
    first, area, around = np.full(top + 1, -1), np.zeros(top + 1), np.zeros(top + 1)
    for e in range(n):
        b, p = body[e], previous[e]
        turn = real[p, TX] * real[e, TY] - real[p, TY] * real[e, TX]
        link[e, CONVEX] = 1 if turn >= -sine else 0
        if first[b] < 0:
            first[b] = e
        ox, oy = real[first[b], SX], real[first[b], SY]
        area[b] += (real[e, SX] - ox) * (real[e, EY] - oy)
        area[b] -= (real[e, SY] - oy) * (real[e, EX] - ox)
        around[b] += real[e, LENGTH]
    for e in range(n):
        if around[body[e]] > 0.0:
            real[e, THICK] = abs(area[body[e]]) / around[body[e]]
    return Shape(real, link)


@compiled
def offsets(vertex: Ints, edge: Ints, count: int) -> tuple[Ints, bool]:
    """First row of each vertex, and whether the rows rise by vertex, then edge."""
    offset = np.zeros(count + 1, np.int64)
    rising = True
    for k in range(len(vertex)):
        offset[vertex[k] + 1] += 1
        if k > 0:
            same = vertex[k] == vertex[k - 1]
            rising &= vertex[k] > vertex[k - 1] or (same and edge[k] > edge[k - 1])
    for v in range(count):
        offset[v + 1] += offset[v]
    return offset, rising


@compiled
def describe(
    shape: Shape,
    vertex: Ints,
    edge: Ints,
    rows: Ints,
    final: Small,
    s: Floats,
    gap: Floats,
    rules: Rules,
) -> Columns:
    """Columns of `narrow_phase.Contacts` for the kept rows."""
    m, n = len(rows), len(shape.link)
    v, e, key = np.empty(m, np.int64), np.empty(m, np.int64), np.empty(m, np.int64)
    body, corner = np.empty(m, np.int64), np.empty(m, np.int64)
    kind = np.empty(m, np.int64)
    parameter, normal, distance = np.empty(m), np.empty((m, 2)), np.empty(m)
    for i in range(m):
        k = rows[i]
        v[i], e[i], distance[i] = vertex[k], edge[k], gap[k]
        x = e[i]
        key[i], body[i] = v[i] * n + x, shape.link[x, BODY]
        parameter[i] = min(max(s[k] / shape.real[x, LENGTH], 0.0), 1.0)
        normal[i, 0], normal[i, 1] = shape.real[x, TY], -shape.real[x, TX]
        corner[i] = shape.link[x, NEXT] if parameter[i] > 0.5 else x
        beside = min(abs(s[k]), abs(shape.real[x, LENGTH] - s[k]))
        thin = min(shape.real[v[i], THICK], shape.real[x, THICK])
        near = beside <= rules.flush * thin + rules.rounding
        kind[i] = 1 if near or final[k] == 2 else 0
    return v, e, parameter, normal, distance, kind, key, body, corner
