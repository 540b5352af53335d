"""The effect of ``[fracture]`` in statics: whole pieces, each in equilibrium."""

from typing import TYPE_CHECKING, Any

from nmm.effects.base import Setup
from nmm.fracture.growth.growing import GrowingCracks
from nmm.fracture.growth.grown import GrownSoFar
from nmm.fracture.growth.on_the_way import Station, freed_over_chord

if TYPE_CHECKING:
    from nmm.effects.change import Change


class CrackGrowth(GrowingCracks):
    """Cracks that grow in statics; what growth takes is the energy that a change of it frees."""

    def __init__(
        self,
        setup: Setup,
        sofar: GrownSoFar | None = None,
        stations: tuple[Station, ...] = (),
        jump: float | None = None,
    ) -> None:
        super().__init__(setup, sofar)
        self._stations, self._jump = stations, jump

    def follow(self, change: "Change") -> "CrackGrowth":
        """Return the effect on the new geometry, with what its fronts have gained."""
        factor, sofar = change.state.load_factor, self._grown_so_far(change)
        if len(change.setup.geometry.nuclei) > len(self._setup.geometry.nuclei):
            return CrackGrowth(change.setup, sofar, jump=factor)
        passed = (*self._stations, self._station(factor))[-2:]
        return CrackGrowth(change.setup, sofar, passed)

    def freed_over_chord(self, factor: float) -> float:
        """See `GrowingCracks.freed_over_chord`; a crack begins at once, under the load before."""
        if self._table.control != "toughness":
            return 1.0
        if self._jump is not None:
            return self._jump / factor if self._jump * factor > 0 else 1.0
        return freed_over_chord((*self._stations, self._station(factor)))

    def _station(self, factor: float) -> Station:
        return float(self._sofar.length.sum()), factor

    def carried(self) -> tuple[Any, ...]:
        """See `GrowingCracks.carried`; and the last loads at the toughness, or at a beginning."""
        return (*super().carried(), self._stations, self._jump)

    def carry(self, carried: tuple[Any, ...]) -> None:
        """See `Effect.carry`."""
        *sofar, stations, self._jump = carried
        super().carry(tuple(sofar))
        self._stations = tuple((length, factor) for length, factor in stations)
