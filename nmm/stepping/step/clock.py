"""Seconds that the phases of a run take."""

from collections import defaultdict
from dataclasses import dataclass
from time import perf_counter


class Clock:
    """Wall-clock seconds by phase; those of a phase within another count for the inner one alone.

    Attributes
    ----------
    seconds
        So far.
    within
        Seconds of phases that have ended within the one that goes on.
    """

    def __init__(self) -> None:
        self.seconds: dict[str, float] = defaultdict(float)
        self.within = 0.0

    def phase(self, name: str) -> "Phase":
        """Count what is done within for a phase."""
        return Phase(self, name)


@dataclass
class Phase:
    """A stretch of a run that is timed; entered and left some ten times a step."""

    clock: Clock
    name: str
    started: float = 0.0
    before: float = 0.0

    def __enter__(self) -> None:
        self.before, self.clock.within = self.clock.within, 0.0
        self.started = perf_counter()

    def __exit__(self, *fault: object) -> None:
        clock, taken = self.clock, perf_counter() - self.started
        clock.seconds[self.name] += taken - clock.within
        clock.within = self.before + taken
