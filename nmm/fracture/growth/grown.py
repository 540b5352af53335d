"""How far crack fronts have grown, and the fracture energy that it took."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import shapely

from integration.arrays import Floats, Ints
from nmm.assembly.model import Model
from nmm.fracture.growth.fronts import CrackFronts
from nmm.fracture.growth.tips.intensities import tip_moduli
from nmm.fracture.toughness import Toughness


@dataclass(frozen=True)
class GrownSoFar:
    """Growth since the start of the run.

    Attributes
    ----------
    length
        (n,) how far each front has grown (m).
    energy
        Fracture energy of the whole growth (J).
    shut
        Largest ratio -K_I / |K| at which a front has grown.
    crowded
        Largest `crowding` of tips at which a front has grown.
    """

    length: Floats
    energy: float
    shut: float = 0.0
    crowded: float = 0.0

    def seen(self, shut: float, crowded: float) -> "GrownSoFar":
        """Return the same with -K_I / |K| ``shut`` and `crowding` of tips about to grow."""
        return replace(self, shut=max(self.shut, shut), crowded=max(self.crowded, crowded))

    def after(
        self, model: Model, fronts: CrackFronts, lines: Sequence[Sequence[Floats]], rule: Toughness
    ) -> "GrownSoFar":
        """Return the growth after a change of the cracks.

        Parameters
        ----------
        model
            The model before the change.
        fronts
            The fronts after the change.
        lines
            The polylines before and after the change.
            rule
            Toughness of the material.
        """
        gained = fronts.gained(*lines)
        grown = np.flatnonzero(gained > 0)
        stiff = tip_moduli(model, nearest_elements(model, fronts.former(*lines)[grown]))[1]
        energy = model.thickness * gained[grown] @ rule.energies(stiff)
        length = np.pad(self.length, (0, len(gained) - len(self.length)))
        return replace(self, length=length + gained, energy=self.energy + float(energy))


def nearest_elements(model: Model, points: Floats) -> Ints:
    """Element (k,) nearest to each of some points (k, 2)."""
    tree = shapely.STRtree(model.manifold.elements.to_shapely())
    return np.asarray(tree.nearest(shapely.points(points)), dtype=np.int64)
