"""The growth rule of ``[fracture]``: when cracks grow, in which direction and by how much."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Bools, Floats
from nmm.fracture.criteria.base import CRITERIA, Criterion, Kink
from nmm.fracture.growth.fronts import may_grow
from nmm.fracture.toughness import Toughness

if TYPE_CHECKING:
    from nmm.scene.tables.fracture.table import FractureTable

# Share of the toughness by which a critical front may fall short of it.
ROUNDING = 1e-6


@dataclass(frozen=True)
class GrowthRule:
    """Rule of crack growth.

    Attributes
    ----------
    criterion, toughness
        In which direction cracks grow, and when.
    increment
        Length of a new segment (m).
    max_growth
        Largest growth of a front (m); infinite without a limit.
    together
        Fronts that fall short of their toughness by up to this share grow with a critical one.
    """

    criterion: Criterion
    toughness: Toughness
    increment: float
    max_growth: float
    together: float

    @classmethod
    def of(cls, table: "FractureTable") -> "GrowthRule":
        """Return the rule of a scene's table."""
        criterion = CRITERIA.make(table.criterion)
        most = np.inf if table.max_growth is None else table.max_growth
        toughness = Toughness(table.toughness, table.energy)
        return cls(criterion, toughness, table.increment, most, table.together)

    def toughness_ratios(self, kink: Kink, stiff: Floats) -> Floats:
        """Ratio (n,) of equivalent K to K_Ic at fronts of effective modulus E' ``stiff`` (Pa)."""
        return np.asarray(kink.equivalent / self.toughness.intensities(stiff))

    def free(self, grown: Floats) -> Bools:
        """Which fronts (n,) have not reached the largest growth."""
        return may_grow(grown, self.max_growth)

    def growing(self, share: Floats, grown: Floats) -> Bools:
        """Which fronts (n,) grow: once one is critical, all that nearly are."""
        free = self.free(grown)
        critical = bool((share[free] >= 1 - ROUNDING).any())
        return np.asarray(free & critical & (share >= 1 - max(self.together, ROUNDING)))
