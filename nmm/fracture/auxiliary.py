"""Fields of unit stress intensities about a tip, and the function that cuts them off."""

from dataclasses import dataclass

import numpy as np

from covers.approximation.singular.enrichment import Enrichment, singular_fields
from covers.local_functions.crack_tip_functions import crack_tip_functions
from integration.arrays import Floats

# ``q`` is 1 up to this part of the radius, and falls smoothly to 0 from there on.
INNER = 0.3


@dataclass(frozen=True)
class Auxiliary:
    """Fields of unit K_I and K_II (Williams 1957).

    Attributes
    ----------
    tip
        The functions about the tip, of length 1.
    shear
        Modulus (Pa).
    """

    tip: Enrichment
    shear: float

    @classmethod
    def of(cls, point: Floats, ahead: Floats, kappa: float, shear: float) -> "Auxiliary":
        """Return the fields about a point with the direction ahead of it."""
        return cls(Enrichment(crack_tip_functions(kappa, 1.0), point, ahead), shear)

    def gradients(self, points: Floats, bearing: Floats) -> Floats:
        """Gradients (m, 2, 2 components, 2 directions) of the displacements of both modes."""
        unit = 1 / (2 * self.shear * np.sqrt(2 * np.pi))
        return np.asarray(unit * singular_fields(self.tip, points, bearing)[1])

    def cutoff(self, points: Floats, radius: float) -> tuple[Floats, Floats]:
        """Return the cut-off ``q`` (m,), smooth to second derivatives, and its gradient (m, 2)."""
        away = points - self.tip.point
        r = np.maximum(np.hypot(*away.T), 1e-300)
        s = np.clip((r / radius - INNER) / (1 - INNER), 0.0, 1.0)
        q = 1 - s**3 * (10 - 15 * s + 6 * s**2)
        slope = -30 * s**2 * (1 - s) ** 2 / (radius * (1 - INNER))
        return q, (slope / r)[:, None] * away


def stresses_of(elasticity: Floats, gradient: Floats) -> Floats:
    """Stress tensors (m, 2, 2) from displacement gradients."""
    shear = gradient[:, 0, 1] + gradient[:, 1, 0]
    strain = np.stack([gradient[:, 0, 0], gradient[:, 1, 1], shear], axis=1)
    return np.asarray(np.einsum("mij,mj->mi", elasticity, strain)[:, [[0, 2], [2, 1]]])
