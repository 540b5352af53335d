"""Seconds that the phases of a run take."""

from collections import defaultdict
from dataclasses import dataclass
from time import perf_counter


class Clock:
    """Wall-clock seconds by phase.

    Attributes
    ----------
    seconds
        So far.
    """

    def __init__(self) -> None:
        self.seconds: dict[str, float] = defaultdict(float)

    def phase(self, name: str) -> "Phase":
        """Count what is done within for a phase."""
        return Phase(self.seconds, name)


@dataclass
class Phase:
    """A stretch of a run that is timed; entered and left some ten times a step."""

    seconds: dict[str, float]
    name: str
    started: float = 0.0

    def __enter__(self) -> None:
        self.started = perf_counter()

    def __exit__(self, *fault: object) -> None:
        self.seconds[self.name] += perf_counter() - self.started
