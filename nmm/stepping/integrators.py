"""Time integration of ``M a + internal = external + contact`` over one step.

Each integrator turns the dynamic step into ``(m M + s K) d = force + M p + c N``, in increments
``d`` of displacement, and says what the rates are afterwards. ``N`` is the mean contact force of
the step. It acts as an impulse of its own, ``dt N`` on the momentum and ``dt^2 / 2 N`` on the place
(Kane, Repetto, Ortiz and Marsden 1999), so that ``N d`` is the work that it does. What the spring
of a contact may push with is its stretch at the end and at the start of the step, weighted; at the
start no contact pulls, so that closing and opening never give more than the spring has stored
(`Integrator.contact_weight`).
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from integration.arrays import Floats
from nmm.errors import FormulationError
from nmm.registry import Registry

if TYPE_CHECKING:
    from nmm.formulation import Integrator as Table


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

    @property
    def contact_factor(self) -> float:
        """Factor ``c`` of the mean contact force."""
        return 1.0

    @property
    def contact_weight(self) -> float:
        """Share of the end of the step in the stretch of contact springs, from 1/2 to 1.

        At 1/2 a contact that stays closed keeps its energy, beyond it loses some; closing and
        opening lose some at every weight, and none of them gains any.
        """
        return 1.0

    @property
    def carries(self) -> bool:
        """Whether a step needs the acceleration, without contact forces, at its start."""
        return False

    @property
    def contact_kick(self) -> tuple[float, float]:
        """Factors of ``dt a`` and ``a``, ``M a`` the contact force, in velocity and acceleration.

        They are added to what `rates` finds from the displacement alone.
        """
        return 0.0, 0.0


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
    def carries(self) -> bool:
        """See `Integrator.carries`."""
        return abs(self.gamma - 2 * self.beta) > 1e-12 or self.gamma > 1

    @property
    def end_weight(self) -> float:
        """``gamma``, or 1 where the acceleration carries the start's forces."""
        return 1.0 if self.carries else self.gamma

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


@dataclass(frozen=True)
class Shi(Newmark):
    """Shi's constant acceleration over the step (1988): ``v1 = 2 d / dt - v``.

    It is Newmark (1/2, 1), in which the old acceleration drops out. Order 1, with the algorithmic
    damping ratio ``omega dt / 4``.
    """

    beta: float = field(default=0.5, init=False)
    gamma: float = field(default=1.0, init=False)


@dataclass(frozen=True)
class GeneralizedAlpha(Newmark):
    """Generalised alpha (Chung and Hulbert 1993) from the spectral radius at infinity.

    ``alpha_m = (2 rho - 1)/(rho + 1)``, ``alpha_f = rho/(rho + 1)``; order 2.
    """

    beta: float = field(default=0.25, init=False)
    gamma: float = field(default=0.5, init=False)
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
    def carries(self) -> bool:
        """See `Integrator.carries`."""
        return True

    @property
    def end_weight(self) -> float:
        """``1 - alpha_f``."""
        return 1 - self._alpha_f

    @property
    def contact_weight(self) -> float:
        """``1 - alpha_f``, that of elastic forces."""
        return self.end_weight

    @property
    def contact_factor(self) -> float:
        """``(1 - alpha_m) / (2 beta)``."""
        return (1 - self._alpha_m) / (2 * self.beta)

    def mass_factor(self, step: float) -> float:
        """``(1 - alpha_m) / (beta dt^2)``."""
        return (1 - self._alpha_m) / (self.beta * step**2)

    def momentum(self, velocity: Floats, acceleration: Floats, step: float) -> Floats:
        """Newmark's, weighted, less the old acceleration's share."""
        start = self._start(velocity, acceleration, step)
        return (1 - self._alpha_m) * start - self._alpha_m * acceleration


INTEGRATORS = Registry[type[Integrator]](
    "integrator",
    Integrator,
    {
        "shi": "nmm.stepping.integrators:Shi",
        "newmark": "nmm.stepping.integrators:Newmark",
        "generalized_alpha": "nmm.stepping.integrators:GeneralizedAlpha",
    },
)


def make_integrator(table: "Table") -> Integrator:
    """Return the integrator that a formulation's ``[integrator]`` names.

    Raises
    ------
    FormulationError
        When the name or an option is not known, or the integrator refuses its value.
    """
    made: Integrator = INTEGRATORS.make(
        table.type, table.options, kinetic_factor=table.kinetic_factor
    )
    return made
