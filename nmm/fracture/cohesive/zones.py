"""The effect of ``[cohesive_zones]``: bonded faces are laid where the stress calls for them.

Ahead of a tip the mean stress says when and which way. What is laid is whole at first and changes
no stress; its own law lets it open, where the traction on it reaches the strength. So it matters
little when a piece is laid, as long as that is before it would open.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar, Self

import numpy as np

from integration.arrays import Bools, Floats, Ints
from nmm.assembly.motion import State
from nmm.effects.base import Effect, Setup
from nmm.effects.event import Event
from nmm.errors import Fault, FormulationError, SceneError
from nmm.fracture.cohesive.mean_stress import StressMeans
from nmm.fracture.cohesive.nucleus import ZoneNuclei
from nmm.fracture.cohesive.pieces import extended, with_nucleus
from nmm.fracture.cohesive.strength import element_strength
from nmm.fracture.cohesive.zone_fronts import zone_fronts
from nmm.fracture.growth.fronts import may_grow
from nmm.fracture.principal import LargestPrincipal

if TYPE_CHECKING:
    from nmm.contact.points.contact_points import ContactPoints
    from nmm.effects.change import Change
    from nmm.effects.view import View

# Cells by which a zone goes on beyond where it opens: a crack without functions of its tip acts as
# if it ended up to a cell and a half before it.
LAG = 2.5


@dataclass(frozen=True)
class ZoneCalls:
    """What the tips of zones have in a state.

    Attributes
    ----------
    front, tip
        (k,) fronts with a tip, and their tips in the cut.
    share
        (k,) mean principal stress ahead over the strength.
    plane
        (k, 2) directions of the planes in which they would go on.
    """

    front: Ints
    tip: Ints
    share: Floats
    plane: Floats


def given_way(contacts: "ContactPoints") -> Bools:
    """Which joint points (m,) are bonds no more, or soften."""
    lost = contacts.is_joint & ~contacts.bonded
    damage = contacts.history.get("damage")
    return np.asarray(lost if damage is None else lost | (contacts.is_joint & (damage > 0)))


class CohesiveZones(Effect):
    """Cohesive zones that grow from tips and nuclei; what they take is booked by contact."""

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
            Nothing that could grow, or no strength.
        FormulationError
            A cover that cracks cannot cut, or matter that is not linear.
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
        """See `Effect.about`."""
        return f"pieces of {self._table.increment:g} m, stress averaged over {self._length:g} m"

    @property
    def caution(self) -> str:
        """See `Effect.caution`: the way of a zone follows a net that is coarser than its means."""
        size = self._setup.formulation.cover.finest
        if size is None or size <= self._length:
            return ""
        return (
            f"stress is averaged over {self._length:g} m on cells of {size:g} m: ways of zones "
            "turn with the net, by up to 4 degrees; take cells no larger than that length"
        )

    def _ahead(self) -> StressMeans:
        """Means of stress ahead of the tips."""
        tips, model = self._setup.model.cut.tips, self._setup.model
        tip = self._tips[self._tips >= 0]
        body = model.manifold.element_body[tips.element[tip]]
        return StressMeans.about(model, tips.point[tip], body, self._length, tips.direction[tip])

    def _places(self) -> ZoneNuclei:
        return ZoneNuclei.of(self._setup.model, self._setup.geometry, self._strength, self._length)

    def calls(self, state: State) -> ZoneCalls:
        """Return what the tips have in a state."""
        front = np.flatnonzero(self._tips >= 0)
        tip = self._tips[front]
        pulled = LargestPrincipal.of(self._means.of(state.deformation))
        strength = self._strength[self._setup.model.cut.tips.element[tip]]
        share, ahead = pulled.size / strength, self._setup.model.cut.tips.direction[tip]
        # Where stress is low its direction says nothing: a zone goes straight on.
        strong = share >= self._table.ahead
        return ZoneCalls(front, tip, share, np.where(strong[:, None], pulled.plane, ahead))

    def _short(self, found: ZoneCalls, contacts: "ContactPoints | None") -> Bools:
        """Whether zones (k,) end too near to where they began, or to bonds that give way.

        Faces act only where they part all covers that they run through, and must be whole there
        when the strength comes.
        """
        geometry, tips = self._setup.geometry, self._setup.model.cut.tips.point[found.tip]
        crack = self._fronts.crack[found.front]
        zone = np.isin(crack, geometry.bonded)
        begun = np.array([geometry.cracks[one][0] for one in crack]).reshape(-1, 2)
        fresh = (crack >= len(self._setup.scene.cracks)) & zone
        short = fresh & (np.hypot(*(tips - begun).T) < self._lag)
        if contacts is None or not len(contacts):
            return np.asarray(short)
        given = contacts.take(given_way(contacts))
        place = self._setup.model.manifold.boundary.at(given.edge_a, given.parameter_a)
        away = np.hypot(*np.moveaxis(tips[:, None] - place, -1, 0))
        return np.asarray(short | (zone & (away < self._lag).any(axis=1)))

    def _free(self, front: Ints) -> Bools:
        """Which fronts (k,) have not grown as far as they may."""
        most = np.inf if self._table.max_growth is None else self._table.max_growth
        return may_grow(self._lengths[front], most)

    @property
    def _lengths(self) -> Floats:
        """How far each front has grown (n,) (m)."""
        return np.array([self._grown.get(name, 0.0) for name in self._fronts.name])

    def event(self, view: "View") -> Event | None:
        """Ask for new pieces where the stress calls for them, else for a nucleus."""
        found = self.calls(view.state)
        called = (found.share >= self._table.ahead) | self._short(found, view.contacts)
        rows = np.flatnonzero(self._free(found.front) & called)
        geometry, model = self._setup.geometry, self._setup.model
        length = self._table.increment
        if len(rows):
            front, tip, plane = found.front[rows], found.tip[rows], found.plane[rows]
            laid = extended(geometry, model.cut, self._fronts, front, tip, plane, length)
            names = ", ".join(self._fronts.name[one] for one in front)
            late = bool((found.share[rows] > 1).any())
            return Event(laid, f"cohesive zones grew at {names}", exact=late)
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
        """Return the effect on the new geometry, with what its fronts have gained."""
        new = CohesiveZones(change.setup, self._grown)
        new._grown = self._grown | {
            name: self._grown.get(name, 0.0) + float(np.hypot(*(there - here)))
            for name, there, here in self._moved(new)
        }
        return new

    def _moved(self, new: "CohesiveZones") -> list[tuple[str, Floats, Floats]]:
        """Fronts by name, where they are and where they were; new nuclei have not moved."""
        were = dict(
            zip(self._fronts.name, self._fronts.points(self._setup.geometry.cracks), strict=True)
        )
        now = new._fronts.points(new._setup.geometry.cracks)
        return [
            (name, there, were.get(name, there))
            for name, there in zip(new._fronts.name, now, strict=True)
        ]

    def history(self, state: State) -> Mapping[str, float]:
        """Place and growth of every front (m)."""
        cracks, origin = self._setup.geometry.cracks, self._setup.origin
        total = {"growth": float(sum(self._grown.values()))}
        return total | self._fronts.history(cracks, origin, self._lengths)

    def carried(self) -> Mapping[str, float]:
        """How far each front has grown (m)."""
        return self._grown

    def carry(self, carried: Mapping[str, float]) -> None:
        """See `Effect.carry`."""
        self._grown = dict(carried)
