"""Criterion of maximum energy release rate (Hussain, Pu and Underwood 1974; Wu 1978)."""

from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats
from nmm.fracture.criteria.base import Criterion, Kink
from nmm.fracture.criteria.extremes import minimum_from
from nmm.fracture.criteria.short_kink import kink_intensities

# Angles that are compared before the best is refined: up to so many degrees either way, in steps.
WIDEST, STEP = 110.0, 2.0


@dataclass(frozen=True)
class EnergyRelease(Criterion):
    """A crack grows along the short kink of the largest energy release rate, when that is G_c.

    The rate is ``(k1^2 + k2^2) / E'`` with the stress intensity factors at the tip of the kink
    (`nmm.fracture.criteria.short_kink`); only kinks that open count.
    """

    def kink(self, opening: Floats, sliding: Floats, kappa: Floats) -> Kink:
        size = np.maximum(np.hypot(opening, sliding), 1e-300)
        one, two = opening / size, sliding / size
        grid = np.radians(np.arange(-WIDEST, WIDEST + STEP / 2, STEP))[:, None]
        k1, k2 = kink_intensities(np.broadcast_to(grid, (len(grid), len(one))), one, two)
        best = np.argmax(np.where(k1 > 0, k1**2 + k2**2, -np.inf), axis=0)
        angle = minimum_from(grid[best, 0], lambda t: _slopes(t, one, two))
        k1, k2 = kink_intensities(angle, one, two)
        return Kink(angle, np.where(k1 > 0, size * np.hypot(k1, k2), 0.0))


def _slopes(t: Floats, one: Floats, two: Floats) -> tuple[Floats, Floats]:
    """First and second derivatives of ``-(k1^2 + k2^2) / 2`` by the angle."""
    (a, b), (da, db), (dda, ddb) = (kink_intensities(t, one, two, order) for order in (0, 1, 2))
    return -(a * da + b * db), -(da**2 + db**2 + a * dda + b * ddb)
