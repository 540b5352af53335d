"""Integrals along straight segments."""

from __future__ import annotations

import numpy as np

from integration import gauss
from integration.arrays import Floats
from integration.monomials import count, powers


def segment_moments(
    start: Floats, end: Floats, degree: int, origin: Floats, scale: Floats
) -> Floats:
    """Integrals (S, K) of ((x - ox)/s)^a ((y - oy)/s)^b along each segment, exact.

    Parameters
    ----------
    start, end : (S, 2)
        ends of the segments.
    degree : int
        largest total degree a + b.
    origin, scale : (S, 2), (S,)
        centre of the monomials and the length that divides the coordinates; the line element is
        not scaled.
    """
    size = np.broadcast_to(np.asarray(scale, dtype=float), start.shape[:1])
    x, y = ((start - origin) / size[:, None]).T
    dx, dy = ((end - start) / size[:, None]).T
    out = np.zeros((count(degree), len(start)))
    for t, w in zip(*gauss.interval(degree // 2 + 1), strict=True):
        out += w * powers(x + t * dx, y + t * dy, degree)
    return np.ascontiguousarray((out * np.hypot(*(end - start).T)).T)


def segment_rule(start: Floats, end: Floats, order: int) -> tuple[Floats, Floats]:
    """Gauss points (S, q, 2) and weights (S, q) of segments, exact to degree ``order``.

    The weights of a segment add up to its length.
    """
    nodes, weights = gauss.interval(order // 2 + 1)
    along = end - start
    points = start[:, None, :] + nodes[:, None] * along[:, None, :]
    return points, np.hypot(*along.T)[:, None] * weights
