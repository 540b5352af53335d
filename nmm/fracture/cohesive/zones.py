"""The effect of ``[cohesive_zones]``: bonded faces are inserted where the stress requires them.

The mean stress ahead of a tip determines when and in which direction. The new faces are intact at
first and change no stress; their own law lets them open, when their traction reaches the strength.
So the instant of insertion matters little, as long as it is before the faces would open.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar, Self

import numpy as np

from integration.arrays import Bools, Floats, Ints
from nmm.assembly.state import State
from nmm.effects.base import Effect, Setup
from nmm.effects.event import Event
from nmm.errors import Fault, FormulationError, SceneError
from nmm.fracture.cohesive.mean_stress import StressMeans
from nmm.fracture.cohesive.nucleus import ZoneNuclei
from nmm.fracture.cohesive.pieces import extended, with_nucleus
from nmm.fracture.cohesive.strength import element_strength
from nmm.fracture.cohesive.zone_fronts import zone_fronts
from nmm.fracture.growth.fronts import may_grow
from nmm.materials.principal_stresses import PrincipalStresses

if TYPE_CHECKING:
    from nmm.contact.points.contact_points import ContactPoints
    from nmm.effects.change import Change
    from nmm.effects.view import View

# Cells by which a zone extends beyond where it opens: a crack without tip functions acts as if it
# ended up to a cell and a half earlier.
LAG = 2.5


@dataclass(frozen=True)
class ZoneTips:
    """The tips of zones in a state.

    Attributes
    ----------
    front, tip
        (k,) fronts with a tip, and their tips in the cut.
    share
        (k,) largest principal value of the mean stress ahead, over the strength.
    plane
        (k, 2) unit vectors along the planes in which they would grow.
    """

    front: Ints
    tip: Ints
    share: Floats
    plane: Floats


def failing_joints(contacts: "ContactPoints") -> Bools:
    """Which contact points (m,) are joints whose bond has failed or softens."""
    lost = contacts.is_joint & ~contacts.bonded
    damage = contacts.history.get("damage")
    return np.asarray(lost if damage is None else lost | (contacts.is_joint & (damage > 0)))


class CohesiveZones(Effect):
    """Cohesive zones that grow from tips and nuclei; contact books the energy that they take."""

    name = "cohesive zones"
    external = False
    on_paths: ClassVar[bool] = True

    def __init__(self, setup: Setup, grown: Mapping[str, float]) -> None:
        table = setup.scene.cohesive_zones
        assert table is not None
        self._setup, self._table, self._grown = setup, table, dict(grown)
        self._length = table.increment if table.length is None else table.length
        assert setup.formulation.cover.size is not None
        self._lag = LAG * setup.formulation.cover.size
        names = [crack.name for crack in setup.scene.cracks]
        self._fronts = zone_fronts(setup.geometry, names)
        self._tips = self._fronts.tips(setup.model.cut, setup.geometry.cracks)
        self._strength = element_strength(setup)
        self._means = self._ahead()
        self._nuclei = self._places() if table.nucleation else None

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build from ``[cohesive_zones]``, ``[[cracks]]`` and the interfaces.

        Raises
        ------
        SceneError
            Nothing can grow, or no strength is given.
        FormulationError
            Cracks cannot cut the cover, or a material is nonlinear.
        """
        place = setup.scene.source.place("cohesive_zones")
        if setup.formulation.cover.size is None:
            value = f'cover type "{setup.formulation.cover.type}"'
            remedy = 'use type = "triangles" with a size in [cover]'
            raise FormulationError(Fault(place, value, "a mesh, which cracks can cut", remedy))
        if setup.model.matter is not None:
            remedy = "use elastic materials, or remove [cohesive_zones]"
            value, expected = "matter that is not linear", "elastic matter"
            raise FormulationError(Fault(place, value, expected, remedy))
        made = cls(setup, {})
        if not (made._tips >= 0).any() and made._nuclei is None:
            remedy = "let one of [[cracks]] end inside a block, or add nucleation = true"
            raise SceneError(Fault(place, "no crack tip", "where a zone begins", remedy))
        return made

    @property
    def about(self) -> str:
        return f"pieces of {self._table.increment:g} m, stress averaged over {self._length:g} m"

    @property
    def caution(self) -> str:
        """See `Effect.caution`: paths follow a mesh that is coarser than the length of means."""
        size = self._setup.formulation.cover.finest
        if size is None or size <= self._length:
            return ""
        return (
            f"stress is averaged over {self._length:g} m on cells of {size:g} m: ways of zones "
            "turn with the net, by up to 4 degrees; take cells no larger than that length"
        )

    def _ahead(self) -> StressMeans:
        """Mean stress ahead of the tips."""
        tips, model = self._setup.model.cut.tips, self._setup.model
        tip = self._tips[self._tips >= 0]
        body = model.manifold.element_body[tips.element[tip]]
        return StressMeans.about(model, tips.point[tip], body, self._length, tips.direction[tip])

    def _places(self) -> ZoneNuclei:
        return ZoneNuclei.of(self._setup.model, self._setup.geometry, self._strength, self._length)

    def tip_state(self, state: State) -> ZoneTips:
        """Return the tips in a state."""
        front = np.flatnonzero(self._tips >= 0)
        tip = self._tips[front]
        principal = PrincipalStresses.of(self._means.of(state.deformation))
        strength = self._strength[self._setup.model.cut.tips.element[tip]]
        share, ahead = principal.larger / strength, self._setup.model.cut.tips.direction[tip]
        # Where stress is low its direction is arbitrary: such a zone goes straight ahead.
        strong = share >= self._table.ahead
        return ZoneTips(front, tip, share, np.where(strong[:, None], principal.plane, ahead))

    def _short(self, found: ZoneTips, contacts: "ContactPoints | None") -> Bools:
        """Whether zones (k,) end too near to their start, or to failing bonds.

        Faces act only where they separate all covers that they cross, and must still be intact
        there when their traction reaches the strength.
        """
        geometry, tips = self._setup.geometry, self._setup.model.cut.tips.point[found.tip]
        crack = self._fronts.crack[found.front]
        zone = np.isin(crack, geometry.bonded)
        begun = np.array([geometry.cracks[one][0] for one in crack]).reshape(-1, 2)
        fresh = (crack >= len(self._setup.scene.cracks)) & zone
        short = fresh & (np.hypot(*(tips - begun).T) < self._lag)
        if contacts is None or not len(contacts):
            return np.asarray(short)
        given = contacts.take(failing_joints(contacts))
        place = self._setup.model.manifold.boundary.at(given.edge_a, given.parameter_a)
        away = np.hypot(*np.moveaxis(tips[:, None] - place, -1, 0))
        return np.asarray(short | (zone & (away < self._lag).any(axis=1)))

    def _free(self, front: Ints) -> Bools:
        """Which fronts (k,) have not reached the largest growth."""
        most = np.inf if self._table.max_growth is None else self._table.max_growth
        return may_grow(self._lengths[front], most)

    @property
    def _lengths(self) -> Floats:
        """Growth (n,) of each front (m)."""
        return np.array([self._grown.get(name, 0.0) for name in self._fronts.name])

    def event(self, view: "View") -> Event | None:
        """Return the event of new segments where the stress requires them, else of a nucleus."""
        found = self.tip_state(view.state)
        called = (found.share >= self._table.ahead) | self._short(found, view.contacts)
        rows = np.flatnonzero(self._free(found.front) & called)
        geometry, model = self._setup.geometry, self._setup.model
        length = self._table.increment
        if len(rows):
            front, tip, plane = found.front[rows], found.tip[rows], found.plane[rows]
            extension = extended(geometry, model.cut, self._fronts, front, tip, plane, length)
            names = ", ".join(self._fronts.name[one] for one in front)
            late = bool((found.share[rows] > 1).any())
            return Event(extension, f"cohesive zones grew at {names}", exact=late)
        line = (
            None
            if self._nuclei is None
            else self._nuclei.begun(model, view.state.deformation, length)
        )
        if line is None:
            return None
        x, y = line[0] + self._setup.origin
        return Event(with_nucleus(geometry, line), f"a cohesive zone began at [{x:.6g}, {y:.6g}]")

    def follow(self, change: "Change") -> "CohesiveZones":
        """Return the effect on the new geometry, with the growth of its fronts."""
        new = CohesiveZones(change.setup, self._grown)
        new._grown = self._grown | {
            name: self._grown.get(name, 0.0) + float(np.hypot(*(there - here)))
            for name, there, here in self._moved(new)
        }
        return new

    def _moved(self, new: "CohesiveZones") -> list[tuple[str, Floats, Floats]]:
        """Name, new and old place of every front; those of new nuclei are the same."""
        were = dict(
            zip(self._fronts.name, self._fronts.points(self._setup.geometry.cracks), strict=True)
        )
        now = new._fronts.points(new._setup.geometry.cracks)
        return [
            (name, there, were.get(name, there))
            for name, there in zip(new._fronts.name, now, strict=True)
        ]

    def history(self, state: State) -> Mapping[str, float]:
        """Return place and growth of every front (m), and the whole growth (m)."""
        cracks, origin = self._setup.geometry.cracks, self._setup.origin
        total = {"growth": float(sum(self._grown.values()))}
        return total | self._fronts.history(cracks, origin, self._lengths)

    def carried(self) -> Mapping[str, float]:
        """Growth of each front (m)."""
        return self._grown

    def carry(self, carried: Mapping[str, float]) -> None:
        self._grown = dict(carried)
