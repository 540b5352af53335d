"""The effect of ``[fracture]`` in statics: segment after segment, each followed by equilibrium."""

from typing import TYPE_CHECKING, Any

import numpy as np

from nmm.constraints.ties.shared_edges import bonded_groups
from nmm.effects.base import Setup
from nmm.fracture.growth.growing import GrowingCracks
from nmm.fracture.growth.grown import GrownSoFar
from nmm.fracture.growth.growth_path import GrowthPath

if TYPE_CHECKING:
    from nmm.effects.change import Change

# Cells that must be left of a ligament for its load to count: with a fifth to a third of a cell
# loads are 20 to 35 % too large.
SHORT = 1.0


class CrackGrowth(GrowingCracks):
    """Crack growth in statics; the energy that growth takes is the one that the change frees."""

    def __init__(
        self,
        setup: Setup,
        sofar: GrownSoFar | None = None,
        path: GrowthPath | None = None,
        parted: bool = False,
    ) -> None:
        super().__init__(setup, sofar)
        self._path = GrowthPath() if path is None else path
        self.parted = parted
        self.dead_factor = 0.0
        # A crack that nucleates frees its energy under the load at which the strength was reached.
        self.at_toughness = self._followed and not setup.geometry.nuclei

    def follow(self, change: "Change") -> "CrackGrowth":
        """Return the effect on the new geometry, with the growth of its fronts."""
        more = change.new.manifold.n_bodies > change.old.manifold.n_bodies
        parted = self.parted or (more and bonded_groups(change.setup) > bonded_groups(self._setup))
        begun = len(change.setup.geometry.nuclei) > len(self._setup.geometry.nuclei)
        path = self._path.begun_anew() if begun else self._path
        return CrackGrowth(change.setup, self._grown_so_far(change), path, parted)

    def arrived(self, factor: float, stored: float, freed: float) -> float:
        if not self._followed:
            return 0.0
        before = self._path
        self._path = before.on(self._length, factor, stored, freed, self.dead_factor)
        return self._path.beyond_chords() - before.beyond_chords()

    @property
    def _followed(self) -> bool:
        """Whether loads are controlled so that cracks stay at their toughness."""
        return self._table.control == "toughness"

    def energy_freed(self, booked: float, stored: float) -> float:
        """See `GrowingCracks.energy_freed`; with the last piece where it left no tip."""
        ended = self.parted or not len(self._measured.tip)
        if not ended or not len(self._path.equilibria):
            return booked
        # The energy that the last cut released by itself is booked already.
        let_go = float(self._path.equilibria[-1, 3]) - stored
        short = self._short if self.parted else None
        return booked - let_go + self._path.to_the_end(self._length, short)

    @property
    def _short(self) -> float:
        """Length of all ligaments (m) below which loads are no longer accurate."""
        size = self._setup.formulation.cover.finest
        assert size is not None  # of meshes
        return SHORT * size * float((self._sofar.length > 0).sum())

    @property
    def _length(self) -> float:
        return float(self._sofar.length.sum())

    def carried(self) -> tuple[Any, ...]:
        """See `GrowingCracks.carried`; with the growth path at the toughness."""
        return (*super().carried(), self._path.equilibria, self._path.jumped, self.parted)

    def carry(self, carried: tuple[Any, ...]) -> None:
        *sofar, equilibria, jumped, parted = carried
        super().carry(tuple(sofar))
        self._path, self.parted = GrowthPath(np.asarray(equilibria), jumped), parted
