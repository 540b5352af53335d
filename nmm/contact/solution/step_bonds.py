"""Bonds that consistent terms hold, as the steps of a run ask for them."""

from collections.abc import Sequence
from dataclasses import dataclass

from integration.arrays import Bools
from nmm.assembly.model import Model
from nmm.assembly.motion import State
from nmm.assembly.stress_points import StressAt
from nmm.contact.bonds.consistent_bonds import ConsistentBonds
from nmm.contact.bonds.tied_step import TiedBonds
from nmm.contact.laws.contact_laws import ContactLaws
from nmm.contact.points.contact_points import ContactPoints
from nmm.contact.points.contact_rows import ContactRows
from nmm.contact.solution.mixed_bonds import MixedBonds


@dataclass
class StepBonds:
    """Whole bonds of a scene, and those whose law has the mixed form.

    Attributes
    ----------
    laws
        Of all contacts.
    terms
        Of all bonds; None where springs hold each of them.
    stresses
        That effects add to the matter of both sides.
    """

    laws: ContactLaws
    terms: ConsistentBonds | None
    stresses: Sequence[StressAt] = ()

    @classmethod
    def of(
        cls, model: Model, joints: ContactPoints, laws: ContactLaws, seamless: Bools
    ) -> tuple["StepBonds", ContactPoints]:
        """Find them among joints (m,), see `ConsistentBonds.of`; return the joints as held."""
        terms = ConsistentBonds.of(model, joints, laws, seamless)
        return cls(laws, terms), joints if terms is None else terms.tied(joints, laws)

    def tied(
        self,
        contacts: ContactPoints,
        state: State,
        rows: ContactRows,
        weight: float = 1.0,
        time: float | None = None,
    ) -> TiedBonds | None:
        """Return the whole bonds of a step, see `TiedBonds.of`; None without any."""
        if self.terms is None or not contacts.tied.any():
            return None
        return TiedBonds.of(self.terms, contacts, state, rows, weight, self.stresses, time)

    def mixed(
        self, contacts: ContactPoints, state: State, time: float | None = None
    ) -> MixedBonds | None:
        """Return the bonds whose law has the mixed form, see `MixedBonds.of`; None without any."""
        if self.terms is None:
            return None
        return MixedBonds.of(self.terms, self.laws, contacts, state, self.stresses, time)

    def unsoftened(self, contacts: ContactPoints, joints: ContactPoints) -> Bools | None:
        """Return which contacts (m,) are bonds of the mixed form while none has softened.

        ``joints`` are all of the scene as they stand. None without such bonds, or once one has.
        """
        if self.terms is None or not (mixed := self.terms.mixed_among(joints)).any():
            return None
        begun = mixed & ((joints.history["damage"] > 0) | ~joints.bonded)
        return None if begun.any() else self.terms.mixed_among(contacts)
