"""Mohr-Coulomb strength with a tension cut-off; bonds are brittle and break for good."""

from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats
from nmm.interfaces.base import InterfaceLaw
from nmm.interfaces.limits import Limits


@dataclass(frozen=True)
class MohrCoulomb(InterfaceLaw):
    """``|tau| <= c - sigma tan(phi)`` and ``sigma <= f_t`` (tension positive).

    An intact bond is elastic up to these limits. A broken one, and a contact that never was bonded,
    carries no pull and friction alone; an unbonded contact keeps its cohesion while it is closed.
    """

    def limits(self, length: Floats, damage: Floats, thickness: float) -> Limits:
        """Return no limit for intact bonds, and the residual limits for the others."""
        intact = self.bonded & (damage < 1)
        kept = 0.0 if self.bonded else self.cohesion * thickness * length
        return Limits(
            tension=np.where(intact, np.inf, 0.0),
            cohesion=np.where(intact, np.inf, kept),
            friction=self.friction(damage),
        )

    def overload(
        self, normal_force: Floats, shear_force: Floats, length: Floats, thickness: float
    ) -> Floats:
        """Return the larger of pull over tensile strength and shear over shear strength."""
        area = length * thickness
        shear_strength = self.cohesion * area - normal_force * np.tan(self.friction_angle)
        return np.maximum(
            _ratio(normal_force, self.tensile_strength * area),
            _ratio(np.abs(shear_force), np.maximum(shear_strength, 0.0)),
        )


def _ratio(force: Floats, strength: Floats) -> Floats:
    """Force over strength; without strength any force above zero is too much."""
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(force <= 0, 0.0, force / strength)
