"""The effect of ``[fracture]`` in statics: whole pieces, each in equilibrium."""

from typing import TYPE_CHECKING

from nmm.fracture.growth.growing import GrowingCracks

if TYPE_CHECKING:
    from nmm.effects.change import Change


class CrackGrowth(GrowingCracks):
    """Cracks that grow in statics; what growth takes is the energy that a change of it frees."""

    def follow(self, change: "Change") -> "CrackGrowth":
        """Return the effect on the new geometry, with what its fronts have gained."""
        return CrackGrowth(change.setup, self._grown_so_far(change))
