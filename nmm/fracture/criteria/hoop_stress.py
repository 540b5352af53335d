"""Criterion of maximum hoop stress (Erdogan and Sih 1963)."""

from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats
from nmm.fracture.criteria.base import Criterion, Kink, hoop_angle


@dataclass(frozen=True)
class HoopStress(Criterion):
    """A crack grows towards the maximum hoop stress, when that is the one of K_Ic in mode I."""

    def kink(self, opening: Floats, sliding: Floats, kappa: Floats) -> Kink:
        angle = hoop_angle(opening, sliding)
        c, s = np.cos(angle / 2), np.sin(angle / 2)
        return Kink(angle, np.asarray(c**2 * (opening * c - 3 * sliding * s)))
