"""How long the steps of a run are whose error chooses their length."""

from dataclasses import dataclass
from math import inf


@dataclass(frozen=True)
class StepLengths:
    """Accepted steps and those that were tried.

    Attributes
    ----------
    smallest, largest
        Of the accepted steps (s).
    rejected
        How many were tried and undone, as they erred too much or were not solved.
    unresolved
        How many were taken though they erred too much, as none was to be shorter.
    """

    smallest: float = inf
    largest: float = 0.0
    rejected: int = 0
    unresolved: int = 0

    def seen(self, length: float) -> "StepLengths":
        """Return it after an accepted step (s)."""
        smallest, largest = min(self.smallest, length), max(self.largest, length)
        return StepLengths(smallest, largest, self.rejected, self.unresolved)
