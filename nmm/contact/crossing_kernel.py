"""Which pairs of a vertex and an edge can come too deep in a step, compiled."""

import math

import numba as nb
import numpy as np

from integration.arrays import Floats, Ints


@nb.njit(cache=True)
def can_meet(
    start: Floats,
    end: Floats,
    after: Floats,
    following: Ints,
    thickness: Floats,
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
    following, thickness
        (n,) next edges, and thickness of their bodies (m).
    vertex, edge
        (m,) the pairs.
    depth
        Share of the thickness of the thinner body that is too deep.
    """
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
        allowed = depth * min(thickness[v], thickness[e])
        if relative > 0.125 * length or deepest >= 0.5 * allowed:
            found[count] = k
            count += 1
    return found[:count].copy()
