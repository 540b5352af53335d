"""How long a method may try, and how long it may go on slowly."""

from dataclasses import dataclass
from math import inf

SMALL = 120
"""Unknowns up to which exactness costs nothing: Newton's method is tried first."""


@dataclass(frozen=True)
class IterationBudget:
    """How long each method may try.

    Attributes
    ----------
    solves
        Most search steps.
    factors
        Most factorisations of the springs that act.
    interior
        Most factorisations of the interior point.
    cost
        Solves after which no new factor is made, factorisations counted as `WayOptions.acting`.
    """

    solves: int = 1000
    factors: int = 40
    interior: int = 100
    cost: float = inf


@dataclass(frozen=True)
class Patience:
    """How long an iteration may go on that gets on slowly.

    Attributes
    ----------
    ahead
        Most solves that may lie ahead at the rate of the last ones.
    below
        Relative out-of-balance force (-) below which it is judged.
    look
        Solves over which the rate is taken.
    """

    ahead: float
    below: float = inf
    look: int = 4

    def longer(self, size: float, stay: float) -> "Patience":
        """Patience of a problem in which a factorisation costs ``size`` times as many solves.

        ``stay`` is how many times as many solves may lie ahead besides.
        """
        return Patience(
            stay * size * self.ahead, self.below / size**3, max(1, int(size * self.look))
        )
