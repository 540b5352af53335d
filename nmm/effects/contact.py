"""The effect of contact: an adapter from scenes to `nmm.contact.model_contact`.

What a scene and its formulation declare is read in `contact_parts`.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Self

from nmm.assembly.applied_forces import AppliedForces
from nmm.assembly.state import State
from nmm.assembly.stress_points import StressAt
from nmm.assembly.tractions.held_edges import HeldEdge
from nmm.contact.model_contact import ModelContact
from nmm.effects.acted.acted_bonds import loaded_twice
from nmm.effects.base import Effect, Instant, Setup
from nmm.effects.contact_parts import contact_parts, stress_of_ground

if TYPE_CHECKING:
    from nmm.contact.laws.laid_under_stress import StressIn
    from nmm.effects.change import Change


class Contact(ModelContact, Effect):
    """All contacts of a scene as an effect: friction, bonds and separation of bodies."""

    name = "contact"
    external = False
    _ground: "StressIn | None" = None
    _loaded_twice: str = ""

    @classmethod
    def beyond_strain(cls) -> bool:
        """See `Effect.beyond_strain`: faces press on each other."""
        return True

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        found = cls(setup.model, contact_parts(setup), setup.start)
        found._ground = stress_of_ground(setup)
        if found.bonds.terms is not None:
            found._loaded_twice = loaded_twice(setup, found.record.book.points)
        return found

    def begin(self, state: State) -> State:
        """See `Effect.begin`: contacts carry the initial stress of the ground."""
        if self._ground is not None:
            self.lie_under(self._ground, state)
        return state

    @property
    def caution(self) -> str:
        """See `Effect.caution`: loads on both faces of bonds, bodies softer than their dampers."""
        told = [self._loaded_twice]
        if self.laws.damps:
            from nmm.contact.laws.dashpots import yielding_bodies

            told.append(yielding_bodies(self.laws, self.model))
        return "; ".join(filter(None, told))

    def follow(self, change: "Change") -> "Contact":
        """Return the contact of the new model, with the state of joints and contacts."""
        new = type(self).from_setup(change.setup)
        new.go_on(self, change.parentage, change.state)
        return new

    def applied_forces(self, state: State) -> AppliedForces:
        """See `Effect.applied_forces`: those on crack faces in the accepted state."""
        from nmm.contact.points.cracks.on_faces import on_faces

        return on_faces(self.model, self.standing)

    def held_edges(self, state: State, end: Instant) -> list[HeldEdge]:
        """See `Effect.held_edges`: those of intact bonds."""
        found = self.held(state)
        return [] if found is None else [found]

    def work(self, before: State, after: State) -> float:
        """See `Effect.work`: of stresses as they change at intact bonds, on their mean jump (J)."""
        if not self.bonds.stresses:
            return 0.0
        found = (self.held(state) for state in (before, after))
        edges, stresses = [one for one in found if one is not None], self.bonds.stresses
        rise = (one.felt(stresses, after.time) - one.felt(stresses, before.time) for one in edges)
        return -sum(rise) / 2

    def receive_stresses(self, stresses: Sequence[StressAt]) -> None:
        """See `Effect.receive_stresses`: the tractions of intact bonds are of the total stress."""
        self.bonds.stresses = stresses
