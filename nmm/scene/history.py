"""Piecewise linear histories of loads and supports."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence


def factor(history: Sequence[tuple[float, float]] | None, time: float) -> float:
    """Factor of a history at a time: linear between its pairs, constant before and after them.

    No history means 1 at all times.
    """
    if history is None:
        return 1.0
    index = bisect_right(history, time, key=lambda pair: pair[0])
    if index == 0 or index == len(history):
        return history[max(index - 1, 0)][1]
    (t0, f0), (t1, f1) = history[index - 1], history[index]
    return f0 + (f1 - f0) * (time - t0) / (t1 - t0)
