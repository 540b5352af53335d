"""Cracks that grow where their tips reach the toughness: what statics and motion have in common."""

from abc import abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, ClassVar, Self

import numpy as np

from integration.arrays import Bools, Floats
from nmm.assembly.motion import MaterialPoints, State, material_points
from nmm.assembly.pushes import PushesIn
from nmm.assembly.stress_points import PressureAt, StressAt
from nmm.effects.base import Effect, Setup
from nmm.effects.event import Event
from nmm.fracture.growth.advance import advanced
from nmm.fracture.growth.beginning import CrackBeginnings
from nmm.fracture.growth.faces import CrackFaces
from nmm.fracture.growth.fronts import CrackFronts, nucleus_name
from nmm.fracture.growth.grown import GrownSoFar
from nmm.fracture.growth.refusals import refuse
from nmm.fracture.growth.rule import GrowthRule
from nmm.fracture.growth.tips.intensities import Intensities
from nmm.fracture.growth.tips.measured import MeasuredTips
from nmm.fracture.growth.tips.parallel_stress import at_end_of_piece, parallel_stress
from nmm.quantity import SPOT, Quantity

if TYPE_CHECKING:
    from nmm.effects.change import Change
    from nmm.effects.view import View


class GrowingCracks(Effect):
    """Cracks of the scene that grow by a rule; their fracture energy is what the growth takes."""

    name = "fracture"
    external = False
    held: ClassVar[bool] = False
    """Whether new faces are held at first."""
    at_toughness: bool = False
    """Whether the load keeps cracks at their toughness, so that they free just what they take."""

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
        self._measured = MeasuredTips(setup, self.rule, self._tips, table.radius, self.held)
        self._beginnings = CrackBeginnings(setup, self.rule.toughness)

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
        made._beginnings.refuse()
        return made

    @property
    def caution(self) -> str:
        """See `Effect.caution`: cracks that begin too short for the net or for the toughness."""
        return self._beginnings.caution

    @property
    def about(self) -> str:
        """See `Effect.about`."""
        said = f"{self._table.criterion}, pieces of {self.rule.increment:g} m"
        return said + self._beginnings.about

    @property
    def energy_taken(self) -> float:
        """Energy (J) that the growth so far took by the toughness of the material."""
        return self._sofar.energy

    @property
    def swing(self) -> float:
        """Angle (rad) by which pieces have turned one way and the next ones back, the largest."""
        cracks = self._setup.geometry.cracks
        return self._fronts.swing(cracks, self._sofar.length)

    @property
    def shut(self) -> float:
        """Largest of -K_I over |K| at which a crack has grown."""
        return self._sofar.shut

    def arrived(self, factor: float, stored: float) -> float:
        """Note a balance at the toughness; return the energy (J) to book beside that of chords.

        ``stored`` is the energy (J) stored under the load factor.
        """
        return 0.0

    def freed_until_now(self, booked: float, stored: float) -> float:
        """Energy (J) that growth freed: what is ``booked``, where so much is ``stored`` at last."""
        return booked

    def intensities(self, state: State) -> Intensities:
        """Return what the tips have in a state."""
        return self._measured.in_state(state)

    def reached(self, state: State) -> float | None:
        """Share of what it takes that what grows or begins first has reached; None if nothing can.

        Fronts that have grown as far as they may count where nothing else is left that feels the
        load; it is zero where no tip does.
        """
        nucleus = self._beginnings.next(state)
        if not len(self._measured.tip) and nucleus is None:
            return None
        found = self._measured.felt(state)
        begins = [] if nucleus is None else [nucleus.share]
        left = np.append(found.share[self.free(found)], begins)
        left = left if len(left) else found.share
        return float(left.max(initial=0.0))

    def unopened(self, state: State) -> float:
        """Largest share of the strength where no line fits along which a crack could begin."""
        return self._beginnings.unopened(state)

    def feel(self, stresses: Sequence[StressAt]) -> None:
        """See `Effect.feel`."""
        self._measured.stresses = stresses
        self._beginnings.feel(stresses)

    def feel_pores(self, pressures: Sequence[PressureAt]) -> None:
        """See `Effect.feel_pores`."""
        self._beginnings.feel_pores(pressures)

    def feel_pushes(self, pushing: Sequence[PushesIn]) -> None:
        """See `Effect.feel_pushes`."""
        self._measured.pushing = pushing

    def free(self, found: Intensities) -> Bools:
        """Which fronts (k,) with a tip have not grown as far as they may."""
        return self.rule.free(self._sofar.length[found.front])

    def _growing(self, found: Intensities) -> Bools:
        """Which fronts (k,) with a tip grow in a state."""
        return self.rule.growing(found.share, self._sofar.length[found.front])

    def event(self, view: "View") -> Event | None:
        """Ask for new pieces where tips have reached their toughness, else for a new crack."""
        found = self.intensities(view.state)
        rows = np.flatnonzero(self._growing(found))
        geometry = self._setup.geometry
        if not len(rows):
            return self._beginnings.event(view.state, self.held)
        grown = found.take(rows)
        self._sofar = self._sofar.seen(grown.shut)
        cracks, what = self._laid(self._led(grown, view.state))
        return Event(replace(geometry, cracks=cracks), what, held=self.held)

    def _led(self, found: Intensities, state: State) -> Intensities:
        """Return fronts with the kinks that the parallel stress leaves, where the scene asks."""
        if not self._table.parallel_stress:
            return found
        behind, kink = self.rule.increment / 2, found.kink
        acting = self._measured.pushes(state), self._measured.stresses
        stress = parallel_stress(self._setup.model, state, found.tip, behind, *acting)
        angle = at_end_of_piece(
            kink.angle, found.opening, found.sliding, stress, self.rule.increment
        )
        return replace(found, kink=replace(kink, angle=angle))

    def _laid(self, found: Intensities) -> tuple[tuple[Floats, ...], str]:
        """Polylines with new pieces at all fronts ``found``, and what happens, in words."""
        cut, cracks = self._setup.model.cut, self._setup.geometry.cracks
        ways = found.front, found.tip, found.kink.angle
        laid = advanced(cut, cracks, self._fronts, *ways, self.rule.increment)
        names = ", ".join(self._fronts.name[one] for one in found.front)
        return laid, f"cracks grew at {names}"

    @abstractmethod
    def follow(self, change: "Change") -> "GrowingCracks":
        """Return the effect on the new geometry, with what its fronts have gained."""

    @classmethod
    def in_place_of(cls, other: Effect, change: "Change") -> Self:
        """See `Effect.in_place_of`: tips are where they are, and no force holds new faces."""
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
    def _spots(self) -> MaterialPoints:
        """Tips of the fronts that have one."""
        model, tip = self._setup.model, self._measured.tip
        tips = model.cut.tips
        return material_points(model.manifold, tips.element[tip], tips.point[tip])

    def outputs(self, state: State) -> Mapping[str, Quantity]:
        """Faces of the cracks and their tips, where they are in a state."""
        found = self.intensities(state)
        place = self._spots.place(state.frames, state.deformation)
        return {
            **self._faces.quantities(state),
            "tip": Quantity("tips", place, "m", SPOT),
            **found.quantities(),
        }

    def history(self, state: State) -> Mapping[str, float]:
        """Length and opening of cracks, place, growth and intensities of fronts, energy (J).

        The opening is the largest between the faces of a crack, the energy what growth took.
        """
        found = self.intensities(state)
        cracks = self._setup.geometry.cracks
        row = {"growth": float(self._sofar.length.sum()), "energy": self._sofar.energy}
        row |= self._faces.row(self._lines, cracks, state)
        row |= self._beginnings.history(state)
        row |= self._fronts.history(cracks, self._setup.origin, self._sofar.length)
        row |= found.row(self._fronts.name)
        return {key: float(value) for key, value in row.items()}

    def carried(self) -> tuple[Any, ...]:
        """How far each front has grown (m), what that took (J), and how far tips were shut."""
        return self._sofar.length, self._sofar.energy, self._sofar.shut

    def carry(self, carried: tuple[Any, ...]) -> None:
        """See `Effect.carry`."""
        self._sofar = GrownSoFar(*carried)

    def forget(self) -> None:
        """See `Effect.forget`."""
        self._measured.forget()
        self._beginnings.forget()
