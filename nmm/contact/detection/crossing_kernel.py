"""Which pairs of a vertex and an edge can come too deep in a step, compiled."""

import math

import numpy as np

from integration.arrays import Floats, Ints
from nmm.compiled import compiled


@compiled
def _thickness(start: Floats, end: Floats, body: Ints) -> Floats:
    """Twice the area over the perimeter (B,) of bodies, as `Surface.thickness`."""
    count = 0
    for e in range(len(body)):
        count = max(count, body[e] + 1)
    first = np.full(count, -1)
    twice, around = np.zeros(count), np.zeros(count)
    for e in range(len(body)):
        b = body[e]
        if first[b] < 0:
            first[b] = e
        x, y = start[first[b], 0], start[first[b], 1]
        twice[b] += (start[e, 0] - x) * (end[e, 1] - y) - (start[e, 1] - y) * (end[e, 0] - x)
        around[b] += math.hypot(end[e, 0] - start[e, 0], end[e, 1] - start[e, 1])
    for b in range(count):
        twice[b] = abs(twice[b]) / around[b] if around[b] > 0.0 else 0.0
    return twice


@compiled
def can_meet(
    start: Floats,
    end: Floats,
    after: Floats,
    following: Ints,
    body: Ints,
    vertex: Ints,
    edge: Ints,
    depth: float,
) -> Ints:
    """Rows of the pairs of which neither the motions nor the start excludes a crossing.

    Where no end of an edge moves by more than an eighth of its length, a vertex that comes too deep
    does more than three quarters of it along the normal at the start; half is on the safe side.

    Parameters
    ----------
    start, end, after
        (n, 2) ends of the edges at the start of the step, and their starts after it.
    following, body
        (n,) next edges, and their bodies.
    vertex, edge
        (m,) the pairs.
    depth
        Share of the thickness of the thinner body that is too deep.
    """
    thickness = _thickness(start, end, body)
    moved = np.empty(len(start))
    for v in range(len(start)):
        moved[v] = math.hypot(after[v, 0] - start[v, 0], after[v, 1] - start[v, 1])
    found = np.empty(len(vertex), dtype=np.int64)
    count = 0
    for k in range(len(vertex)):
        v, e = vertex[k], edge[k]
        dx, dy = end[e, 0] - start[e, 0], end[e, 1] - start[e, 1]
        length = math.hypot(dx, dy)
        ox, oy = start[v, 0] - start[e, 0], start[v, 1] - start[e, 1]
        inside = (dx * oy - dy * ox) / length if length > 0.0 else 0.0
        relative = moved[v] + max(moved[e], moved[following[e]])
        deepest = inside + relative
        if deepest < 0.0:
            continue
        allowed = depth * min(thickness[body[v]], thickness[body[e]])
        if relative > 0.125 * length or deepest >= 0.5 * allowed:
            found[count] = k
            count += 1
    return found[:count].copy()
