"""Auxiliary fields of the interaction integral: unit K_I and K_II, and the weight function q."""

from dataclasses import dataclass

import numpy as np

from covers.approximation.singular.enrichment import Enrichment, singular_fields
from covers.local_functions.crack_tip_functions import crack_tip_functions
from integration.arrays import Floats

# ``q`` is 1 up to this share of the radius, and falls smoothly to 0 at the radius.
INNER = 0.3


@dataclass(frozen=True)
class Auxiliary:
    """Auxiliary fields of unit K_I and K_II about a tip (Williams 1957).

    Attributes
    ----------
    tip
        The crack tip functions, for a length of 1.
    shear
        Shear modulus (Pa).
    """

    tip: Enrichment
    shear: float

    @classmethod
    def of(cls, point: Floats, ahead: Floats, kappa: float, shear: float) -> "Auxiliary":
        """Return the fields about a tip (2,) whose crack points in the direction ``ahead`` (2,)."""
        return cls(Enrichment(crack_tip_functions(kappa, 1.0), point, ahead), shear)

    def gradients(self, points: Floats, bearing: Floats) -> Floats:
        """Displacement gradients (m, 2 modes, 2 components, 2 directions) at points (m, 2)."""
        unit = 1 / (2 * self.shear * np.sqrt(2 * np.pi))
        return np.asarray(unit * singular_fields(self.tip, points, bearing)[1])

    def cutoff(self, points: Floats, radius: float) -> tuple[Floats, Floats]:
        """Return the weight ``q`` (m,), twice differentiable, and its gradient (m, 2) (1/m)."""
        away = points - self.tip.point
        r = np.maximum(np.hypot(*away.T), 1e-300)
        s = np.clip((r / radius - INNER) / (1 - INNER), 0.0, 1.0)
        q = 1 - s**3 * (10 - 15 * s + 6 * s**2)
        slope = -30 * s**2 * (1 - s) ** 2 / (radius * (1 - INNER))
        return q, (slope / r)[:, None] * away


def stresses_of(elasticity: Floats, gradient: Floats) -> Floats:
    """Stress tensors (m, 2, 2) from displacement gradients (m, 2, 2) and elasticity (m, 3, 3)."""
    shear = gradient[:, 0, 1] + gradient[:, 1, 0]
    strain = np.stack([gradient[:, 0, 0], gradient[:, 1, 1], shear], axis=1)
    return np.asarray(np.einsum("mij,mj->mi", elasticity, strain)[:, [[0, 2], [2, 1]]])
