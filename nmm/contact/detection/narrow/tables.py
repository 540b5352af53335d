"""The table of edges that the compiled narrow phase works on."""

import math
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from integration.arrays import Floats, Ints
from nmm.compiled import compiled

Small = npt.NDArray[np.int8]
"""States of rows."""


class EdgesOfVertex(NamedTuple):
    """The candidate edges before which one vertex stands: rows ``low`` to ``high`` of all.

    Attributes
    ----------
    edge, s, gap
        (m,) edge, foot along it and distance from its line, of all rows.
    """

    edge: Ints
    low: int
    high: int
    s: Floats
    gap: Floats


# Of an edge start, end and unit direction, its length, the thickness of its body, the acceleration
# of its weight and what its first vertex is expected to move; that body and what moves as one with
# it, neighbours in the ring, whether its first vertex is convex, and the flush covers of the two
# edges there (`edges.cover`).
REAL = "sx sy ex ey tx ty length thick wx wy mx my"
LINK = "body moves next previous convex own before"
EDGE = np.dtype([(name, float) for name in REAL.split()] + [(name, int) for name in LINK.split()])
Shape = npt.NDArray[Any]
"""All that is known of edges (n,) and their first vertices, a record `EDGE` each."""


@compiled
def thickness_of(start: Floats, end: Floats, body: Ints) -> Floats:
    """Twice the area over the perimeter (B,) of bodies, as `Surface.thickness`."""
    count = 0
    for e in range(len(body)):
        count = max(count, body[e] + 1)
    first, area, around = np.full(count, -1), np.zeros(count), np.zeros(count)
    for e in range(len(body)):
        b = body[e]
        if first[b] < 0:
            first[b] = e
        x, y = start[first[b], 0], start[first[b], 1]
        area[b] += (start[e, 0] - x) * (end[e, 1] - y)
        area[b] -= (start[e, 1] - y) * (end[e, 0] - x)
        dx, dy = end[e, 0] - start[e, 0], end[e, 1] - start[e, 1]
        around[b] += math.sqrt(dx * dx + dy * dy)
    for b in range(count):
        area[b] = abs(area[b]) / around[b] if around[b] > 0.0 else 0.0
    return area


@compiled
def shape_of(
    start: Floats,
    end: Floats,
    body: Ints,
    moves: Ints,
    drives: tuple[Floats, Floats],
    following: Ints,
    previous: Ints,
    sine: float,
) -> Shape:
    """Directions, lengths, convexity of vertices and thickness of bodies.

    ``drives`` are the weight (n, 2) and the motion (n, 2), which may be without rows.
    """
    weight, motion = drives
    shape, thickness = np.zeros(len(start), EDGE), thickness_of(start, end, body)
    for e in range(len(start)):
        edge = shape[e]
        edge.sx, edge.sy = start[e, 0], start[e, 1]
        edge.ex, edge.ey = end[e, 0], end[e, 1]
        dx, dy = end[e, 0] - start[e, 0], end[e, 1] - start[e, 1]
        size = math.sqrt(dx * dx + dy * dy)
        edge.length, edge.thick = size, thickness[body[e]]
        edge.wx, edge.wy = weight[e, 0], weight[e, 1]
        if len(motion) > 0:
            edge.mx, edge.my = motion[e, 0], motion[e, 1]
        if size > 0.0:
            edge.tx, edge.ty = dx / size, dy / size
        edge.body, edge.next, edge.previous = body[e], following[e], previous[e]
        edge.moves, edge.own, edge.before = moves[e], -1, -1
    for e in range(len(start)):
        edge, last = shape[e], shape[previous[e]]
        turn = last.tx * edge.ty - last.ty * edge.tx
        edge.convex = 1 if turn >= -sine else 0
    return shape


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
