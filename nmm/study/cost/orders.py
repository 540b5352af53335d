"""Observed orders of convergence, with confidence, and values extrapolated from the finest runs."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats


@dataclass(frozen=True)
class Order:
    """Slope of log error against log size.

    Attributes
    ----------
    value
        Least-squares slope.
    deviation
        Half width of its 95 % confidence interval; inf for fewer than three points.
    points
        How many it was fitted to.
    """

    value: float
    deviation: float
    points: int

    def __str__(self) -> str:
        width = f" +- {self.deviation:.2f}" if np.isfinite(self.deviation) else ""
        return f"{self.value:.2f}{width} ({self.points} points)"


def observed_order(sizes: Sequence[float], errors: Sequence[float]) -> Order:
    """Fit ``error = C size^order`` to points with finite, positive errors."""
    x, y = np.asarray(sizes, dtype=float), np.asarray(errors, dtype=float)
    good = np.isfinite(y) & (y > 0) & (x > 0)
    x, y = np.log(x[good]), np.log(y[good])
    n = len(x)
    if n < 2 or np.ptp(x) == 0:
        return Order(np.nan, np.inf, n)
    slope, offset = np.polyfit(x, y, 1)
    if n == 2:
        return Order(float(slope), np.inf, n)
    from scipy.stats import t as student

    rest = y - slope * x - offset
    deviation = np.sqrt(rest @ rest / (n - 2) / np.sum((x - x.mean()) ** 2))
    return Order(float(slope), float(student.ppf(0.975, n - 2) * deviation), n)


# Orders above this one, seen in three values, are often chance: they lessen no uncertainty.
TRUSTED = 2.0


@dataclass(frozen=True)
class Extrapolated:
    """A value beyond the finest run, with its uncertainty."""

    value: float
    uncertainty: float
    order: float


def richardson(sizes: Sequence[float], values: Sequence[float]) -> Extrapolated:
    """Extrapolate three values of falling size to size zero (Richardson 1911; Roache 1998).

    With sizes that do not fall by one ratio the order is found by iteration. Values that do not
    approach each other keep the finest one, and the whole of its last change as uncertainty.
    """
    order = np.argsort(sizes)[::-1][-3:]
    h, f = np.asarray(sizes, dtype=float)[order], np.asarray(values, dtype=float)[order]
    if len(f) < 3:
        spread = float(np.ptp(f)) if len(f) > 1 else float("inf")
        return Extrapolated(float(f[-1]), spread, float("nan"))
    first, second = f[1] - f[0], f[2] - f[1]
    if second == 0:
        return Extrapolated(float(f[2]), 0.0, float("inf"))
    # Changes that tend to a limit with an order above 0 fall faster than the logarithm of the size.
    if first / second <= np.log(h[0] / h[1]) / np.log(h[1] / h[2]) * (1 + 1e-9):
        return Extrapolated(float(f[2]), float(max(abs(first), abs(second))), float("nan"))
    p = _order_of(h, first / second)
    ratio = h[1] / h[2]
    correction = second / (ratio**p - 1)
    doubt = second / (ratio ** min(p, TRUSTED) - 1)
    return Extrapolated(float(f[2] + correction), float(abs(doubt)), p)


def _order_of(h: Floats, ratio: float) -> float:
    """Order p with (h0^p - h1^p) / (h1^p - h2^p) = ratio, by bisection."""

    def excess(p: float) -> float:
        return float((h[0] ** p - h[1] ** p) / (h[1] ** p - h[2] ** p)) - ratio

    low, high = 1e-3, 20.0
    for _ in range(80):
        middle = (low + high) / 2
        low, high = (middle, high) if excess(middle) < 0 else (low, middle)
    return (low + high) / 2
