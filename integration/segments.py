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


def spread_rule(start: Floats, end: Floats, about: Floats, order: int) -> tuple[Floats, Floats]:
    """Points (S, q, 2) and shares (S, q) of what is spread evenly over segments, or at points.

    On rays from ``about`` (2,) the rule is that of `graded_rule`. The shares of each add up to one.
    """
    length = np.hypot(*(end - start).T)
    radial = np.abs(np.hypot(*(end - about).T) - np.hypot(*(start - about).T)) > length / 2
    points, weights = segment_rule(start, end, order)
    points[radial], weights[radial] = graded_rule(start[radial], end[radial], about, order)
    weights[length == 0] = 1.0
    return points, weights / weights.sum(axis=1, keepdims=True)


def graded_rule(start: Floats, end: Floats, about: Floats, order: int) -> tuple[Floats, Floats]:
    """Points (S, q, 2) and weights (S, q) for integrands smooth in the root of the distance.

    Parameters
    ----------
    start, end
        (S, 2) ends of the segments, at different distances from ``about`` (2,) or (S, 2), on whose
        rays they lie.
    """
    one, two = start - about, end - about
    a, b = (np.sqrt(np.hypot(*ends.T))[:, None] for ends in (one, two))
    nodes, weights = gauss.interval(order // 2 + 1)
    u, span = a + (b - a) * nodes, b**2 - a**2
    points = start[:, None] + ((u**2 - a**2) / span)[..., None] * (end - start)[:, None]
    length = np.hypot(*(end - start).T)[:, None]
    return points, length * 2 * u * (b - a) / span * weights
