"""Mohr-Coulomb strength with a tension cut-off; bonds are brittle and break for good."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from integration.arrays import Floats
from nmm.interfaces.base import InterfaceLaw
from nmm.interfaces.history import History
from nmm.interfaces.limits import Limits
from nmm.interfaces.response import InterfaceResponse


@dataclass(frozen=True)
class MohrCoulomb(InterfaceLaw):
    """``|tau| <= c - sigma tan(phi)`` and ``sigma <= f_t`` (tension positive).

    An intact bond is elastic up to these limits. A broken one, and a contact that never was bonded,
    carries no pull and friction alone; an unbonded contact keeps its cohesion while it is closed.
    """

    softened: ClassVar[str] = "linear_softening"

    def response(self, history: History, stiffness: Floats) -> InterfaceResponse:
        """Return no limit for intact bonds, and the residual limits for the others."""
        intact = history["bonded"]
        kept = 0.0 if self.bonded else self.cohesion
        limits = Limits(
            tension=np.where(intact, np.inf, 0.0),
            cohesion=np.where(intact, np.inf, kept),
            friction=self.friction(history),
        )
        return InterfaceResponse(limits, np.ones(len(intact)), self.rise(history))

    def overload(self, pull: Floats, shear: Floats) -> Floats:
        """Return the larger of pull over tensile strength and shear over shear strength."""
        shear_strength = self.cohesion - pull * np.tan(self.friction_angle)
        return np.maximum(
            _ratio(pull, self.tensile_strength),
            _ratio(np.abs(shear), np.maximum(shear_strength, 0.0)),
        )


def _ratio(stress: Floats, strength: float | Floats) -> Floats:
    """Stress over strength; without strength any stress above zero is too much."""
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(stress <= 0, 0.0, stress / strength)
