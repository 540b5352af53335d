"""Which pairs of a vertex and an edge can come too deep in a step, compiled."""

import math

import numpy as np

from integration.arrays import Floats, Ints
from nmm.compiled import compiled
from nmm.contact.detection.narrow.tables import thickness_of
from nmm.contact.detection.tolerances import SWEPT_AREA


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
    Of what goes on, as all that slides fast, the largest area that the step reaches decides.

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
    thickness = thickness_of(start, end, body)
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
            wx, wy = after[following[e], 0] - after[e, 0], after[following[e], 1] - after[e, 1]
            px, py = after[v, 0] - after[e, 0], after[v, 1] - after[e, 1]
            most = _largest_area((dx, dy), (ox, oy), (wx, wy), (px, py))
            # Whoever looks closer takes lengths and thickness rounded another way.
            if most >= (1.0 - SWEPT_AREA) * allowed * length:
                found[count] = k
                count += 1
    return found[:count].copy()


@compiled
def _largest_area(
    edge: tuple[float, float],
    offset: tuple[float, float],
    edge_after: tuple[float, float],
    offset_after: tuple[float, float],
) -> float:
    """Largest of ``cross(edge, offset)`` while both change evenly: a quadratic in time.

    It is that of the terms' sizes, times `SWEPT_AREA`, larger than found.
    """
    ex, ey = edge_after[0] - edge[0], edge_after[1] - edge[1]
    ox, oy = offset_after[0] - offset[0], offset_after[1] - offset[1]
    first = edge[0] * offset[1] - edge[1] * offset[0]
    square = ex * oy - ey * ox
    slope = edge[0] * oy - edge[1] * ox + ex * offset[1] - ey * offset[0]
    most = max(first, first + slope + square)
    if square < 0.0 and 0.0 < slope < -2.0 * square:
        most = max(most, first - 0.25 * slope * slope / square)
    size = abs(edge[0] * offset[1]) + abs(edge[1] * offset[0]) + abs(slope) + abs(square)
    return most + SWEPT_AREA * size
