"""The contact points of a step: followed joints, and what the search finds as bodies move.

Joints (shared edges whose interface has strength or stiffness) are followed from the start.
"""

import numpy as np

from integration.arrays import Bools, Ints
from integration.contraction import largest
from integration.sparse import csr_array
from nmm.assembly.state import State
from nmm.contact.candidates.held_back import Crossed, held_back, joined, pushing
from nmm.contact.candidates.partners import Partners
from nmm.contact.detection.contacts import Contacts, follow
from nmm.contact.detection.crossing import Motion, crossings_in, over_seams
from nmm.contact.detection.surface import pair_key
from nmm.contact.detection.tolerances import FLUSH
from nmm.contact.laws.contact_laws import ContactLaws
from nmm.contact.laws.failing_bonds import strength
from nmm.contact.laws.found_contacts import sized
from nmm.contact.points.contact_points import ContactPoints, concatenate
from nmm.contact.points.continued.kept_energy import kept_energy
from nmm.contact.points.continued.lasting_springs import as_stretched, pushing_on
from nmm.contact.points.continued.predecessors import Predecessors
from nmm.contact.points.continued.reference_gap import counted, counted_on
from nmm.contact.points.continued.sliding_on import slid_since
from nmm.contact.points.continued.tracking import (
    answered,
    continued,
    continues,
    remember,
    searched_points,
)
from nmm.contact.points.joint_book import JointBook
from nmm.contact.problem.step_problem import Limits
from nmm.contact.solution.geometry import ContactGeometry
from nmm.contact.solution.record import ContactRecord, ContactSolution
from nmm.frozen import with_parts


class Candidates:
    """Contact points from what the last accepted step left, a `ContactRecord`; it keeps none.

    Parameters
    ----------
    partners
        The search over steps.
    laws, geometry
        Of the points that are found.
    keeps_energy
        Whether contacts go on where search would leave them out while their springs push.
    ahead
        Whether contacts push before their sides touch.
    """

    def __init__(
        self,
        partners: Partners,
        laws: ContactLaws,
        geometry: ContactGeometry,
        keeps_energy: bool = False,
        ahead: bool = False,
    ) -> None:
        self.partners, self._laws, self._geometry = partners, laws, geometry
        self._keeps_energy, self._ahead = keeps_energy, ahead

    def sought(
        self,
        record: ContactRecord,
        state: State,
        reach: float,
        step: float | None = None,
        crossed: tuple[Ints, Ints] | None = None,
    ) -> tuple[Contacts, ContactPoints]:
        """Return what search finds, and the contact points it makes with joints.

        No point moves further than ``reach`` (m) in the step. ``step`` is its length (s), None in
        statics: bodies in flight meet where they fly to. ``crossed`` are pairs of a vertex and an
        edge that are contacts in any case (`overlooked`). In time so are those held back before;
        in statics friction that they had would choose another of its many states.
        """
        joints = self.joints(record.book, state)
        if step is not None:
            crossed = joined(record.crossed, crossed)
        known = record.known
        # Springs that a stress had closed push while their sides stand apart by the reference.
        apart = 0.0 if known is None else float(largest(known.reference, initial=0.0))
        within = 2 * reach + apart
        found = self.partners.search(state, within, step, record.book, record.found, crossed)
        if record.known is not None and not self._laws.stiff and continues(record.found, found):
            points = continued(record.known, found)
            points = counted_on(self._geometry.measured(points, state), self._ahead)
        else:
            found, points = self._anew(record, state, found, step is not None)
        if record.began is not None:
            points = slid_since(points, record.began, self.partners.surface(state))
        return found, concatenate([joints, points])

    def _anew(
        self, record: ContactRecord, state: State, found: Contacts, in_time: bool
    ) -> tuple[Contacts, ContactPoints]:
        """Return the admissible ones of the found contacts, and their points."""
        surface = self.partners.surface(state)
        found, interface = self.partners.meeting(
            surface, found, record.book, first=record.found is None
        )
        unbonded = np.zeros(len(found), dtype=bool)
        new = searched_points(found, interface, self._laws.initial(interface, unbonded), surface)
        if self._laws.stiff:
            new = sized(self._laws, new, surface)
        none = np.zeros(0, dtype=np.int64)
        number, old = np.full(len(new), -1, dtype=np.int64), new.take(none)
        if record.found is not None and record.known is not None:
            number, old = follow(record.found, found), record.known
        before = Predecessors(old, number, self._lasting(new, in_time))
        if in_time and old.gap.size:
            new, before = pushing_on(new, before, surface)
        new = self._geometry.measured(new, state)
        return found, self._followed(record, new, before, in_time)

    def _lasting(self, points: ContactPoints, in_time: bool) -> Bools:
        """Which springs (m,) keep their stiffness while they push: in time that conserves energy.

        Segments of faces with a stiffness by area follow their area.
        """
        by_area = self._laws.has_stiffness[points.interface] & (points.length > 0)
        return np.asarray(in_time & ~by_area)

    def joints(self, book: JointBook, state: State) -> ContactPoints:
        """Return the contact points of joints as they stand."""
        return book.now(self._geometry.faces(state, self.partners.surface(state)))

    def near(
        self, record: ContactRecord, state: State, reach: float
    ) -> tuple[tuple[csr_array, csr_array], Limits]:
        """Return rows and strength of contacts that bonds hold or that are open by ``reach``.

        They are more than a step finds, in kinks of two bodies and at ends of joints whose bonds
        hold: whatever may carry, once bonds gave way too, is among them.
        """
        record = with_parts(record, book=record.book.opened)
        kinks = self.partners.in_kinks(state, reach, record.book)
        _, contacts = self.sought(record, state, reach, crossed=kinks)
        contacts = contacts.take(contacts.bonded | (contacts.gap <= reach))
        through = self._geometry.rows(contacts, state)
        return (through.normal, through.tangent), strength(self._laws, contacts)

    def overlooked(
        self, record: ContactRecord, contacts: ContactPoints, motion: Motion
    ) -> tuple[Ints, Ints] | None:
        """Return vertex and edge of crossings of pairs that were no contacts; None without any.

        Which edge a corner meets first is judged by where bodies seem to go; contacts on the way
        may send them elsewhere.
        """
        if motion.harmless or not len(found := crossings_in(motion, FLUSH)):
            return None
        surface, book = motion.before, record.book
        known = contacts.take(~contacts.is_joint)
        new = ~np.isin(
            pair_key(surface, found.vertex, found.edge),
            np.concatenate([pair_key(surface, known.edge_a, known.edge_b), book.pairs]),
        )
        new &= self.partners.interfaces(found.vertex, found.edge) >= 0
        new &= ~book.holds(surface, found.vertex, found.edge)
        new &= ~over_seams(found, motion, (known.edge_a, known.edge_b))
        return (found.vertex[new], found.edge[new]) if new.any() else None

    def accepted(
        self,
        record: ContactRecord,
        sought: tuple[Contacts | None, Crossed | None],
        solved: ContactSolution,
        state: State,
    ) -> tuple[ContactRecord, ContactPoints]:
        """Return the record after an accepted step, and its contacts with joints given up before.

        ``sought`` is what search found for the step, and the pairs that crossed in it at first.
        """
        found, crossed = sought
        bonded = self._laws.bonded[solved.contacts.interface]
        done = answered(solved.contacts, solved.answer, bonded)
        book, known = record.book, done
        if len(book.points) or len(book.lost):
            surface, joints = self.partners.surface(state), done.is_joint
            book = book.keep(done.take(joints), self._geometry.faces(state, surface))
            known = done.take(~joints)
        crossed = pushing(solved) if self._keeps_energy else joined(record.crossed, crossed)
        if crossed is not None:
            crossed = held_back(crossed, solved, self.partners.surface(state))
        after = ContactRecord(book, found, known, solved.answer.stored, crossed)
        return after, concatenate([done, book.lost])

    def _followed(
        self, record: ContactRecord, new: ContactPoints, before: Predecessors, in_time: bool
    ) -> ContactPoints:
        """Return points with the state of their predecessors, and gaps from their references."""
        old, left = before.old, record.book.left
        stiffness, body = self._laws.normal_stiffness, self._geometry.model.manifold.boundary.body
        new = counted(remember(new, before), before, stiffness, body, left, self._ahead)
        if old.gap.size:
            new = as_stretched(new, before)
        if record.known is None:
            return new
        if self._keeps_energy:
            new = kept_energy(new, old, stiffness, body)
        if in_time and self._laws.stiff:
            new = kept_energy(new, concatenate([left, old]), stiffness, body, at_most=True)
        return new
