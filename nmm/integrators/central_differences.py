"""Central differences: explicit, of order 2, stable up to a step of two over the frequency."""

from dataclasses import dataclass

from integration.arrays import Floats
from nmm.errors import FormulationError
from nmm.integrators.base import Integrator


@dataclass(frozen=True)
class CentralDifferences(Integrator):
    """Elastic and applied forces act as they are at the start of the step.

    ``a = (d / dt - v-) / dt`` with the velocity ``v- = v - dt a- / 2`` half a step before; what is
    carried as velocity is ``v = v- + 3/2 dt a``, which is off from that of the end by ``dt^2 / 2``
    of the change of acceleration. No energy is lost or gained over a cycle; the frequency ``w`` is
    ``2 asin(w dt / 2) / dt`` (Bathe 1982). The step's matrix is the mass: with a lumped one, a
    block for each cover.
    """

    @property
    def order(self) -> int:
        return 2

    @property
    def limit(self) -> float:
        return 2.0

    @property
    def carries(self) -> bool:
        return True

    @property
    def beginning(self) -> Integrator:
        """The same from the velocity of the start alone."""
        return _FirstDifference(self.kinetic_factor)

    @property
    def among_contacts(self) -> Integrator:
        """Refuse contact, whose springs are stiffer than the matter that bounds the step."""
        raise FormulationError(
            '[integrator] type: "central_differences" with [contact]: expected a scene without '
            'contact: use "newmark", or remove [contact]'
        )

    @property
    def end_weight(self) -> float:
        """None: nothing at the end of the step is known."""
        return 0.0

    @property
    def contact_factor(self) -> float:
        """Half of a contact's mean force moves by ``dt^2``."""
        return 0.5

    @property
    def contact_kick(self) -> tuple[float, float]:
        """A whole impulse enters the velocity, and no acceleration is carried on."""
        return 0.25, -0.5

    def mass_factor(self, step: float) -> float:
        """``1 / dt^2``."""
        return 1 / step**2

    def momentum(self, velocity: Floats, acceleration: Floats, step: float) -> Floats:
        """``v / dt - a / 2``: that of half a step before."""
        return velocity / step - acceleration / 2

    def rates(
        self, increment: Floats, velocity: Floats, acceleration: Floats, step: float
    ) -> tuple[Floats, Floats]:
        """Velocity foreseen at the end, and the acceleration of the start."""
        before = velocity - step / 2 * acceleration
        gained = (increment / step - before) / step
        return before + 1.5 * step * gained, gained


@dataclass(frozen=True)
class _FirstDifference(CentralDifferences):
    """From rest or a velocity: ``d = dt v + dt^2 a / 2``."""

    @property
    def carries(self) -> bool:
        """Nothing is known but the velocity."""
        return False

    def mass_factor(self, step: float) -> float:
        """``2 / dt^2``."""
        return 2 / step**2

    def momentum(self, velocity: Floats, acceleration: Floats, step: float) -> Floats:
        """``2 v / dt``."""
        return 2 / step * velocity

    def rates(
        self, increment: Floats, velocity: Floats, acceleration: Floats, step: float
    ) -> tuple[Floats, Floats]:
        """Velocity foreseen at the end, and the acceleration of the start."""
        gained = 2 / step * (increment / step - velocity)
        return velocity + step * gained, gained
