"""Which formulations pay: the Pareto front of error and seconds, and ratios at equal error."""

from collections.abc import Mapping, Sequence

import numpy as np

from integration.arrays import Bools, Floats

# Levels of relative error at which costs are compared.
LEVELS = (1e-1, 1e-2, 1e-3, 1e-4, 1e-5)


def front(cost: Sequence[float], error: Sequence[float]) -> Bools:
    """Say which points no other one beats in both cost and error."""
    c, e = np.asarray(cost, dtype=float), np.asarray(error, dtype=float)
    good = np.isfinite(c) & np.isfinite(e)
    beaten = (c[None] <= c[:, None]) & (e[None] <= e[:, None])
    beaten &= (c[None] < c[:, None]) | (e[None] < e[:, None])
    return np.asarray(good & ~(beaten & good[None]).any(axis=1))


def cost_at(level: float, cost: Sequence[float], error: Sequence[float]) -> float:
    """Least cost at which a formulation reaches an error, log-log between its own points.

    nan where it does not reach the level. A formulation whose worst point is already better costs
    what that point costs: nothing is extrapolated.
    """
    c, e = np.asarray(cost, dtype=float), np.asarray(error, dtype=float)
    good = np.isfinite(c) & np.isfinite(e) & (c > 0)
    order = np.argsort(c[good])
    c, e = c[good][order], np.minimum.accumulate(np.maximum(e[good][order], 1e-300))
    reached = np.flatnonzero(e <= level)
    if len(reached) == 0:
        return float("nan")
    first = int(reached[0])
    if first == 0 or e[first] == e[first - 1]:
        return float(c[first])
    share = np.log(level / e[first - 1]) / np.log(e[first] / e[first - 1])
    return float(c[first - 1] * (c[first] / c[first - 1]) ** share)


def costs_at_levels(
    points: Mapping[str, tuple[Sequence[float], Sequence[float]]],
) -> dict[str, Floats]:
    """Return the cost of each formulation (cost, error) at every level."""
    return {
        name: np.array([cost_at(level, cost, error) for level in LEVELS])
        for name, (cost, error) in points.items()
    }
