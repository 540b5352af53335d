"""Where on a step a load over strength is one: regula falsi (Illinois)."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from nmm.stepping.step.trial import Attempt

# Load over strength that is as good as one, and trials before the nearest one is taken.
CLOSE, MOST = 1e-10, 60
# Load over strength beyond one above which a bond cannot hold.
ABOVE = 1e-9


@dataclass(frozen=True)
class Tried:
    """A trial: how far, what came of it, and the largest load over strength there."""

    way: float
    attempt: Attempt
    load: float

    @property
    def over(self) -> float:
        """Load over strength beyond one."""
        return self.load - 1.0


def located(try_: Callable[[float], Tried], low: Tried, high: Tried) -> Tried | None:
    """Return the trial between two, of which one load is above one and the other not.

    None where a trial in between has no solution.
    """
    left, right = low.over, high.over
    best = min(low, high, key=lambda one: abs(one.over))
    for _ in range(MOST):
        if abs(best.over) <= CLOSE or left == right:
            return best
        way = (low.way * right - high.way * left) / (right - left)
        found = try_(way)
        if not found.attempt.converged:
            return None
        best = min(best, found, key=lambda one: abs(one.over))
        if (found.over > 0) == (high.over > 0):
            high, right = found, found.over
            left /= 2
        else:
            low, left = found, found.over
            right /= 2
    return best


def outward(try_: Callable[[float], Tried], still: Tried, way: float) -> Tried | None:
    """Return a trial on the other side of one than ``still``, each further by secants.

    None where there is none: loads do not change, or a trial has no solution.
    """
    before, now = still, try_(way)
    for _ in range(MOST):
        if not now.attempt.converged:
            return None
        if np.sign(now.over) != np.sign(still.over) or abs(now.over) <= CLOSE:
            return now
        slope = (now.load - before.load) / (now.way - before.way)
        further = 2 * now.way if slope == 0 else now.way - 1.01 * now.over / slope
        if abs(now.load - still.load) <= CLOSE or further * now.way < 0:
            return None
        before, now = now, try_(further)
    return None
