"""Principal stresses in the plane, and the planes on which they act."""

from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats


@dataclass(frozen=True)
class PrincipalStresses:
    """Principal stresses in the plane (Pa), tension positive.

    Attributes
    ----------
    larger, smaller
        (k,) the two values (Pa).
    angle
        (k,) from the x axis to the direction of the larger one, counter-clockwise (rad).
    """

    larger: Floats
    smaller: Floats
    angle: Floats

    @classmethod
    def of(cls, stress: Floats) -> "PrincipalStresses":
        """Return those of stresses [xx, yy, xy] (k, 3) by Mohr's circle."""
        xx, yy, xy = stress.T
        mean, half = (xx + yy) / 2, (xx - yy) / 2
        radius = np.hypot(half, xy)
        return cls(mean + radius, mean - radius, np.arctan2(xy, half) / 2)

    @property
    def plane(self) -> Floats:
        """(k, 2) unit vectors along the planes on which the larger ones act."""
        return np.stack([-np.sin(self.angle), np.cos(self.angle)], axis=1)
