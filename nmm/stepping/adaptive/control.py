"""How long the next step is, from the errors of the last two: a PI controller.

The error of a step of an integrator of order ``p`` falls with its length to the power ``p + 1``,
and a motion takes steps in number one over their length. So that the error of the whole motion is
proportional to what is requested, a step may err by ``error^(1 + 1 / p)`` of what moves
(tolerance proportionality: Soederlind and Wang 2006). A bound on each step, and not on a step over
its length, can be met by steps in which speeds jump, too.
"""

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Ints
from nmm.frozen import with_parts

if TYPE_CHECKING:
    from nmm.formulation import IntegratorTable

ERROR, SHORTEST_STEP, LONGEST, FIRST = 0.01, 1e-7, 0.1, 1e-3
"""What is requested by default: the error, and the bounds and the first of the steps as shares of
the duration."""
# Of the bound, what the next step aims at; and the exponents of the controller, over the order of
# the error: PI.4.2 of Soederlind (2003), without oscillation of lengths and with few rejections.
AIM, PROPORTIONAL, INTEGRAL = 0.7, 0.6, 0.2
# A step is at most so many times as long as the last one; one that would grow by less stays as it
# is, whose matrix is known.
GROWTH, DEAD = 3.0, 1.15
# Below this share of the bound an error says nothing but that it is small.
SMALL = 1e-6
# Halvings of a step that errs, at once.
HALVINGS = 6


@dataclass(frozen=True)
class StepChoice:
    """What the control of steps remembers between two of them.

    Attributes
    ----------
    last
        Error of the last step over its bound; None before the first.
    way, speed
        Largest displacement (m) and speed (m/s) so far.
    pushing
        (p,) sorted keys of the contacts that pushed in the last step.
    """

    last: float | None = None
    way: float = 0.0
    speed: float = 0.0
    pushing: Ints = field(default_factory=lambda: np.zeros(0, dtype=np.int64))

    def seen(self, way: float, speed: float) -> "StepChoice":
        """Return it after a displacement (m) and a speed (m/s)."""
        return with_parts(self, way=max(self.way, way), speed=max(self.speed, speed))


@dataclass(frozen=True)
class StepControl:
    """What steps are chosen by.

    Attributes
    ----------
    error
        What a cycle of vibration may err by, as a share of what moves.
    order
        Of the integrator.
    shortest, longest, first
        Bounds of the steps, and the one tried first (s).
    rigid
        Whether bodies are compared as if they were rigid.
    impacts
        Whether speeds count where contacts close or open, as springs turn a body in a time that
        steps can resolve.
    rounded
        What places are rounded by (m): by less they are not off.
    """

    error: float
    order: int
    shortest: float
    longest: float
    first: float
    rigid: bool = False
    impacts: bool = False
    rounded: float = 0.0

    @classmethod
    def of(
        cls, table: "IntegratorTable", order: int, duration: float, resolves: float = np.inf
    ) -> "StepControl":
        """Return what a formulation asks for; ``resolves`` (s) no step exceeds."""
        longest = min(table.longest or LONGEST * duration, resolves, duration)
        shortest = min(table.shortest or SHORTEST_STEP * duration, longest)
        first = min(max(FIRST * duration, shortest), longest)
        error = ERROR if table.error is None else table.error
        return cls(error, order, shortest, longest, first)

    @property
    def beginning(self) -> StepChoice:
        """What is carried on before the first step."""
        return StepChoice()

    @property
    def bound(self) -> float:
        """What a step may err by, as a share of what moves."""
        return float(self.error ** (1 + 1 / self.order))

    def ratio(self, seen: StepChoice, apart: float, faster: float, length: float) -> float:
        """Return the error of a step of a ``length`` (s) over what it may be.

        ``apart`` (m) and ``faster`` (m/s) are by how much places and speeds are off. With order 1
        speeds err by one order more than places, and count as those places are off by in the step.
        """
        apart = max(apart - self.rounded, 0.0)
        faster = max(faster - self.rounded / length, 0.0)
        if self.order == 1:
            faster = max(faster, apart / length)
        place = apart / seen.way if seen.way else 0.0
        speed = faster / seen.speed if seen.speed else 0.0
        return max(place, speed) / self.bound

    def after(self, length: float, ratio: float, last: float | None) -> float:
        """Return the length (s) of the step after one that was good enough."""
        power, now = self.order + 1, max(ratio, SMALL)
        before = now if last is None else max(last, SMALL)
        factor = (AIM / now) ** (PROPORTIONAL / power) * (before / AIM) ** (INTEGRAL / power)
        factor = min(factor, GROWTH)
        kept = 1.0 if 1 <= factor < DEAD else factor
        return min(max(kept * length, self.shortest), self.longest)

    def halvings(self, ratio: float) -> int:
        """Return how often a step that errs too much is halved."""
        count, share = 1, ratio / AIM / 2 ** (self.order + 1)
        while share > 1 and count < HALVINGS:
            count, share = count + 1, share / 2 ** (self.order + 1)
        return count
