"""Bonds held by consistent terms (Nitsche's), as the steps of a run use them."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Bools, Floats
from integration.sparse import csr_array
from nmm.assembly.model import Model
from nmm.assembly.state import State
from nmm.assembly.stress_points import StressAt
from nmm.assembly.tractions.held_edges import HeldEdge
from nmm.contact.bonds.consistent_bonds import ConsistentBonds
from nmm.contact.laws.contact_laws import ContactLaws
from nmm.contact.laws.failing_bonds import overload
from nmm.contact.points.contact_points import ContactPoints

if TYPE_CHECKING:
    from nmm.contact.bonds.tied_step import TiedBonds
    from nmm.contact.points.contact_rows import ContactRows
    from nmm.contact.problem.step_problem import StepAnswer
    from nmm.contact.solution.mixed_bonds import MixedBonds
    from nmm.contact.solution.request import StepRequest


@dataclass
class StepBonds:
    """Whole bonds of a scene, and those whose law has the mixed form.

    Attributes
    ----------
    laws
        Of all contacts.
    terms
        Of all bonds; None where all of them are held by springs.
    stresses
        Stresses that effects add in the bodies on both sides.
    """

    laws: ContactLaws
    terms: ConsistentBonds | None
    stresses: Sequence[StressAt] = ()

    @classmethod
    def of(
        cls,
        model: Model,
        joints: ContactPoints,
        laws: ContactLaws,
        seamless: Bools,
        acted: tuple[Bools, Bools] | None = None,
    ) -> tuple["StepBonds", ContactPoints]:
        """Find them among joints (m,), see `ConsistentBonds.of`; return the joints as held."""
        terms = ConsistentBonds.of(model, joints, laws, seamless, acted)
        return cls(laws, terms), joints if terms is None else terms.tied(joints, laws)

    def tied(
        self,
        contacts: ContactPoints,
        state: State,
        rows: "ContactRows",
        weight: float = 1.0,
        time: float | None = None,
    ) -> "TiedBonds | None":
        """Return the whole bonds of a step, see `TiedBonds.of`; None without any."""
        if self.terms is None or not contacts.tied.any():
            return None
        from nmm.contact.bonds.tied_step import TiedBonds

        return TiedBonds.of(self.terms, contacts, state, rows, weight, self.stresses, time)

    def held(
        self, joints: ContactPoints, state: State, rows: "Callable[[], ContactRows]"
    ) -> HeldEdge | None:
        """Return the whole bonds among joints as an edge; None without any.

        ``rows`` are those of all joints, made when the edge is asked for its own.
        """
        index = np.flatnonzero(joints.tied)
        if self.terms is None or not len(index):
            return None

        def moves() -> tuple[csr_array, csr_array]:
            found = rows()
            return found.normal[index], found.tangent[index]

        return self.terms.held(joints.take(index), state.frames, moves)

    def mixed(
        self, contacts: ContactPoints, state: State, time: float | None = None
    ) -> "MixedBonds | None":
        """Return the bonds whose law has the mixed form, see `MixedBonds.of`; None without any."""
        if self.terms is None:
            return None
        from nmm.contact.solution.mixed_bonds import MixedBonds

        return MixedBonds.of(self.terms, self.laws, contacts, state, self.stresses, time)

    def posed(
        self, contacts: ContactPoints, rows: "ContactRows", request: "StepRequest", state: State
    ) -> "tuple[MixedBonds | None, tuple[ContactPoints, ContactRows, StepRequest]]":
        """Return the bonds of the mixed form, and the problem of a step with their springs."""
        mixed, given = self.mixed(contacts, state, request.time), (contacts, rows, request)
        return mixed, given if mixed is None else mixed.posed(*given)

    def unsoftened(self, contacts: ContactPoints, joints: ContactPoints) -> Bools | None:
        """Return which contacts (m,) are bonds of the mixed form, as long as none has softened.

        ``joints`` are all joint points at present. None without such bonds, or once one has.
        """
        if self.terms is None or not (mixed := self.terms.mixed_among(joints)).any():
            return None
        begun = mixed & ((joints.history["damage"] > 0) | ~joints.bonded)
        return None if begun.any() else self.terms.mixed_among(contacts)

    def overload(
        self, contacts: ContactPoints, answer: "StepAnswer | ContactPoints", joints: ContactPoints
    ) -> Floats:
        """Return load over strength (m,) of bonds that break or begin to soften above one.

        Those of the mixed form count until the first of all ``joints`` has softened.
        """
        return overload(self.laws, contacts, answer, self.unsoftened(contacts, joints))

    def may_give_way(self, points: ContactPoints, joints: ContactPoints) -> bool:
        """Return whether any bond is left that breaks at once, or begins to soften, at a limit."""
        brittle = points.bonded & self.laws.brittle[points.interface]
        anywhere = (points.tied | brittle).any()
        return bool(anywhere or self.unsoftened(points, joints) is not None)
