"""An interface law of one's own: bonds that fail on an ellipse of pull and shear."""

from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats
from nmm.interfaces.mohr_coulomb import MohrCoulomb


@dataclass(frozen=True)
class Elliptic(MohrCoulomb):
    """``(sigma / f_t)^2 + (tau / c)^2 <= 1`` in tension; Mohr-Coulomb in compression."""

    def overload(
        self, normal_force: Floats, shear_force: Floats, length: Floats, thickness: float
    ) -> Floats:
        """Return how far out of the ellipse the forces are."""
        pull = normal_force / (self.tensile_strength * length * thickness)
        shear = shear_force / (self.cohesion * length * thickness)
        pressed = super().overload(normal_force, shear_force, length, thickness)
        return np.where(normal_force > 0, np.hypot(pull, shear), pressed)
