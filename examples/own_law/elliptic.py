"""An interface law of one's own: bonds that fail on an ellipse of pull and shear."""

from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats
from nmm.interfaces.mohr_coulomb import MohrCoulomb


@dataclass(frozen=True)
class Elliptic(MohrCoulomb):
    """``(sigma / f_t)^2 + (tau / c)^2 <= 1`` in tension; Mohr-Coulomb in compression."""

    def overload(self, pull: Floats, shear: Floats) -> Floats:
        """Return how far out of the ellipse the stresses are."""
        ellipse = np.hypot(pull / self.tensile_strength, shear / self.cohesion)
        return np.where(pull > 0, ellipse, super().overload(pull, shear))
