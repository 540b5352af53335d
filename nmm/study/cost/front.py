"""Which formulations pay: the Pareto front of error and seconds, and ratios at equal error."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from integration.arrays import Bools

# Levels of relative error at which costs are compared.
LEVELS = (1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 1e-4, 1e-5)
# At least so many of them lie among the errors, else so many decades at most are taken; errors that
# are smaller than the smallest are rounding.
FEWEST, MOST, SMALLEST = 2, 6, 1e-16


@dataclass(frozen=True)
class Cost:
    """What reaching an error costs; ``at_most`` when even the cheapest run is better than that."""

    value: float
    at_most: bool = False

    def __str__(self) -> str:
        return f"{'at most ' if self.at_most else ''}{self.value:.3g}"


def front(cost: Sequence[float], error: Sequence[float]) -> Bools:
    """Say which points no other one beats in both cost and error."""
    c, e = np.asarray(cost, dtype=float), np.asarray(error, dtype=float)
    good = np.isfinite(c) & np.isfinite(e)
    beaten = (c[None] <= c[:, None]) & (e[None] <= e[:, None])
    beaten &= (c[None] < c[:, None]) | (e[None] < e[:, None])
    return np.asarray(good & ~(beaten & good[None]).any(axis=1))


def cost_at(level: float, cost: Sequence[float], error: Sequence[float]) -> Cost | None:
    """Least cost at which a formulation reaches an error, log-log between its own points.

    None where it does not reach the level: nothing is extrapolated. What is dearer than a better
    point is passed over, so that one lucky sign change counts where it lies and no further.
    """
    c, e = np.asarray(cost, dtype=float), np.asarray(error, dtype=float)
    good = np.isfinite(c) & np.isfinite(e) & (c > 0)
    order = np.argsort(c[good])
    c, e = c[good][order], np.minimum.accumulate(np.maximum(e[good][order], 1e-300))
    reached = np.flatnonzero(e <= level)
    if len(reached) == 0:
        return None
    first = int(reached[0])
    if first == 0:
        return Cost(float(c[0]), at_most=bool(e[0] < level))
    share = np.log(level / e[first - 1]) / np.log(e[first] / e[first - 1])
    return Cost(float(c[first - 1] * (c[first] / c[first - 1]) ** share))


def levels_of(errors: Sequence[float]) -> tuple[float, ...]:
    """Return levels at which costs are compared: `LEVELS`, or decades where errors lie below them.

    Errors are of all formulations; those that are zero or not finite say nothing.
    """
    e = np.asarray(errors, dtype=float)
    e = e[np.isfinite(e) & (e > SMALLEST)]
    if not len(e) or sum(e.min() <= level <= e.max() for level in LEVELS) >= FEWEST:
        return LEVELS
    high, low = int(np.floor(np.log10(e.max()))), int(np.ceil(np.log10(e.min())))
    every = max(-(-(high - low + 1) // MOST), 1)
    return tuple(float(f"1e{power}") for power in range(high, low - 1, -every))


def costs_at_levels(
    points: Mapping[str, tuple[Sequence[float], Sequence[float]]],
    levels: Sequence[float] | None = None,
) -> dict[float, dict[str, Cost]]:
    """Return, for each level, the cost of each formulation (cost, error) that reaches it."""
    if levels is None:
        levels = levels_of([one for _, errors in points.values() for one in errors])
    return {
        level: {
            name: cost
            for name, (costs, errors) in points.items()
            if (cost := cost_at(level, costs, errors)) is not None
        }
        for level in levels
    }
