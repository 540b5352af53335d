"""Time integration of ``M a + internal = external`` over one step, in increments of displacement.

Each integrator turns the dynamic step into ``(m M + s K) d = force + M p`` and says what
the rates are afterwards. Contact forces act at the end of the step in all of them.
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass

from integration.arrays import Floats
from nmm.errors import FormulationError
from nmm.registry import Registry


@dataclass(frozen=True)
class Integrator(ABC):
    """Base of integrators.

    Attributes
    ----------
    kinetic_factor
        Share of the velocity that enters the next step: 1 dynamics, 0 statics by relaxation,
        between them damped (Shi 1988).
    """

    kinetic_factor: float = 1.0

    def __post_init__(self) -> None:
        if not 0 <= self.kinetic_factor <= 1:
            raise FormulationError(
                f"[integrator] kinetic_factor: {self.kinetic_factor}: expected a number from 0 "
                "(statics) to 1 (undamped): choose one in that range"
            )

    @abstractmethod
    def mass_factor(self, step: float) -> float:
        """Factor ``m`` of the mass matrix."""

    @abstractmethod
    def momentum(self, velocity: Floats, acceleration: Floats, step: float) -> Floats:
        """Vector ``p`` whose product with the mass joins the forces."""

    @abstractmethod
    def rates(
        self, increment: Floats, velocity: Floats, acceleration: Floats, step: float
    ) -> tuple[Floats, Floats]:
        """Velocity and acceleration at the end of the step."""

    @property
    def end_weight(self) -> float:
        """Share ``s`` of the end of the step in elastic and applied forces."""
        return 1.0


@dataclass(frozen=True)
class Newmark(Integrator):
    """Newmark (1959): ``beta``, ``gamma``; (1/4, 1/2) conserves energy and has order 2."""

    beta: float = 0.25
    gamma: float = 0.5

    def __post_init__(self) -> None:
        super().__post_init__()
        if not (self.beta > 0 and self.gamma >= 0.5):
            raise FormulationError(
                f"[integrator] beta, gamma: {self.beta}, {self.gamma}: expected beta > 0 and "
                "gamma >= 0.5 (stable, implicit): use 0.25 and 0.5 for no damping"
            )

    def mass_factor(self, step: float) -> float:
        """``1 / (beta dt^2)``."""
        return 1 / (self.beta * step**2)

    def momentum(self, velocity: Floats, acceleration: Floats, step: float) -> Floats:
        """``(v dt + (1/2 - beta) a dt^2) / (beta dt^2)``."""
        return self._start(velocity, acceleration, step)

    def rates(
        self, increment: Floats, velocity: Floats, acceleration: Floats, step: float
    ) -> tuple[Floats, Floats]:
        """``a1`` from the displacement, ``v1 = v + dt ((1 - gamma) a + gamma a1)``."""
        end = increment / (self.beta * step**2) - self._start(velocity, acceleration, step)
        return velocity + step * ((1 - self.gamma) * acceleration + self.gamma * end), end

    def _start(self, velocity: Floats, acceleration: Floats, step: float) -> Floats:
        """Share of the start of the step in the acceleration at its end, with the sign changed."""
        return velocity / (self.beta * step) + (0.5 / self.beta - 1) * acceleration


@dataclass(frozen=True)
class Shi(Newmark):
    """Shi's constant acceleration over the step (1988): ``v1 = 2 d / dt - v``.

    It is Newmark (1/2, 1), in which the old acceleration drops out. Order 1, with the algorithmic
    damping ratio ``omega dt / 4``.
    """

    beta: float = 0.5
    gamma: float = 1.0

    def __post_init__(self) -> None:
        super().__post_init__()
        if (self.beta, self.gamma) != (0.5, 1.0):
            raise FormulationError(
                f"[integrator] beta, gamma: {self.beta}, {self.gamma}: expected none for "
                'type = "shi": use type = "newmark" to choose them'
            )


@dataclass(frozen=True)
class GeneralizedAlpha(Newmark):
    """Generalised alpha (Chung and Hulbert 1993) from the spectral radius at infinity.

    ``alpha_m = (2 rho - 1)/(rho + 1)``, ``alpha_f = rho/(rho + 1)``; order 2.
    """

    rho_inf: float = 0.8

    def __post_init__(self) -> None:
        if not 0 <= self.rho_inf <= 1:
            raise FormulationError(
                f"[integrator] rho_inf: {self.rho_inf}: expected a number from 0 (most damping of "
                "high frequencies) to 1 (none): 0.8 is usual"
            )
        shift = self._alpha_f - self._alpha_m
        object.__setattr__(self, "beta", (1 + shift) ** 2 / 4)
        object.__setattr__(self, "gamma", 0.5 + shift)
        super().__post_init__()

    @property
    def _alpha_m(self) -> float:
        return (2 * self.rho_inf - 1) / (self.rho_inf + 1)

    @property
    def _alpha_f(self) -> float:
        return self.rho_inf / (self.rho_inf + 1)

    @property
    def end_weight(self) -> float:
        """``1 - alpha_f``."""
        return 1 - self._alpha_f

    def mass_factor(self, step: float) -> float:
        """``(1 - alpha_m) / (beta dt^2)``."""
        return (1 - self._alpha_m) / (self.beta * step**2)

    def momentum(self, velocity: Floats, acceleration: Floats, step: float) -> Floats:
        """Newmark's, weighted, less the old acceleration's share."""
        start = self._start(velocity, acceleration, step)
        return (1 - self._alpha_m) * start - self._alpha_m * acceleration


INTEGRATORS = Registry[type[Integrator]](
    "integrator",
    {
        "shi": "nmm.stepping.integrators:Shi",
        "newmark": "nmm.stepping.integrators:Newmark",
        "generalized_alpha": "nmm.stepping.integrators:GeneralizedAlpha",
    },
)
