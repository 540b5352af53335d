"""The instant within a step at which bodies meet: the first root of a gap.

A step that goes on over an impact turns speeds somewhere within it, and where it falls decides how
bodies rebound. One that ends as they meet leaves the impact to steps that begin with it. The root
is sought from below, by steps from the same start: each is one solution, and the last one is the
step that ends there.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Self

import numpy as np
from scipy.sparse import csr_array

from integration.arrays import Floats, Ints
from nmm.assembly.state import State
from nmm.stepping.step.trial import Attempt

# Share of a step within which bodies meet where it ends; solutions that the root is sought by.
MEETING, SOLUTIONS = 1e-6, 8
# Share of the way to a foreseen root that is gone: roots are met from below.
SHORT = 1 - 1e-3


@dataclass(frozen=True)
class ClosingContacts:
    """Contacts (k,) that were open where a step began and push where it ends.

    Attributes
    ----------
    key, gap
        Their keys, and gaps where the step began (m).
    rows
        (k, n) by how much gaps grow with the unknowns.
    """

    key: Ints
    gap: Floats
    rows: csr_array

    @classmethod
    def of(
        cls, attempt: Attempt, start: State, pushed: Ints, slowest: float, soonest: float
    ) -> Self | None:
        """Return what comes to push in an attempt and had not ``pushed`` (p,) before it.

        Contacts count that close faster than ``slowest`` (m/s) and later than ``soonest`` (s).
        """
        solved = attempt.solved
        if solved is None or solved.rows is None or not attempt.converged:
            return None
        points = solved.contacts
        length = attempt.state.time - start.time
        comes = (solved.answer.normal_force < 0) & ~np.isin(points.key, pushed)
        rate = np.maximum(-(solved.rows.normal @ start.velocity), points.gap / length)
        chosen = np.flatnonzero(comes & (rate > slowest) & (points.gap > soonest * rate))
        if not len(chosen):
            return None
        return cls(points.key[chosen], points.gap[chosen], solved.rows.normal[chosen])

    def first(
        self, start: State, attempts: Callable[[State, float], Attempt], end: float, least: float
    ) -> Attempt | None:
        """Return the attempt that ends as the first of them closes; None where none is found.

        ``attempts`` solves a step to a time; all close before the time ``end`` (s), and where they
        close is found to ``least`` (s) or nearer.
        """
        low, high, known = start.time, end, None
        near = min(MEETING * (end - start.time), least)
        gap, rate = self.gap, self.rows @ start.velocity
        begun = rate
        for _ in range(SOLUTIONS):
            gained = (
                (rate - begun) / (low - start.time) if known is not None else np.zeros(len(gap))
            )
            ahead = _soonest(gap, rate, gained)
            if known is not None and ahead <= near:
                return known
            to = low + SHORT * ahead
            if not low < to < high:
                to = (low + high) / 2
            found = attempts(start, to)
            if not found.converged:
                return None
            if self._pushes(found):
                high = to
            else:
                low, known = to, found
                gap = self.gap + self.rows @ found.increment
                rate = self.rows @ found.state.velocity
        return known

    def _pushes(self, attempt: Attempt) -> bool:
        """Whether any of them pushes at the end of an attempt."""
        return attempt.solved is not None and bool(np.isin(self.key, attempt.solved.pushing).any())


def _soonest(gap: Floats, rate: Floats, gained: Floats) -> float:
    """Return when the first of gaps (k,) closes, whose ``rate`` grows by ``gained`` a second.

    The smaller positive root of ``gap + rate t + gained t^2 / 2``, in the form without differences.
    """
    under = rate**2 - 2 * gained * gap
    closes = (under >= 0) & (np.sqrt(np.maximum(under, 0)) > rate)
    if not closes.any():
        return float(np.inf)
    times = 2 * gap[closes] / (np.sqrt(under[closes]) - rate[closes])
    return float(np.maximum(times, 0.0).min())
