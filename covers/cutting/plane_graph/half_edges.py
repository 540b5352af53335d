"""Faces of a plane graph: half-edges with the face on their left hand (Muller, Preparata 1978)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from covers.cutting.components import components
from integration.arrays import Floats, Ints
from integration.permutations import inverse


@dataclass(frozen=True)
class HalfEdges:
    """Half-edges ``2 e`` (first to second point of edge ``e``) and ``2 e + 1`` (back).

    Attributes
    ----------
    origin, head : (2 n,)
        start and end point of each half-edge.
    next, previous : (2 n,)
        next and previous half-edge around the face on the left.
    loop : (2 n,)
        number of its closed loop.
    angle : (2 n,)
        direction, rad.
    """

    origin: Ints
    head: Ints
    next: Ints
    previous: Ints
    loop: Ints
    angle: Floats

    @property
    def n_loops(self) -> int:
        """Number of closed loops."""
        return int(self.loop.max(initial=-1)) + 1


def half_edges(steps: Floats, edges: Ints) -> HalfEdges:
    """Return the half-edges of noded edges (n, 2) between points ``steps`` (V, 2)."""
    origin, head = edges.ravel(), edges[:, ::-1].ravel()
    away = steps[head] - steps[origin]
    angle = np.arctan2(away[:, 1], away[:, 0])
    order = np.lexsort((angle, origin))
    ordered = origin[order]
    begins = np.ones(len(order), dtype=bool)
    begins[1:] = ordered[1:] != ordered[:-1]
    start = np.flatnonzero(begins)
    clockwise = np.empty_like(order)
    clockwise[order] = np.roll(order, 1)
    last = np.append(start[1:], len(order)) - 1
    clockwise[order[start]] = order[last]
    following = clockwise[np.arange(len(origin)) ^ 1]
    loop = components(len(origin), np.arange(len(origin)), following)
    return HalfEdges(origin, head, following, inverse(following), loop, angle)


def walks(following: Ints, start: Ints, length: Ints) -> Ints:
    """Members of closed loops (k,), one after the other, each from its ``start`` (k,)."""
    begin = np.cumsum(length) - length
    out = np.empty(int(length.sum()), dtype=np.int64)
    current, active, step = start.copy(), np.arange(len(start)), 0
    while len(active):  # one pass for each place in the longest loop, for all loops at once
        out[begin[active] + step] = current
        step += 1
        active = active[length[active] > step]
        current = following[out[begin[active] + step - 1]]
    return out
