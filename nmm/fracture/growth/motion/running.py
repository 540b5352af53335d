"""The motion of running tips: their way into the next segment, and the end of the last one."""

from dataclasses import dataclass, replace

import numpy as np

from integration.arrays import Bools, Floats, Ints
from nmm.fracture.growth.tips.over_fronts import OverFronts


@dataclass(frozen=True)
class RunningTips(OverFronts):
    """Running tips; see `OverFronts`.

    Attributes
    ----------
    way
        How far each has come in its next segment, which is not cut yet (m).
    speed
        At that time (m/s); zero where a tip still runs through the segment cut last.
    until
        Time at which each has run through the segment cut last (s).
    fed
        How far each has run since it branched while twice the fracture energy flowed in (m).
    """

    way: Floats
    speed: Floats
    until: Floats
    fed: Floats

    @classmethod
    def begun(cls, number: int, time: float, speed: float = 0.0) -> "RunningTips":
        """Return tips that have run nowhere, of a speed (m/s)."""
        zero = np.zeros(number)
        return cls(time, zero, np.full(number, speed), np.full(number, -np.inf), zero)

    def advanced(self, time: float, speed: Floats) -> "RunningTips":
        """Return the tips at a later time (s) at which the law gives the speeds (n,) (m/s)."""
        # A tip that ends its segment within the step runs for the rest of the step.
        rest = np.clip(time - np.maximum(self.time, self.until), 0.0, None)
        mean = (speed + np.where(self.until > self.time, speed, self.speed)) / 2
        there = self.until <= time
        return replace(
            self, time=time, way=self.way + mean * rest, speed=np.where(there, speed, 0.0)
        )

    def fed_by(self, front: Ints, twice: Bools, length: Floats) -> "RunningTips":
        """Return the tips after fronts (k,) ran lengths (k,) (m), fed ``twice`` G_c or not."""
        fed = self.fed.copy()
        fed[front] = np.where(twice, fed[front] + length, 0.0)
        return replace(self, fed=fed)

    def divided(self, parents: Ints) -> "RunningTips":
        """Return the tips with branches (k,) that run like their parents; ``fed`` starts at 0."""
        fed = self.fed.copy()
        fed[parents] = 0.0
        return OverFronts.divided(replace(self, fed=fed), parents)

    def cut(self, front: Ints, length: Floats) -> tuple["RunningTips", Floats]:
        """Return the tips after segments (k,) were cut, and the times (k,) they still take (s).

        The duration is the way that is left at the present speed; at least a quarter of the
        segment.
        """
        way, speed, until = self.way.copy(), self.speed.copy(), self.until.copy()
        fast = np.maximum(speed[front], 1e-300)
        span = np.maximum(length - way[front], length / 4) / fast
        way[front] = speed[front] = 0.0
        until[front] = self.time + span
        return replace(self, way=way, speed=speed, until=until), span
