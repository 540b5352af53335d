"""Integrals along straight segments."""

from __future__ import annotations

import numpy as np

from integration import gauss
from integration.arrays import Floats


def segment_rule(start: Floats, end: Floats, order: int) -> tuple[Floats, Floats]:
    """Gauss points (S, q, 2) and weights (S, q) of segments, exact to degree ``order``.

    The weights of a segment add up to its length.
    """
    nodes, weights = gauss.interval(order // 2 + 1)
    along = end - start
    points = start[:, None, :] + nodes[:, None] * along[:, None, :]
    return points, np.hypot(*along.T)[:, None] * weights
