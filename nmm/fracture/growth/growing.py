"""Growing cracks: what crack growth in statics and in time have in common."""

from abc import abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import astuple, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, ClassVar, Self

import numpy as np

from integration.arrays import Bools, Floats
from nmm.assembly.applied_forces import AppliedForcesIn
from nmm.assembly.material_points import MaterialPoints, material_points
from nmm.assembly.state import State
from nmm.assembly.stress_points import PressureAt, StressAt
from nmm.effects.base import Effect, Setup
from nmm.effects.event import Event
from nmm.fracture.growth.advance import extended_lines
from nmm.fracture.growth.blocks_met import blocks_met
from nmm.fracture.growth.crack_nucleation import CrackNucleation
from nmm.fracture.growth.faces import CrackFaces
from nmm.fracture.growth.fronts import CrackFronts, nucleus_name
from nmm.fracture.growth.grown import GrownSoFar
from nmm.fracture.growth.refusals import refuse
from nmm.fracture.growth.rule import GrowthRule
from nmm.fracture.growth.small_holes import small_holes
from nmm.fracture.growth.tips.crowded_tips import crowding
from nmm.fracture.growth.tips.intensities import Intensities
from nmm.fracture.growth.tips.measured import MeasuredTips
from nmm.quantity import SPOT, Quantity

if TYPE_CHECKING:
    from nmm.effects.change import Change
    from nmm.effects.view import View


class GrowingCracks(Effect):
    """Cracks of the scene that grow by a rule, and cracks that nucleate."""

    name = "fracture"
    external = False
    continuous: ClassVar[bool] = False
    """Whether the tractions on new faces are released gradually (`ReleasedTractions`)."""
    at_toughness: bool = False
    """Whether the load keeps cracks at their toughness, so that they free their fracture energy."""
    dead_factor: float = 0.0
    """Load factor that would open the critical tip as what no factor scales does."""
    parted: bool = False
    """Whether a piece came free at the toughness: no bond holds it to what it was cut off."""

    def __init__(self, setup: Setup, sofar: GrownSoFar | None = None) -> None:
        table = setup.scene.fracture
        assert table is not None
        self.rule = GrowthRule.of(table)
        cracks, nuclei = setup.geometry.cracks, setup.geometry.nuclei
        names = [crack.name for crack in setup.scene.cracks]
        self._setup, self._table = setup, table
        self._lines = dict(enumerate(names)) | {
            line: nucleus_name(number) for number, line in enumerate(nuclei)
        }
        self._fronts = CrackFronts.of(names).with_born(len(cracks), nuclei)
        self._sofar = GrownSoFar(np.zeros(len(self._fronts)), 0.0) if sofar is None else sofar
        self._tips = self._fronts.tips(setup.model.cut, cracks)
        self._measured = MeasuredTips(setup, self.rule, self._tips, table.radius)
        self._nucleation = CrackNucleation(setup, self.rule.toughness)

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build from ``[fracture]`` and ``[[cracks]]``.

        Raises
        ------
        SceneError, FormulationError
            See `refuse`.
        """
        made = cls(setup)
        refuse(setup, made._tips)
        made._nucleation.refuse()
        return made

    @property
    def caution(self) -> str:
        """See `Effect.caution`: nuclei too short, cells too coarse for holes and domains."""
        holes = small_holes(self._setup, self._measured.tip, self.rule.max_growth)
        return "; ".join(filter(None, (self._nucleation.caution, holes, self._measured.caution)))

    @property
    def about(self) -> str:
        pieces = f"pieces of {self.rule.increment:g} m{self._nucleation.about}"
        return f"{self._table.criterion}, {pieces}"

    @property
    def energy_taken(self) -> float:
        """Fracture energy (J) of the growth since the start."""
        return self._sofar.energy

    @property
    def swing(self) -> float:
        """Largest zigzag (rad) of the paths, see `CrackFronts.swing`."""
        return self._fronts.swing(self._setup.geometry.cracks, self._sofar.length)

    @property
    def shut(self) -> float:
        """Largest ratio -K_I / |K| at which a crack has grown."""
        return self._sofar.shut

    @property
    def crowded(self) -> float:
        """Largest `crowding` of tips that have grown, and of those that are left."""
        return max(self._sofar.crowded, crowding(self._setup.model.cut, self._measured.tip))

    def arrived(self, factor: float, stored: float, freed: float) -> float:
        """Record an equilibrium at the toughness; return the energy (J) beyond the chord's.

        ``stored`` is the energy (J) stored under the load factor ``factor``, ``freed`` what growth
        is booked to have freed (J). See `GrowthPath`.
        """
        return 0.0

    def energy_freed(self, booked: float, stored: float) -> float:
        """Return the energy (J) freed by growth, of which ``booked`` is booked already.

        ``stored`` is the energy (J) stored at the end of the run.
        """
        return booked

    def intensities(self, state: State) -> Intensities:
        """Return the intensity factors of the tips in a state."""
        return self._measured.in_state(state)

    def reached(self, state: State) -> float | None:
        """Largest ratio to toughness of a tip, or to strength of a nucleus; None without any.

        Fronts at their largest growth count only where no other loaded tip is left. Zero where no
        tip is loaded.
        """
        nucleus = self._nucleation.next(state)
        if not len(self._measured.tip) and nucleus is None:
            return None
        found = self._measured.loaded_tips(state)
        begins = [] if nucleus is None else [nucleus.share]
        left = np.append(found.share[self.free(found)], begins)
        left = left if len(left) else found.share
        return float(left.max(initial=0.0))

    def unopened_strength_ratio(self, state: State) -> float:
        """See `CrackNucleation.unopened_strength_ratio`."""
        return self._nucleation.unopened_strength_ratio(state)

    def receive_stresses(self, stresses: Sequence[StressAt]) -> None:
        self._measured.stresses = stresses
        self._nucleation.receive_stresses(stresses)

    def receive_pore_pressures(self, pressures: Sequence[PressureAt]) -> None:
        self._nucleation.receive_pore_pressures(pressures)

    def receive_forces(self, forces: Sequence[AppliedForcesIn]) -> None:
        self._measured.forces = forces

    def free(self, found: Intensities) -> Bools:
        """Which fronts (k,) with a tip have not reached the largest growth."""
        return self.rule.free(self._sofar.length[found.front])

    def _growing(self, found: Intensities) -> Bools:
        """Which fronts (k,) with a tip grow in a state."""
        return self.rule.growing(found.share, self._sofar.length[found.front])

    def event(self, view: "View") -> Event | None:
        """Return the event of new segments at critical tips, else of a nucleus."""
        found = self.intensities(view.state)
        rows = np.flatnonzero(self._growing(found))
        geometry = self._setup.geometry
        if not len(rows):
            return self._nucleation.event(view.state, self.continuous)
        grown = found.take(rows)
        crowded = crowding(self._setup.model.cut, grown.tip)
        self._sofar = self._sofar.seen(grown.shut, crowded)
        if self._table.parallel_stress:
            grown = self._measured.with_parallel_stress(grown, view.state)
        cracks, what = self._extended(grown)
        return Event(replace(geometry, cracks=cracks), what, continuous=self.continuous)

    def _extended(self, found: Intensities) -> tuple[tuple[Floats, ...], str]:
        """Polylines with new segments at all fronts ``found``, and what happened, in words."""
        cut, cracks, piece = self._setup.model.cut, self._setup.geometry.cracks, self.rule.increment
        fronts = found.front, found.tip, found.kink.angle
        lines = extended_lines(cut, cracks, self._fronts, *fronts, piece)
        names = [self._fronts.name[one] for one in found.front]
        met = blocks_met(self._setup, found.tip, self._fronts.points(lines)[found.front], piece)
        pairs = zip(names, met, strict=True)
        stopped = [f"{name} ends where its block meets {one}" for name, one in pairs if one]
        return lines, "; ".join([f"cracks grew at {', '.join(names)}", *stopped])

    @abstractmethod
    def follow(self, change: "Change") -> "GrowingCracks":
        """Return the effect on the new geometry, with the growth of its fronts."""

    @classmethod
    def in_place_of(cls, other: Effect, change: "Change") -> Self:
        """See `Effect.in_place_of`: fronts stay where they are; no tractions are released."""
        assert isinstance(other, GrowingCracks)
        return cls(change.setup, other._grown_so_far(change))

    def _grown_so_far(self, change: "Change") -> GrownSoFar:
        lines = self._setup.geometry.cracks, change.setup.geometry.cracks
        fronts = self._fronts.with_born(len(lines[1]), change.setup.geometry.nuclei)
        return self._sofar.after(self._setup.model, fronts, lines, self.rule.toughness)

    @cached_property
    def _faces(self) -> CrackFaces:
        return CrackFaces.of(self._setup.model)

    @cached_property
    def _tip_points(self) -> MaterialPoints:
        """The tips as material points."""
        model, tip = self._setup.model, self._measured.tip
        tips = model.cut.tips
        return material_points(model.manifold, tips.element[tip], tips.point[tip])

    def outputs(self, state: State) -> Mapping[str, Quantity]:
        """Return crack faces and tips at their places in a state."""
        found = self.intensities(state)
        place = self._tip_points.place(state.frames, state.deformation)
        return {
            **self._faces.quantities(state),
            "tip": Quantity("tips", place, "m", SPOT),
            **found.quantities(),
        }

    def history(self, state: State) -> Mapping[str, float]:
        """Return length and opening of cracks, place, growth and intensity factors of fronts.

        Also the whole growth (m) and the fracture energy (J). The opening is the largest along a
        crack.
        """
        found = self.intensities(state)
        cracks = self._setup.geometry.cracks
        row = {"growth": float(self._sofar.length.sum()), "energy": self._sofar.energy}
        row |= self._faces.row(self._lines, cracks, state)
        row |= self._nucleation.history(state)
        row |= self._fronts.history(cracks, self._setup.origin, self._sofar.length)
        return {key: float(value) for key, value in (row | found.row(self._fronts.name)).items()}

    def carried(self) -> tuple[Any, ...]:
        """Growth of each front (m), its fracture energy (J), largest -K_I / |K| and crowding."""
        return astuple(self._sofar)

    def carry(self, carried: tuple[Any, ...]) -> None:
        self._sofar = GrownSoFar(*carried)

    def forget(self) -> None:
        self._measured.forget()
        self._nucleation.forget()
