"""The energy that would flow into running tips if they stood still."""

from dataclasses import dataclass, replace

import numpy as np

from integration.arrays import Floats, Ints
from nmm.fracture.growth.tips.over_fronts import OverFronts

# Largest part of Rayleigh's speed at which the flow at rest is told from that of the running tip.
FASTEST = 0.9


@dataclass(frozen=True)
class EnergyInflow(OverFronts):
    """Energy release rates over the fracture energy; see `OverFronts`.

    The tip of a model runs in segments, stops and runs on, so that what flows into it rises and
    falls between that of a running tip and that of one at rest. Its mean over a segment is that of
    a tip which runs at the mean speed v, ``G (1 - v / c_R)`` with G of the same crack at rest
    (Freund 1990, 7.4).

    Attributes
    ----------
    now
        The rate at that time.
    taken
        Integral of the rate over time since the last cut (s).
    since
        Time of the last cut (s); minus infinity before the first.
    at_rest
        Of the crack at rest, from the last segment; zero before the first.
    """

    now: Floats
    taken: Floats
    since: Floats
    at_rest: Floats

    @classmethod
    def none(cls, number: int, time: float) -> "EnergyInflow":
        """Return that of tips that have not begun to run."""
        zero = np.zeros(number)
        return cls(time, zero, zero, np.full(number, -np.inf), zero)

    def after(self, time: float, rate: Floats) -> "EnergyInflow":
        """Return that after a step to ``time``, with the rates (n,) at its end."""
        taken = self.taken + (self.now + rate) / 2 * (time - self.time)
        return replace(self, time=time, now=rate, taken=taken)

    @property
    def driving(self) -> Floats:
        """Rates (n,) of the cracks at rest, as far as they are known."""
        return np.maximum(self.now, self.at_rest)

    def cut(self, front: Ints, length: Floats, bound: float) -> "EnergyInflow":
        """Return that after segments (k,) of lengths (m) were cut at fronts (k,).

        ``bound`` is Rayleigh's speed (m/s). A tip that runs its first segment has stood.
        """
        span = self.time - self.since[front]
        part = np.minimum(length / (span * bound), FASTEST)
        known = np.where(np.isinf(span), self.now[front], self.taken[front] / span / (1 - part))
        at_rest, taken, since = self.at_rest.copy(), self.taken.copy(), self.since.copy()
        at_rest[front], taken[front], since[front] = known, 0.0, self.time
        return replace(self, at_rest=at_rest, taken=taken, since=since)
