"""Newmark's family of integrators."""

from dataclasses import dataclass
from functools import cached_property

from integration.arrays import Floats
from nmm.errors import FormulationError
from nmm.integrators.base import Integrator


@dataclass(frozen=True)
class Newmark(Integrator):
    """Newmark (1959): ``beta``, ``gamma``; (1/4, 1/2) conserves energy and has order 2.

    With ``gamma = 2 beta`` the velocity follows from the displacement alone, ``v1 = 2 d / dt - v``,
    and elastic and applied forces act with the weights ``gamma`` at the end and ``1 - gamma`` at
    the start of the step: no acceleration is carried.
    """

    beta: float = 0.25
    gamma: float = 0.5

    def __post_init__(self) -> None:
        super().__post_init__()
        if not (self.beta > 0 and self.gamma >= 0.5):
            raise FormulationError(
                f"[integrator] beta, gamma: {self.beta}, {self.gamma}: expected beta > 0 and "
                "gamma >= 0.5 (stable, implicit): use 0.25 and 0.5 for no damping"
            )

    @property
    def order(self) -> int:
        """2 with ``gamma = 1/2``, which damps nothing; else 1."""
        return 2 if self.gamma == 0.5 else 1

    @cached_property
    def carries(self) -> bool:
        return abs(self.gamma - 2 * self.beta) > 1e-12 or self.gamma > 1

    @property
    def among_contacts(self) -> Integrator:
        """The member of the same damping that carries no acceleration, ``gamma = 2 beta``."""
        if not self.carries:
            return self
        weight = min(self.contact_weight, 1.0)
        return Newmark(self.kinetic_factor, weight / 2, weight)

    @property
    def end_weight(self) -> float:
        """``gamma``, or 1 where the acceleration carries the start's forces."""
        return 1.0 if self.carries else self.gamma

    @property
    def late(self) -> float:
        """``gamma - 1/2``."""
        return self.gamma - 0.5

    @property
    def contact_weight(self) -> float:
        """``gamma``, at most 1."""
        return min(self.gamma, 1.0)

    @property
    def contact_factor(self) -> float:
        """``1 / (2 beta)``, or 1: the place gains ``dt^2 / 2`` of contact's acceleration."""
        return 0.5 / self.beta if self.carries else 1.0

    @property
    def contact_kick(self) -> tuple[float, float]:
        """``1 - gamma / (2 beta)`` and ``- 1 / (2 beta)``."""
        return 1 - self.gamma / (2 * self.beta), -0.5 / self.beta

    def mass_factor(self, step: float) -> float:
        """``1 / (beta dt^2)``, or ``2 / dt^2``."""
        return 1 / (self.beta * step**2) if self.carries else 2 / step**2

    def momentum(self, velocity: Floats, acceleration: Floats, step: float) -> Floats:
        """``(v dt + (1/2 - beta) a dt^2) / (beta dt^2)``, or ``2 v / dt``."""
        return self._start(velocity, acceleration, step) if self.carries else 2 / step * velocity

    def rates(
        self, increment: Floats, velocity: Floats, acceleration: Floats, step: float
    ) -> tuple[Floats, Floats]:
        """``a1`` from the displacement, ``v1 = v + dt ((1 - gamma) a + gamma a1)``."""
        if not self.carries:
            # The change is small against the velocity: its rounding must not add up over steps.
            gained = 2 / step**2 * increment - 2 / step * velocity
            return velocity + step * gained, gained
        last = increment / (self.beta * step**2) - self._start(velocity, acceleration, step)
        return velocity + step * ((1 - self.gamma) * acceleration + self.gamma * last), last

    def _start(self, velocity: Floats, acceleration: Floats, step: float) -> Floats:
        """Share of the start of the step in the acceleration at its end, with the sign changed."""
        return velocity / (self.beta * step) + (0.5 / self.beta - 1) * acceleration
