"""Contact: bodies touch, rub, hold together by bonds, and part.

An adapter: what contact is made of a scene and its formulation say (`contact_parts`), and what it
does is in `nmm.contact.model_contact`.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Self

from nmm.assembly.applied_forces import AppliedForces
from nmm.assembly.motion import State
from nmm.assembly.stress_points import StressAt
from nmm.contact.model_contact import ModelContact
from nmm.effects.base import Effect, Setup
from nmm.effects.contact_parts import contact_parts, stress_of_ground

if TYPE_CHECKING:
    from nmm.contact.laws.laid_under_stress import StressIn
    from nmm.effects.change import Change


class Contact(ModelContact, Effect):
    """All contacts of a scene, an effect: energy, and what is carried, are those of the model's."""

    name = "contact"
    external = False
    _ground: "StressIn | None" = None

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """See `Effect.from_setup`."""
        found = cls(setup.model, contact_parts(setup), setup.start)
        found._ground = stress_of_ground(setup)
        return found

    def begin(self, state: State) -> State:
        """See `Effect.begin`: contacts carry the stress of the ground as they are drawn."""
        if self._ground is not None:
            self.lie_under(self._ground, state)
        return state

    @property
    def caution(self) -> str:
        """See `Effect.caution`: dampers that bodies give way in place of."""
        if not self.laws.damps:
            return ""
        from nmm.contact.laws.yielding_bodies import yielding_bodies

        return yielding_bodies(self.laws, self.model)

    def follow(self, change: "Change") -> "Contact":
        """Return the contact of the new model: joints and contacts go on."""
        new = type(self).from_setup(change.setup)
        new.go_on(self, change.parentage, change.state)
        return new

    def applied_forces(self, state: State) -> AppliedForces:
        """See `Effect.applied_forces`: those on faces of cracks, as last committed."""
        from nmm.contact.points.on_faces import on_faces

        return on_faces(self.model, self.standing)

    def receive_stresses(self, stresses: Sequence[StressAt]) -> None:
        """See `Effect.receive_stresses`: the tractions of whole bonds are of the whole stress."""
        self.bonds.stresses = stresses
