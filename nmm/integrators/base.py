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
from dataclasses import dataclass
from math import inf
from typing import TYPE_CHECKING

from integration.arrays import Floats
from nmm.errors import FormulationError
from nmm.registry import Registry

if TYPE_CHECKING:
    from nmm.formulation import IntegratorTable as Table


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
    def order(self) -> int:
        """Power of the step with which the error of a smooth motion falls, its damping included."""
        return 1

    @property
    def end_weight(self) -> float:
        """Share ``s`` of the end of the step in elastic and applied forces; 0 is explicit."""
        return 1.0

    @property
    def late(self) -> float:
        """How long after the middle of a step its forces act on the motion, as a share of it.

        That is the error of order one: `end_weight` less 1/2, and less what velocities are behind.
        """
        return self.end_weight - 0.5

    @property
    def limit(self) -> float:
        """Largest product of circular frequency and step that is stable; infinite where any is."""
        return inf

    @property
    def beginning(self) -> "Integrator | None":
        """What takes a step whose start's acceleration is not known; None is the common rule."""
        return None

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
    def conserves(self) -> bool:
        """Whether the stress of a step is the one whose work is the energy that matter gains.

        It is one of finite strain; forces act with the weight 1/2 at both ends.
        """
        return False

    @property
    def restarts_at_impact(self) -> bool:
        """Whether the step after contacts began or ended to push is like the first of a run.

        Accelerations that are carried over it are those of waves that the step does not resolve:
        they are large, and make velocities overshoot by their frequency times the step (Hilber and
        Hughes 1978).
        """
        return self.carries

    @property
    def among_contacts(self) -> "Integrator":
        """The rule of scenes with contact; one that carries accelerations names another here.

        An impact that the step does not resolve leaves accelerations of its frequency squared; a
        rule that carries them overshoots and makes energy (Hilber and Hughes 1978), which decays
        only later. Rules that carry none never do.
        """
        return self

    @property
    def contact_kick(self) -> tuple[float, float]:
        """Factors of ``dt a`` and ``a``, ``M a`` the contact force, in velocity and acceleration.

        They are added to what `rates` finds from the displacement alone.
        """
        return 0.0, 0.0


INTEGRATORS = Registry[type[Integrator]](
    "integrator",
    Integrator,
    {
        "shi": "nmm.integrators.shi:Shi",
        "newmark": "nmm.integrators.newmark:Newmark",
        "central_differences": "nmm.integrators.central_differences:CentralDifferences",
        "energy_momentum": "nmm.integrators.energy_momentum:EnergyMomentum",
        "generalized_alpha": "nmm.integrators.generalized_alpha:GeneralizedAlpha",
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
