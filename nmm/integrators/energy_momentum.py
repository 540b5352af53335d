"""The integrator of finite motion that keeps energy and both momenta."""

from dataclasses import dataclass, field

from nmm.integrators.base import Integrator
from nmm.integrators.newmark import Newmark


@dataclass(frozen=True)
class EnergyMomentum(Newmark):
    """Energy and momentum kept for any step (Simo and Tarnow 1992; Gonzalez 2000).

    Newmark (1/4, 1/2) in the form of the midpoint rule, ``M (v1 - v0) / dt = f`` and
    ``(v0 + v1) / 2 = d / dt``. Its internal force is that of a stress whose work in the step is the
    energy that matter gains (`nmm.assembly.finite_strain.conserving_stress`), about the mean place
    of both ends, where it makes no moment. Order 2; for finite strain alone.
    """

    beta: float = field(default=0.25, init=False)
    gamma: float = field(default=0.5, init=False)

    @property
    def conserves(self) -> bool:
        return True

    @property
    def beginning(self) -> Integrator:
        """See `Integrator.beginning`: itself, as it needs no acceleration."""
        return self
