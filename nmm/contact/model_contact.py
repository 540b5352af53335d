"""Contact of one model: who may touch, what solves it, and what the last accepted step left.

`nmm.contact.candidates` finds the contact points of a step and `nmm.contact.solution` their forces;
here both are handed what the last accepted step left.
"""

from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from covers.change.parentage import Parentage
from integration.arrays import Bools, Floats, Ints
from integration.sparse import csr_array
from nmm.assembly.model import Model
from nmm.assembly.state import State
from nmm.contact.detection.tolerances import FIRST_REACH
from nmm.contact.parts import ContactParts
from nmm.contact.points.contact_points import ContactPoints, concatenate
from nmm.contact.points.followed_joints import follow_joints
from nmm.contact.solution.record import (
    BrokenBonds,
    ContactCarried,
    ContactRecord,
    ContactSolution,
    correcting,
)
from nmm.contact.solution.step_bonds import StepBonds
from nmm.contact.workings import ContactWorkings

if TYPE_CHECKING:
    from nmm.assembly.tractions.held_edges import HeldEdge
    from nmm.contact.candidates.held_back import Crossed
    from nmm.contact.detection.contacts import Contacts
    from nmm.contact.detection.crossing import Motion
    from nmm.contact.laws.laid_under_stress import StressIn
    from nmm.contact.problem.step_problem import Limits


class ModelContact(ContactWorkings):
    """All contacts of a model.

    The step loop asks for `candidates` once a step, solves them by `steps` as often as it needs,
    and hands the accepted ones back to `commit`.

    Attributes
    ----------
    record
        What the last accepted step left.
    stored_first
        Energy (J) of contacts that carry something at the start (`lie_under`, `stands`).
    """

    stored_first: float = 0.0
    _laid: ContactPoints | None = None

    def __init__(self, model: Model, parts: ContactParts, start: State) -> None:
        laws, partners = parts.laws, parts.partners
        surface = partners.sides.surface(start.frames, start.deformation)
        given = laws, parts.joint_rule, parts.cracks
        book = follow_joints(surface, model, partners.interfaces, *given)
        seamless = parts.mixed & parts.cracks.points(model.manifold, book.points)
        acted = None if parts.acted_on is None else parts.acted_on(book.points)
        bonds, points = StepBonds.of(model, book.points, laws, seamless, acted)
        laws.refuse_soft(points.take(~points.tied))
        super().__init__(model, parts, bonds, points)
        book = replace(book, points=points)
        if parts.joint_rule[0] == "gauss" and partners.at_corners:
            beyond = np.isin(book.pair_joint, book.joint[points.tied])
            book = replace(book, pair_beyond=beyond)
        self.record, self._unbonded = ContactRecord(book), book.broken
        self._sought: tuple[Contacts | None, Crossed | None] = None, None

    def go_on(self, old: "ModelContact", kin: Parentage, state: State) -> None:
        """Go on from the contact of an earlier model: joints and contacts continue."""
        from nmm.contact.candidates.succession import succeeding

        laws = None if self.exact else (old.laws, self.laws)
        given = self._candidates, kin, state, self._parts.cracks, laws
        self.record = succeeding(old.record, self.record, *given)
        self._unbonded = self.record.book.broken - old.broken_bonds

    def lie_under(self, stress: "StressIn", state: State) -> None:
        """Let springs of joints and of bodies that touch carry a stress of the ground at first."""
        from nmm.contact.laws.laid_under_stress import found_under_stress, laid_under_stress

        book = laid_under_stress(self.record.book, self.model, self.laws, stress)
        self.record = replace(self.record, book=book)
        size = self.model.manifold.elements.extent
        found, points = self._candidates.sought(self.record, state, FIRST_REACH * size)
        points = points.take(~points.is_joint)
        if len(points):
            given = self.model, self.laws, stress, self.exact
            points = found_under_stress(points, self.partners.surface(state), *given)
            self.record = replace(self.record, found=found, known=points)
        self._laid = self.standing
        self.stored_first = self.laws.energy(self._laid, own_only=self.exact)

    def stands(self, state: State) -> None:
        """Take the contacts as they are for those that act at the start of statics."""
        self._laid, self.stored_first = self.standing, self.energy(state)

    def first_work(self, before: State, after: State) -> float:
        """See `Effect.first_work`: half of what forces take that contacts carried at the start."""
        if self._laid is None:
            return 0.0
        from nmm.contact.laws.laid_under_stress import taken_on_way

        surfaces = self.partners.surface(before), self.partners.surface(after)
        return taken_on_way(self._laid, *surfaces) / 2

    def candidates(
        self,
        state: State,
        reach: float,
        step: float | None = None,
        crossed: "Crossed | None" = None,
        broken: BrokenBonds | None = None,
    ) -> ContactPoints:
        """Return the contact points of a step; see `Candidates.sought`.

        ``broken`` are bonds that broke in the same step: ends of their joints may bear.
        """
        record = self.record if broken is None else broken.before(self.record)
        found, points = self._candidates.sought(record, state, reach, step, crossed)
        self._sought = found, crossed
        return points

    def uncovers(self, before: BrokenBonds | None, broken: BrokenBonds) -> bool:
        """Whether more ends of joints bear once bonds are ``broken`` than did ``before``."""
        book = self.record.book
        sought = book if before is None else book.opened_at(before.opened)
        return bool((book.opened_at(broken.opened).pair_bears & ~sought.pair_bears).any())

    def release(self, solved: ContactSolution, gone: Bools) -> float:
        """Let bonds (m,) give way before the next step, though the solution be no step.

        Return by how much they hold less energy from then on (J), but for those that broke.
        """
        from nmm.contact.following.release import let_go

        self.record, shed = let_go(self.record, self.laws, solved, gone)
        return shed

    def overlooked(self, contacts: ContactPoints, motion: "Motion") -> tuple[Ints, Ints] | None:
        """Return pairs that crossed and were no contacts; see `Candidates.overlooked`."""
        return self._candidates.overlooked(self.record, contacts, motion)

    def commit(self, solved: ContactSolution, state: State) -> ContactPoints:
        """Keep the accepted contacts as the start of the next step, and return them."""
        self.record, done = self._candidates.accepted(self.record, self._sought, solved, state)
        return done

    def correct(self, solved: ContactSolution, start: State) -> None:
        """Let the next solution correct the step from ``start``, of which one was committed."""
        self.record = correcting(self.record, solved, self.partners.surface(start))

    def restore(self, record: ContactRecord) -> None:
        """Go back to an earlier step, and start from there alone.

        Friction has many answers, and what a step that failed has slid is near wrong ones.
        """
        self.record = record
        self.solver.memory.forget_answers()

    def carried(self) -> ContactCarried:
        """All that contact carries from accepted step to accepted step."""
        width = self.solver.memory.barrier_width
        return ContactCarried(self.record, width, self._unbonded)

    def carry(self, carried: ContactCarried) -> None:
        """Take back what was `carried`."""
        self.record, self._unbonded = carried.record, carried.unbonded
        self.solver.memory.barrier_width = carried.barrier_width

    def forget(self) -> None:
        """Drop what is kept for speed alone."""
        self.solver.forget()
        self.partners.forget()
        self._sought = None, None

    def push(self, state: State) -> Floats:
        """Return the force (n,) of the contacts as they were left."""
        points = self.standing
        rows = self.geometry.rows(points, state)
        return rows.push(points.normal_force, points.shear_force)

    @property
    def standing(self) -> ContactPoints:
        """The contact points that are known between two steps."""
        book, known = self.record.book, self.record.known
        return concatenate([book.points, *([] if known is None else [known]), book.lost])

    @property
    def broken_bonds(self) -> int:
        """Number of joint points whose bond is broken."""
        return self.record.book.broken - self._unbonded

    def near(self, state: State, reach: float) -> "tuple[tuple[csr_array, csr_array], Limits]":
        """Return rows and strength of contacts that bonds hold or that are open by ``reach``."""
        return self._candidates.near(self.record, state, reach)

    def held(self, state: State) -> "HeldEdge | None":
        """Return the whole bonds that consistent terms hold as an edge; None without any."""
        if self.bonds.terms is None:
            return None
        now = self._candidates.joints(self.record.book, state)
        return self.bonds.held(now, state, partial(self.geometry.rows, now, state))

    def energy(self, state: State) -> float:
        """Energy of contacts as last committed (J); see `ContactSteps.energy`."""
        record = self.record
        joints = partial(self._candidates.joints, record.book, state)
        return self.steps.energy(record, state, joints, self.exact)
