"""When cracks grow, which way and by how much: what ``[fracture]`` says."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Bools, Floats
from nmm.fracture.criteria.base import CRITERIA, Criterion, Kink
from nmm.fracture.growth.fronts import may_grow
from nmm.fracture.toughness import Toughness

if TYPE_CHECKING:
    from nmm.scene.tables.fracture.table import FractureTable

# Part of the toughness by which a front that is critical may fall short of it.
ROUNDING = 1e-6


@dataclass(frozen=True)
class GrowthRule:
    """How cracks grow.

    Attributes
    ----------
    criterion, toughness
        Which way, and when.
    increment
        Length of a new piece (m).
    most
        Growth of a front at which it stops (m); infinite without.
    together
        Fronts that fall short of their toughness by up to this part of it grow with a critical one.
    """

    criterion: Criterion
    toughness: Toughness
    increment: float
    most: float
    together: float

    @classmethod
    def of(cls, table: "FractureTable") -> "GrowthRule":
        """Return the rule of a scene's table."""
        criterion = CRITERIA.make(table.criterion)
        most = np.inf if table.max_growth is None else table.max_growth
        toughness = Toughness(table.toughness, table.energy)
        return cls(criterion, toughness, table.increment, most, table.together)

    def shares(self, kink: Kink, stiff: Floats) -> Floats:
        """Share (n,) of the toughness that fronts have reached, E' being ``stiff`` (Pa)."""
        return np.asarray(kink.equivalent / self.toughness.intensities(stiff))

    def free(self, grown: Floats) -> Bools:
        """Which fronts (n,) have not grown as far as they may."""
        return may_grow(grown, self.most)

    def growing(self, share: Floats, grown: Floats) -> Bools:
        """Which fronts (n,) grow: none before one is critical, then all that nearly are."""
        free = self.free(grown)
        critical = bool((share[free] >= 1 - ROUNDING).any())
        return np.asarray(free & critical & (share >= 1 - max(self.together, ROUNDING)))
