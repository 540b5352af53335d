"""Growth straight ahead, as in specimens with side grooves and along weak planes."""

from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats
from nmm.fracture.criteria.base import Criterion, Kink


@dataclass(frozen=True)
class StraightAhead(Criterion):
    """A crack grows without a kink when it releases ``K_Ic^2 / E'`` (Irwin 1957).

    One that is pressed does by what slides. The crack of a double cantilever beam, for one, is
    directionally unstable, and is kept in its plane by grooves.
    """

    def kink(self, opening: Floats, sliding: Floats, kappa: Floats) -> Kink:
        equivalent = np.hypot(np.maximum(opening, 0.0), sliding)
        return Kink(np.zeros(len(opening)), equivalent)
