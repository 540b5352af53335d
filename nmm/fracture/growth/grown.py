"""How far fronts have grown, and what that took."""

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
    """What growth has been.

    Attributes
    ----------
    length
        (n,) how far each front has grown (m).
    energy
        That all of them took (J).
    shut
        Largest of -K_I over |K| at which any has grown.
    """

    length: Floats
    energy: float
    shut: float = 0.0

    def seen(self, shut: float) -> "GrownSoFar":
        """Return it with tips that grow where they are so far pressed shut."""
        return replace(self, shut=max(self.shut, shut))

    def after(
        self, model: Model, fronts: CrackFronts, lines: Sequence[Sequence[Floats]], rule: Toughness
    ) -> "GrownSoFar":
        """Return both where cracks have grown.

        Parameters
        ----------
        model
            Before.
        fronts
            After.
        lines
            Polylines before and after.
        """
        gained = fronts.gained(*lines)
        grown = np.flatnonzero(gained > 0)
        stiff = tip_moduli(model, nearest_elements(model, fronts.former(*lines)[grown]))[1]
        energy = model.thickness * gained[grown] @ rule.energies(stiff)
        length = np.pad(self.length, (0, len(gained) - len(self.length)))
        return GrownSoFar(length + gained, self.energy + float(energy), self.shut)


def nearest_elements(model: Model, points: Floats) -> Ints:
    """Element (k,) nearest to each of some points (k, 2)."""
    tree = shapely.STRtree(model.manifold.elements.to_shapely())
    return np.asarray(tree.nearest(shapely.points(points)), dtype=np.int64)
