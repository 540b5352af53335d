"""Contact: bodies touch, rub, hold together by bonds, and part.

Joints (shared edges whose interface has strength or stiffness) are followed from the start; all
other contacts are found by search as bodies move. Both are contact points of one step problem,
which `nmm.contact.solution` solves. Which bodies meet, and by which law, stands in
`nmm.effects.contact_pairs`.
"""

from dataclasses import replace
from typing import TYPE_CHECKING, Self

import numpy as np
from scipy.sparse import csc_array, csr_array

from integration.arrays import Bools, Floats, Ints
from nmm.assembly.model import Model
from nmm.assembly.motion import State
from nmm.contact.detection.crossing import Motion, crossings_in, over_seams
from nmm.contact.detection.narrow_phase import Contacts, follow
from nmm.contact.detection.pair_keys import pair_key
from nmm.contact.detection.tolerances import FLUSH
from nmm.contact.enforcement.base import Enforcement, make_enforcement
from nmm.contact.iteration.record import ContactCarried, ContactRecord, ContactSolution
from nmm.contact.laws.compliance import Softness
from nmm.contact.laws.contact_laws import ContactLaws
from nmm.contact.laws.dashpots import RigidMass
from nmm.contact.mortar.segments import face_points
from nmm.contact.points.contact_points import ContactPoints, concatenate
from nmm.contact.points.inheritance import (
    continued,
    continued_joints,
    heirs,
    known_joints,
    placed,
)
from nmm.contact.points.joint_book import follow_joints
from nmm.contact.points.reference_gap import counted
from nmm.contact.points.tracking import answered, remember, searched_points
from nmm.contact.problem.step_problem import Limits
from nmm.contact.solution.driver import ContactSolver
from nmm.contact.solution.geometry import ContactGeometry
from nmm.contact.solution.request import StepRequest
from nmm.effects.base import Effect, Setup
from nmm.effects.contact_momentum import Momentum
from nmm.effects.contact_pairs import held_bodies, interface_law, pairs_of
from nmm.effects.contact_partners import Partners
from nmm.errors import SolveError
from nmm.solvers.linear import LinearSolver

if TYPE_CHECKING:
    from nmm.effects.change import Change

# How far open contacts are that a change of the model continues, in sizes of the domain.
HELD = 1e-6


class Contact(Effect):
    """All contacts of a scene.

    The step loop asks for `candidates` once a step, solves them by `solve` as often as it needs,
    and hands the accepted ones back to `commit`.
    """

    name = "contact"
    external = False

    def __init__(
        self,
        model: Model,
        laws: ContactLaws,
        partners: Partners,
        enforcement: Enforcement,
        stations: str,
        start: State,
        held: Bools,
        bends: bool,
        means: bool = False,
    ) -> None:
        self._laws, self._partners, self._exact = laws, partners, enforcement.exact
        self._edge_body = model.manifold.boundary.body
        book = follow_joints(
            partners.surface(start),
            model,
            partners.interfaces,
            laws.makes_joints,
            laws.bonded,
            laws.initial,
            stations,
        )
        self.record, self._unbonded = ContactRecord(book), book.broken
        self.geometry = ContactGeometry(model, partners.sides, book.points, bends, means)
        self.momentum = Momentum(model, partners.sides, held, self.geometry.curved)
        manifold = model.manifold
        mass = RigidMass(self._edge_body, manifold.rigid_modes, self.momentum.compliance)
        unknown_body = np.repeat(manifold.cover_body, np.diff(manifold.cover_offset))
        self._solver = ContactSolver(laws, Softness.of(model), enforcement, mass, unknown_body)
        self._last: Contacts | None = None

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build from ``[contact]``, the interfaces and the formulation's ``[contact]``."""
        method, manifold = setup.formulation.contact, setup.model.manifold
        unit = float(setup.model.modulus.max()) * setup.model.thickness
        penalty, bond = method.normal_penalty * unit, method.bond_stiffness * unit
        laws = ContactLaws(
            laws=[interface_law(item) for item in setup.scene.interfaces.values()],
            thickness=setup.model.thickness,
            normal_penalty=penalty,
            shear_penalty=penalty * method.shear_ratio,
            normal_bond=bond,
            shear_bond=bond * method.shear_ratio,
        )
        given = {"max_passes": method.max_passes} if "max_passes" in method.model_fields_set else {}
        enforcement = make_enforcement(method.enforcement, dict(method.options), given)
        points = face_points(manifold, method.points)
        # Fields of blocks follow what single points ask for; a mean has no stiffness of its own.
        means = enforcement.multipliers and manifold.shared_covers and points > 0 and not laws.stiff
        partners = Partners(
            setup.model,
            pairs_of(setup),
            within_bodies=bool(setup.scene.cracks),
            face_points=points,
            origin=setup.origin,
            whole_faces=means,
        )
        bends, held = points > 2, held_bodies(setup)
        stations = method.joint_points
        return cls(
            setup.model, laws, partners, enforcement, stations, setup.start, held, bends, means
        )

    def follow(self, change: "Change") -> "Contact":
        """Return the contact of the new model: joints and contacts go on where the material does.

        Bonds between bodies of which one is new are free of stress as they are placed.
        """
        new, state = type(self).from_setup(change.setup), change.state
        old, record = change.old.manifold, self.record
        book = new.record.book
        line = heirs((change.new.manifold, book.points), (old, known_joints(record.book)))
        book, fresh = continued_joints(book, record.book, line)
        surface = new._partners.surface(state)
        now = book.now(surface, new.geometry.apart(state, surface))
        new.record = ContactRecord(placed(book, now, fresh))
        size = float(np.hypot(*np.ptp(change.new.manifold.elements.points, axis=0)))
        found, points = new._sought(state, HELD * size)
        points = points.take(~points.is_joint)
        if record.known is not None:
            normal, shear, _ = new._laws.springs(points)
            line = heirs((change.new.manifold, points), (old, record.known))
            springs = None if new._exact else (normal, shear)
            points = continued(points, record.known, line, springs)
        new.record = ContactRecord(new.record.book, found, points)
        return new

    def candidates(
        self,
        state: State,
        reach: float,
        step: float | None = None,
        crossed: tuple[Ints, Ints] | None = None,
    ) -> ContactPoints:
        """Return the contact points of a step in which no point moves further than ``reach``.

        ``step`` is its length (s), None in statics: bodies in flight meet where they fly to.
        ``crossed`` are pairs of a vertex and an edge that are contacts in any case (`overlooked`).
        """
        self._last, points = self._sought(state, reach, step, crossed)
        return points

    def _sought(
        self,
        state: State,
        reach: float,
        step: float | None = None,
        crossed: tuple[Ints, Ints] | None = None,
    ) -> tuple[Contacts, ContactPoints]:
        """Return what search finds and the contact points it makes with joints; keep nothing."""
        surface, record = self._partners.surface(state), self.record
        joints = record.book.now(surface, self.geometry.apart(state, surface))
        found, interface = self._partners.search(
            state, 2 * reach, step, record.book, record.found, crossed
        )
        loose = np.zeros(len(found), dtype=bool)
        new = searched_points(found, interface, self._laws.initial(interface, loose), surface)
        if self._laws.stiff:
            new = self._laws.sized(new, surface)
        new = replace(new, gap=self.geometry.gaps(new, state))
        return found, concatenate([joints, self._followed(new, found)])

    def _followed(self, new: ContactPoints, found: Contacts) -> ContactPoints:
        """Return found points with what the last accepted step left, and gaps as they count."""
        record, before = self.record, np.full(len(new), -1, dtype=np.int64)
        if record.found is not None and record.known is not None:
            before = follow(record.found, found)
            new = remember(new, record.known, before)
        return counted(new, record.known, before, self._laws.normal_stiffness, self._edge_body)

    def solve(
        self,
        contacts: ContactPoints,
        state: State,
        request: StepRequest,
        midpoint: State | None = None,
    ) -> ContactSolution:
        """Solve one step; forces act at ``midpoint``, at the start of the step when None."""
        rows = self.geometry.rows(contacts, state, midpoint)
        means = self.geometry.face_means(contacts, self._partners.surface(state))
        more = [part for part in (means, request.null_space) if part is not None]
        return self._solver.solve(contacts, rows, request, more)

    def commit(self, solved: ContactSolution, state: State) -> ContactPoints:
        """Keep the accepted contacts as the start of the next step, and return them."""
        bonded = self._laws.bonded[solved.contacts.interface]
        done = answered(solved.contacts, solved.answer, bonded)
        surface = self._partners.surface(state)
        apart = self.geometry.apart(state, surface)
        self.record = ContactRecord(
            book=self.record.book.keep(done.take(done.is_joint), surface, apart),
            found=self._last,
            known=done.take(~done.is_joint),
            stored=solved.answer.stored,
        )
        return concatenate([done, self.record.book.lost])

    def restore(self, record: ContactRecord) -> None:
        """Go back to an earlier step, and start from there alone.

        Friction has many answers, and what a step that failed has slid is near wrong ones.
        """
        self.record = record
        self._solver.memory.forget_answers()

    def carried(self) -> ContactCarried:
        """See `Effect.carried`."""
        return ContactCarried(self.record, self._solver.memory.barrier_width)

    def carry(self, carried: ContactCarried) -> None:
        """See `Effect.carry`."""
        self.record = carried.record
        self._solver.memory.barrier_width = carried.barrier_width

    def forget(self) -> None:
        """See `Effect.forget`."""
        self._solver.forget()
        self._partners.forget()
        self._last = None

    def motion(self, before: State, after: State) -> Motion:
        """Return the step last solved as the edges moved in it."""
        return self._partners.motion(before, after)

    def overlooked(self, contacts: ContactPoints, motion: Motion) -> tuple[Ints, Ints] | None:
        """Return vertex and edge of crossings of pairs that were no contacts; None without any.

        Which edge a corner meets first is judged by where bodies seem to go; contacts on the way
        may send them elsewhere.
        """
        found = crossings_in(motion, FLUSH)
        if not len(found):
            return None
        surface, book = motion.before, self.record.book
        known = contacts.take(~contacts.is_joint)
        new = ~np.isin(
            pair_key(surface, found.vertex, found.edge),
            np.concatenate([pair_key(surface, known.edge_a, known.edge_b), book.pairs]),
        )
        new &= self._partners.interfaces(found.vertex, found.edge) >= 0
        new &= ~book.holds(surface, found.vertex, found.edge)
        new &= ~over_seams(found, motion, (known.edge_a, known.edge_b))
        return (found.vertex[new], found.edge[new]) if new.any() else None

    def passage(self, motion: Motion) -> str:
        """Say where a body went through another in a step; empty if none did."""
        return self._partners.passage(motion)

    @property
    def broken_bonds(self) -> int:
        """Number of joint points whose bond is broken."""
        return self.record.book.broken - self._unbonded

    def position(self, contacts: ContactPoints, state: State) -> Floats:
        """Return where the contacts are (m, 2)."""
        return self._partners.surface(state).at(contacts.edge_b, contacts.parameter_b)

    def acting(self) -> csc_array | None:
        """Return the matrix of the last system with the springs that acted in it."""
        return self._solver.acting()

    @property
    def springs_named(self) -> bool:
        """Whether any interface names the stiffness of its contacts."""
        return self._laws.stiff

    @property
    def stiffest(self) -> float | None:
        """Largest stiffness (N/m) of a contact that pressed in the last step, None without any."""
        return self._solver.stiffest

    def near(self, state: State, reach: float) -> tuple[tuple[csr_array, csr_array], Limits]:
        """Return rows and strength of contacts that bonds hold or that are open by ``reach``."""
        _, contacts = self._sought(state, reach)
        contacts = contacts.take(contacts.bonded | (contacts.gap <= reach))
        through = self.geometry.rows(contacts, state)
        return (through.normal, through.tangent), self._laws.strength(contacts)

    def condition(self, solver: LinearSolver) -> float | None:
        """Estimate the condition number of the last system with the springs that acted in it."""
        matrix = self.acting()
        try:
            return None if matrix is None else solver.factorise(matrix).condition()
        except SolveError:
            return None

    def energy(self, state: State) -> float:
        """Energy of contacts as last committed (J): of springs, and of an enforcement's own."""
        record = self.record
        known = [] if record.known is None else [record.known]
        points = concatenate([record.book.points, *known])
        return self._laws.energy(points, own_only=self._exact) + record.stored
