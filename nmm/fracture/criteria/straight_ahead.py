"""Growth straight ahead: specimens with side grooves, weak planes."""

from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats
from nmm.fracture.criteria.base import Criterion, Kink


@dataclass(frozen=True)
class StraightAhead(Criterion):
    """No kink, whatever the intensities; cracks that open grow when they release ``K_Ic^2 / E'``.

    A double cantilever beam is directionally unstable: its crack is kept in the plane by grooves
    (Irwin 1957 for the release rate).
    """

    def kink(self, opening: Floats, sliding: Floats, kappa: Floats) -> Kink:
        """See `Criterion.kink`."""
        opens = np.hypot(opening, sliding)
        return Kink(np.zeros(len(opening)), np.where(opening >= 0, opens, 0.0))
