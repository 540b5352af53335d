"""The load at which the next bond is at its limit, up or down from where a path stands."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from nmm.stepping.control.locating import ABOVE, TriedStep, located, outward
from nmm.stepping.control.position import OnPath
from nmm.stepping.control.trials import Trials
from nmm.stepping.control.verdicts import no_balance, no_event
from nmm.stepping.drive.verdict import RunVerdict


@dataclass(frozen=True)
class ReachedEvent:
    """Where a change of the load ends: where bonds give way, or else at the largest load.

    ``at_once`` says that they give way without one, as bonds that no load holds.
    """

    tried: TriedStep
    event: bool
    at_once: bool = False


def next_event(trials: Trials, at: OnPath, most: float) -> ReachedEvent | RunVerdict:
    """Change the load to where the next bond is at its limit, or to a factor of ``most``.

    Where no load holds all bonds, those that are loaded most under the load as it stands give way
    at once: `ReachedEvent.at_once`.
    """
    standing = trials.standing(at)

    def try_(change: float) -> TriedStep:
        return trials.of_load(standing, change)

    still = try_(0.0)
    if not still.attempt.converged:
        return no_balance(at, still.attempt)
    factor, found = at.state.load_factor, still
    if abs(still.over) > ABOVE:
        first = factor * (1 / still.load - 1) if factor and still.load else 1.0
        other = outward(try_, still, first or 1.0)
        if still.over > 0 and (other is None or not other.attempt.converged):
            # Less load that loads bonds more: the path goes on under a larger one.
            other = outward(try_, still, -first) or other
        if other is None and still.over > 0:
            return ReachedEvent(still, event=True, at_once=True)
        if other is None or not other.attempt.converged:
            end = no_event(at) if other is None else no_balance(at, other.attempt)
            return _at_most(try_, most - factor) or end
        low, high = sorted((still, other), key=lambda one: one.over)
        found = located(try_, low, high)
        if not found.attempt.converged:
            return no_balance(at, found.attempt)
    last = _at_most(try_, most - factor) if factor + found.way > most else None
    return last or ReachedEvent(replace(found, way=0.0), event=True)


def _at_most(try_: Callable[[float], TriedStep], change: float) -> ReachedEvent | None:
    """Return where the largest load stands; None where it is infinite, or bonds do not hold it."""
    if not np.isfinite(change):
        return None
    last = try_(change)
    holds = last.attempt.converged and last.load <= 1 + ABOVE
    return ReachedEvent(replace(last, way=0.0), event=False) if holds else None
