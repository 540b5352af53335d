"""Where on a step the first bond is at its limit: each by itself, by regula falsi (Illinois)."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from integration.arrays import Floats
from nmm.stepping.step.trial import Attempt

# Load over strength that is as good as one, and trials before the nearest one is taken.
CLOSE, MOST_TRIALS = 1e-10, 60
# Load over strength beyond one above which a bond cannot hold.
ABOVE = 1e-9
# How far off one the nearest trial may be, where balance is rounded: beyond it loads jump.
JUMP = 1e-6


@dataclass(frozen=True)
class TriedStep:
    """A trial: how far, what came of it, and load over strength of the joints' bonds there.

    ``each`` (k,) is in the order of the joints' points, and infinite where there is no solution.
    """

    way: float
    attempt: Attempt
    each: Floats

    @property
    def load(self) -> float:
        """Largest load over strength."""
        return float(self.each.max(initial=0.0))

    @property
    def over(self) -> float:
        """Load over strength beyond one."""
        return self.load - 1.0


def located(try_: Callable[[float], TriedStep], low: TriedStep, high: TriedStep) -> TriedStep:
    """Return the trial at one between two, of which the load of ``high`` is above one.

    Of ``low`` only its loads are read. Where a trial in between has no solution it is returned;
    where loads pass one by a jump, the nearest trial as one that has not converged and says so.
    """
    best, stays, beyond = high, [1.0, 1.0], None
    for _ in range(MOST_TRIALS):
        if abs(best.over) <= CLOSE or low.way == high.way:
            break
        found = try_(_crossing(low, high, stays))
        if not found.attempt.converged:
            return found
        best = min(best, found, key=lambda one: abs(one.over))
        again, beyond = beyond == (found.over > 0), found.over > 0
        # An end that stays once more counts half.
        part = 0.5 if again else 1.0
        if beyond:
            high, stays = found, [part * stays[0], 1.0]
        else:
            low, stays = found, [1.0, part * stays[1]]
    return best if abs(best.over) <= JUMP else _jumped(best, low, high)


def _jumped(nearest: TriedStep, low: TriedStep, high: TriedStep) -> TriedStep:
    """Return the nearest trial as one that is no balance at which a bond is at its limit."""
    sentence = (
        f"the load of the bond that gives way first jumps from {low.load:.6g} to "
        f"{high.load:.6g} of its strength, where 1 was expected in between"
    )
    return replace(nearest, attempt=replace(nearest.attempt, converged=False, sentence=sentence))


def _crossing(low: TriedStep, high: TriedStep, counts: list[float]) -> float:
    """Return how far the first bond is at its limit, if loads go in straight lines.

    Half way where one is infinite, as of a bond that shear would break under any such pull.
    """
    if not np.isfinite(high.load):
        return (low.way + high.way) / 2
    over = high.each > 1
    below, above = counts[0] * (1 - low.each[over]), counts[1] * (high.each[over] - 1)
    share = float((below / (below + above)).min())
    return low.way + share * (high.way - low.way)


def outward(try_: Callable[[float], TriedStep], still: TriedStep, way: float) -> TriedStep | None:
    """Return a trial on the other side of one than ``still``, each further by secants.

    None where there is none, as loads do not change; a trial without a solution where one is met.
    """
    before, now = still, try_(way)
    for _ in range(MOST_TRIALS):
        if not now.attempt.converged:
            return now
        if np.sign(now.over) != np.sign(still.over) or abs(now.over) <= CLOSE:
            return now
        if now.way == before.way or abs(now.load - still.load) <= CLOSE:
            return None
        slope = (now.load - before.load) / (now.way - before.way)
        further = 2 * now.way if slope == 0 else now.way - 1.01 * now.over / slope
        if further * now.way < 0:
            return None
        before, now = now, try_(further)
    return None
