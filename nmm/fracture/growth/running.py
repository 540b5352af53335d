"""How far tips have run into their next pieces, and until when they run through the last ones."""

from dataclasses import dataclass, replace

import numpy as np

from integration.arrays import Bools, Floats, Ints


@dataclass(frozen=True)
class RunningTips:
    """Tips on their way, (n,) fronts.

    Attributes
    ----------
    time
        To which the ways are known (s).
    way
        How far each has come in the piece that is not cut yet (m).
    speed
        At that time (m/s); zero where a tip still runs through its last piece.
    until
        When each has run through its last piece (s).
    fed
        How far each has run since it divided while twice the fracture energy came in (m).
    """

    time: float
    way: Floats
    speed: Floats
    until: Floats
    fed: Floats

    @classmethod
    def at_rest(cls, number: int, time: float) -> "RunningTips":
        """Return tips that have not begun to run."""
        zero = np.zeros(number)
        return cls(time, zero, zero, np.full(number, -np.inf), zero)

    @property
    def arrays(self) -> tuple[float, Floats, Floats, Floats, Floats]:
        """All of it."""
        return self.time, self.way, self.speed, self.until, self.fed

    def advanced(self, time: float, speed: Floats) -> "RunningTips":
        """Return the tips at a later time at which their speeds (n,) would be so much (m/s)."""
        # A tip that is through its piece within the step has the rest of it.
        rest = np.clip(time - np.maximum(self.time, self.until), 0.0, None)
        mean = (speed + np.where(self.until > self.time, speed, self.speed)) / 2
        there = self.until <= time
        return replace(
            self, time=time, way=self.way + mean * rest, speed=np.where(there, speed, 0.0)
        )

    def fed_by(self, front: Ints, twice: Bools, length: Floats) -> "RunningTips":
        """Return the tips where fronts (k,) have run on by lengths (k,), fed ``twice`` or not."""
        fed = self.fed.copy()
        fed[front] = np.where(twice, fed[front] + length, 0.0)
        return replace(self, fed=fed)

    def divided(self, parents: Ints) -> "RunningTips":
        """Return the tips with branches (k,) that run as their parents; both are fed anew."""
        way, speed, until = (
            np.append(values, values[parents]) for values in (self.way, self.speed, self.until)
        )
        fed = np.pad(self.fed, (0, len(parents)))
        fed[parents] = 0.0
        return RunningTips(self.time, way, speed, until, fed)

    def begun(self, number: int, speed: float) -> "RunningTips":
        """Return the tips with so many that begin, at a speed (m/s)."""
        way, speeds = np.zeros(number), np.full(number, speed)
        until = np.full(number, -np.inf)
        pairs = ((self.way, way), (self.speed, speeds), (self.until, until), (self.fed, way))
        return RunningTips(self.time, *(np.concatenate(pair) for pair in pairs))

    def cut(self, front: Ints, length: Floats) -> tuple["RunningTips", Floats]:
        """Return the tips where pieces (k,) of a length were cut; and how long each still takes.

        What a tip has come beyond the middle is taken off that time, of short pieces up to half.
        """
        way, speed, until = self.way.copy(), self.speed.copy(), self.until.copy()
        fast = np.maximum(speed[front], 1e-300)
        span = np.maximum(length - way[front], length / 4) / fast
        way[front] = speed[front] = 0.0
        until[front] = self.time + span
        return replace(self, way=way, speed=speed, until=until), span
