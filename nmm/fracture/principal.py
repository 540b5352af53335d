"""The largest principal stress, which opens cracks, and the plane that it opens."""

from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats


@dataclass(frozen=True)
class LargestPrincipal:
    """Largest principal stresses (k,) in Pa, and the directions (k, 2) in which they pull."""

    size: Floats
    way: Floats

    @classmethod
    def of(cls, stress: Floats) -> "LargestPrincipal":
        """Return those of stresses (k, 3)."""
        mean = (stress[:, 0] + stress[:, 1]) / 2
        half, shear = (stress[:, 0] - stress[:, 1]) / 2, stress[:, 2]
        angle = np.arctan2(shear, half) / 2
        return cls(mean + np.hypot(half, shear), np.stack([np.cos(angle), np.sin(angle)], axis=1))

    @property
    def plane(self) -> Floats:
        """(k, 2) directions of the planes that they open."""
        return np.stack([-self.way[:, 1], self.way[:, 0]], axis=1)
