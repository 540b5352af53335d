"""Generalised alpha: Newmark with forces and masses at places within the step."""

from dataclasses import dataclass, field

from integration.arrays import Floats
from nmm.errors import FormulationError
from nmm.integrators.newmark import Newmark


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
    def order(self) -> int:
        """2 (Chung and Hulbert 1993)."""
        return 2

    @property
    def carries(self) -> bool:
        return True

    @property
    def end_weight(self) -> float:
        """``1 - alpha_f``."""
        return 1 - self._alpha_f

    @property
    def late(self) -> float:
        """None: accelerations are behind by as much as forces act after the middle."""
        return 0.0

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
