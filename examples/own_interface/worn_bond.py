"""An interface law of one's own with two internal variables: a bond that tears and faces that wear.

Strength falls as the bond opens, friction as the faces slide to and fro.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats
from nmm.interfaces.base import InterfaceLaw
from nmm.interfaces.history import CUMULATIVE_SLIP, DAMAGE, History, HistoryColumn
from nmm.interfaces.limits import Limits
from nmm.interfaces.response import InterfaceResponse


@dataclass(frozen=True)
class WornBond(InterfaceLaw):
    """Linear softening in opening; friction that falls linearly with all that was slid.

    Attributes
    ----------
    opening
        m at which nothing is left of the bond.
    wear
        m slid, back and forth added, at which friction is residual.
    """

    opening: float = 1e-4
    wear: float = 1e-2

    @property
    def columns(self) -> Mapping[str, HistoryColumn]:
        """Two internal variables."""
        return {"damage": DAMAGE, "cumulative_slip": CUMULATIVE_SLIP}

    def response(self, history: History, stiffness: Floats) -> InterfaceResponse:
        """Return what damage and wear have left; an open bond goes back on its secant."""
        left = 1 - history["damage"]
        worn = np.minimum(history["cumulative_slip"] / self.wear, 1.0)
        peak, residual = np.tan(self.friction_angle), np.tan(self.residual_angle)
        strength = left * self.tensile_strength
        open_share = strength / (strength + stiffness * history["damage"] * self.opening)
        limits = Limits(
            tension=strength,
            cohesion=left * self.cohesion,
            friction=peak + (residual - peak) * worn,
        )
        return InterfaceResponse(limits, open_share, rise=np.zeros(len(left)))

    def evolved(
        self, history: History, gap: Floats, sliding: Floats, stiffness: Floats
    ) -> dict[str, Floats]:
        """Return damage by opening, and what was slid."""
        elastic = self.tensile_strength / stiffness
        torn = (gap - elastic) / (self.opening - elastic)
        damage = np.clip(torn, history["damage"], 1.0)
        return super().evolved(history, gap, sliding, stiffness) | {
            "damage": damage,
            "bonded": history["bonded"] & (damage < 1),
        }
