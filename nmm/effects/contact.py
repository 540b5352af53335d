"""Contact: bodies touch, rub, hold together by bonds, and part.

Joints (shared edges whose interface has strength or stiffness) are followed from the start; all
other contacts are found by search as bodies move. Both are contact points of one step problem.

Which bodies meet, and by which law, stands in `nmm.effects.contact_pairs`.
"""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Any, Self

import numpy as np
from scipy.sparse import csc_array, csr_array

from integration.arrays import Bools, Floats, Ints
from integration.polygons import centroids
from nmm.assembly.model import Model
from nmm.assembly.motion import State
from nmm.contact.detection.crossing import Motion, crossings_in
from nmm.contact.detection.joints import Joints, find_joints
from nmm.contact.detection.narrow_phase import Contacts, follow, pair_key
from nmm.contact.detection.surface import Surface
from nmm.contact.detection.tolerances import FLUSH
from nmm.contact.enforcement.base import Enforcement, make_enforcement
from nmm.contact.enforcement.null_space import Constrained, NullSpace
from nmm.contact.enforcement.rebalanced import solve_rebalanced
from nmm.contact.iteration.memory import Memory
from nmm.contact.iteration.record import Breaking, ContactRecord, ContactSolution
from nmm.contact.laws.bonds import Laws, break_bonds
from nmm.contact.laws.compliance import Softness
from nmm.contact.laws.damage_iteration import Turns, slid_under_load
from nmm.contact.laws.dashpots import Dashpots, meeting_mass
from nmm.contact.laws.time_weighting import MeanSprings, end_shares
from nmm.contact.mortar.face_means import WeakFaces
from nmm.contact.mortar.segments import face_points
from nmm.contact.mortar.trace_space import Traces
from nmm.contact.points.contact_points import ContactPoints, concatenate, rows
from nmm.contact.points.joint_points import Stations
from nmm.contact.points.midpoint import Rows, halfway_rows
from nmm.contact.points.reference_gap import counted
from nmm.contact.points.tracking import (
    Apart,
    JointBook,
    answered,
    apart_on,
    joint_book,
    remember,
    searched_points,
)
from nmm.contact.problem.balance import with_springs
from nmm.contact.problem.step_problem import SLIDE, Limits, StepAnswer, StepProblem
from nmm.effects.base import Effect, Setup
from nmm.effects.contact_momentum import Momentum
from nmm.effects.contact_pairs import held_bodies, interface_law, pairs_of
from nmm.effects.contact_partners import Partners
from nmm.errors import SolveError
from nmm.solvers.linear import LinearSolver


class Contact(Effect):
    """All contacts of a scene.

    The step loop asks for `candidates` once a step, solves them by `solve` as often as it needs,
    and hands the accepted ones back to `commit`.
    """

    name = "contact"

    def __init__(
        self,
        model: Model,
        laws: Laws,
        partners: Partners,
        enforcement: Enforcement,
        stations: str,
        start: State,
        held: Bools,
        bends: bool,
        in_the_mean: bool = False,
    ) -> None:
        self._model = model
        self._laws = laws
        self._partners = partners
        self._sides = partners.sides
        self._enforcement = enforcement
        # All but the penalty replace springs that are not the joints' own by exact conditions.
        self._exact = enforcement.name != "penalty"
        self._softness = Softness.of(model)
        self._bends = bends
        self._traces = Traces.of(self._sides, model.modulus) if in_the_mean else None
        cover = np.diff(model.manifold.cover_offset)
        self._bodies = np.repeat(model.manifold.cover_body, cover)
        self._memory = Memory()
        self._solved: tuple[StepProblem, StepAnswer] | None = None
        self._last: Contacts | None = None
        self.record = ContactRecord(self._follow_joints(partners.surface(start), stations))
        self._stations = Stations.of(self._sides, self.record.book.points)
        self._unbonded = self.record.book.broken
        curved = bends or self._stations is not None
        self.momentum = Momentum(model, self._sides, held, curved)

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build from ``[contact]``, the interfaces and the formulation's ``[contact]``."""
        method = setup.formulation.contact
        unit = float(setup.model.modulus.max()) * setup.model.thickness
        penalty = method.normal_penalty * unit
        laws = Laws(
            laws=[interface_law(item) for item in setup.scene.interfaces.values()],
            thickness=setup.model.thickness,
            normal_penalty=penalty,
            shear_penalty=penalty * method.shear_ratio,
            normal_bond=method.bond_stiffness * unit,
            shear_bond=method.bond_stiffness * unit * method.shear_ratio,
        )
        options: dict[str, Any] = dict(method.options)
        if method.enforcement == "penalty":
            options.setdefault("max_passes", method.max_passes)
        points = face_points(setup.formulation)
        enforcement = make_enforcement(method.enforcement, options)
        # Fields of blocks follow what single points ask for.
        in_the_mean = enforcement.multipliers and not setup.formulation.cover.of_blocks
        # Nor has a mean a stiffness of its own.
        in_the_mean &= points > 0 and not laws.stiff
        return cls(
            setup.model,
            laws,
            Partners(
                setup.model,
                pairs_of(setup),
                within_bodies=bool(setup.scene.cracks),
                face_points=points,
                origin=setup.origin,
                whole_faces=in_the_mean,
            ),
            enforcement,
            method.joint_points,
            setup.start,
            held_bodies(setup),
            # Faces bend between their ends: contacts act at points of the material.
            bends=points > 2,
            in_the_mean=in_the_mean,
        )

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
        surface = self._partners.surface(state)
        record = self.record
        joints = record.book.now(surface, self._apart(state))
        found, interface = self._partners.search(
            state, 2 * reach, step, record.book, record.found, crossed
        )
        new = searched_points(found, interface, surface)
        if self._laws.stiff:
            new = self._laws.sized(new, surface)
        if self._bends:
            apart = Stations.at(self._sides, new).apart(new, state.frames, state.deformation)
            new = replace(new, gap=np.einsum("ij,ij->i", apart, new.normal))
        return found, concatenate([joints, self._followed(new, found)])

    def _followed(self, new: ContactPoints, found: Contacts) -> ContactPoints:
        """Return found points with what the last accepted step left, and gaps as they count."""
        record, before = self.record, np.full(len(new), -1, dtype=np.int64)
        if record.found is not None and record.known is not None:
            before = follow(record.found, found)
            new = remember(new, record.known, before)
        body = self._model.manifold.boundary.body
        return counted(new, record.known, before, self._normal_stiffness, body)

    def _normal_stiffness(self, points: ContactPoints) -> Floats:
        return self._laws.springs(points)[0]

    def solve(
        self,
        contacts: ContactPoints,
        state: State,
        matrix: csc_array,
        force: Floats,
        solver: LinearSolver,
        breaking: Breaking = "all",
        step: float | None = None,
        weight: float = 1.0,
        halfway: State | None = None,
        held: NullSpace | None = None,
        near: Callable[[Floats], bool] | None = None,
    ) -> ContactSolution:
        """Solve one step; bonds that cannot hold break and the step is solved again.

        ``breaking`` says which break at a time: "all", the "worst" alone, or "stop": none, the step
        ends there and is no equilibrium. ``step`` is its length (s), None in statics; ``weight``
        the share of its end in the stretch of springs (`nmm.contact.laws.time_weighting`).
        ``halfway`` is where forces act; at the start of the step when None. ``held`` are conditions
        on the unknowns besides. ``near`` says whether an increment (n,) moves no further than
        contacts were sought: no bond is judged by one that does.
        """
        enforcement = self._enforcement if held is None else Constrained(self._enforcement, held)
        self._memory.moving = step is not None
        through = self._rows(contacts, state, halfway)
        weak = self._weak(contacts, state)
        turns = Turns(self._laws, contacts)
        nowhere = np.zeros(len(contacts), dtype=bool)
        passes, loss = 0, 0.0
        while True:
            normal, shear, own = self._laws.springs(turns.start, nowhere)
            if self._exact:
                share = self._softness.of_contacts(turns.start, own)
                normal, shear = share * normal, share * shear
            dashpots = self._dashpots(turns.start, normal, through.normal, step)
            shares = end_shares(weight, self._exact, own, self._laws.softening(turns.start))
            springs = MeanSprings.of(turns.start, (normal, shear), shares, turns.rise, dashpots)
            shift = turns.lift + springs.lag
            problem = StepProblem(
                matrix=matrix,
                force=force,
                normal_rows=through.normal,
                tangent_rows=through.tangent,
                gap=contacts.gap - shift,
                slip=contacts.slip + springs.lead,
                normal_stiffness=springs.normal,
                shear_stiffness=springs.shear,
                limits=self._laws.limits(turns.contacts),
                state=contacts.state,
                normal_force=contacts.normal_force,
                shear_force=contacts.shear_force,
                compliant=own | (dashpots.stiffness > 0),
            )
            doubled = turns.twins.joined(problem)
            wide = None if weak is None else weak.wider(doubled.n_contacts)
            joined = doubled if wide is None else wide.joined(doubled)
            # A step that looks further and finds no other contacts asks the same again.
            found = self._memory.known(joined) if held is None else None
            if found is None:
                started = self._memory.started(joined)
                if held is None:
                    found = solve_rebalanced(
                        enforcement, started, solver, self._memory, self._bodies
                    )
                else:
                    found = enforcement.solve(started, solver, self._memory)
            self._memory.answered = None if held is not None else (joined, found)
            whole = found if wide is None else wide.merged(found, joined, doubled)
            answer = turns.twins.merged(whole)
            passes += answer.passes
            self._solved = (problem if held is None else held.reduced(problem), answer)
            if not answer.verdict.converged:
                return ContactSolution(turns.contacts, answer, passes, loss)
            sliding = slid_under_load(problem, answer)
            answer = springs.unshifted(answer, shift)
            fault = turns.settled(answer, sliding)
            if fault is not None:
                return ContactSolution(turns.contacts, replace(answer, verdict=fault), passes, loss)
            if not turns.done:
                self._memory.start = answer.increment
                continue
            broken, _ = self._laws.breaking(turns.contacts, answer, breaking == "worst")
            if not broken.any():
                loss += turns.loss(answer, sliding)
                loss += dashpots.loss(
                    normal,
                    (contacts.gap, answer.gap),
                    (
                        np.where(shares < 1, answer.normal_force, contacts.normal_force),
                        answer.normal_force,
                    ),
                )
                return ContactSolution(
                    turns.contacts, answer, passes, loss, False, sliding, through
                )
            if near is not None and not near(answer.increment):
                return ContactSolution(turns.contacts, answer, passes, loss)
            if breaking == "stop":
                return ContactSolution(turns.contacts, answer, passes, loss, stopped=True)
            elastic = answer.normal_force**2 / normal + answer.shear_force**2 / shear
            loss += float(elastic[broken].sum()) / 2
            contacts = break_bonds(contacts, broken)
            turns = Turns(self._laws, contacts)

    def _rows(self, contacts: ContactPoints, state: State, halfway: State | None) -> Rows:
        if halfway is not None:
            return halfway_rows(contacts, self._sides, self._model, state, halfway)
        n_unknowns = self._model.manifold.n_unknowns
        stations = Stations.at(self._sides, contacts) if self._bends else self._stations
        found = rows(contacts, self._sides, state.frames, n_unknowns, stations)
        return Rows(*found, contacts.normal)

    def _weak(self, contacts: ContactPoints, state: State) -> WeakFaces | None:
        """Return how exact conditions on faces of meshes are held in the mean; None elsewhere."""
        if self._traces is None:
            return None
        return WeakFaces.of(contacts, self._partners.surface(state), self._traces)

    def commit(self, solved: ContactSolution, state: State) -> ContactPoints:
        """Keep the accepted contacts as the start of the next step, and return them."""
        bonded = self._laws.bonded[solved.contacts.interface]
        done = answered(solved.contacts, solved.answer, bonded, solved.sliding)
        surface = self._partners.surface(state)
        self.record = ContactRecord(
            book=self.record.book.keep(done.take(done.is_joint), surface, self._apart(state)),
            found=self._last,
            known=done.take(~done.is_joint),
        )
        return concatenate([done, self.record.book.lost])

    def restore(self, record: ContactRecord) -> None:
        """Go back to an earlier step, and start from there alone.

        Friction has many answers, and what a step that failed has slid is near wrong ones.
        """
        self.record = record
        self._memory.forget_answers()

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
        if self._solved is None:
            return None
        problem, answer = self._solved
        closed = answer.normal_force != 0
        limits = problem.limits
        bound = limits.cohesion + limits.friction * np.maximum(-answer.normal_force, 0.0)
        held = closed & (answer.state != SLIDE) & (bound > 0)
        return with_springs(
            problem,
            np.where(closed, problem.normal_stiffness, 0.0),
            np.where(held, problem.shear_stiffness, 0.0),
        )

    @property
    def springs_named(self) -> bool:
        """Whether any interface names the stiffness of its contacts."""
        return self._laws.stiff

    @property
    def stiffest(self) -> float | None:
        """Largest stiffness (N/m) of a contact that pressed in the last step, None without any."""
        if self._solved is None or self._exact:
            return None
        problem, answer = self._solved
        pressed = answer.normal_force < 0
        return float(problem.normal_stiffness[pressed].max()) if pressed.any() else None

    def near(self, state: State, reach: float) -> tuple[tuple[csr_array, csr_array], Limits]:
        """Return rows and strength of contacts that bonds hold or that are open by ``reach``."""
        _, contacts = self._sought(state, reach)
        held = contacts.is_joint & (contacts.damage < 1)
        contacts = contacts.take(held | (contacts.gap <= reach))
        through = self._rows(contacts, state, None)
        return (through.normal, through.tangent), self._laws.strength(contacts)

    def condition(self, solver: LinearSolver) -> float | None:
        """Estimate the condition number of the last system with the springs that acted in it."""
        matrix = self.acting()
        try:
            return None if matrix is None else solver.factorise(matrix).condition()
        except SolveError:
            return None

    def energy(self, state: State) -> float:
        """Energy of the springs of the contacts as last committed (J)."""
        record = self.record
        known = [] if record.known is None else [record.known]
        points = concatenate([record.book.points, *known])
        return self._laws.energy(points, own_only=self._exact)

    def _dashpots(
        self, contacts: ContactPoints, normal: Floats, rows: csr_array, step: float | None
    ) -> Dashpots:
        """Return the dampers of a step; a share of critical damping of the masses that meet."""
        if step is None or not self._laws.damps:
            return Dashpots(np.zeros(len(contacts)), np.zeros(len(contacts)))
        body = self._model.manifold.boundary.body
        pair = body[contacts.edge_a] * self._model.manifold.n_bodies + body[contacts.edge_b]
        modes = self._model.manifold.rigid_modes
        critical = 2 * np.sqrt(normal * meeting_mass(rows, pair, modes, self.momentum.ease))
        coefficient = self._laws.damping(contacts) * critical
        return Dashpots.of(coefficient, step, normal, contacts.gap)

    def _apart(self, state: State) -> Apart:
        """How far apart the sides of joints are in a state."""
        if self._stations is None:
            return partial(apart_on, self._partners.surface(state))
        return partial(self._stations.apart, frames=state.frames, deformation=state.deformation)

    def _follow_joints(self, surface: Surface, stations: str) -> JointBook:
        joints = find_joints(surface)
        interface = self._partners.interfaces(joints.edge_a, joints.edge_b)
        makes = np.array([law.makes_joints for law in self._laws.laws])
        wanted = (interface >= 0) & makes[np.maximum(interface, 0)]
        joints = joints.take(wanted)
        bonded = self._laws.bonded[interface[wanted]]
        distance = self._distance(joints)
        return joint_book(surface, joints, interface[wanted], bonded, distance, stations)

    def _distance(self, joints: Joints) -> Floats:
        """Return lengths (j,) of the stiffest material as soft as what lies across joints (m).

        ``h = E_max (h_a / E_a + h_b / E_b)`` with the distances of both elements' middles from the
        joint; where moduli are equal to the largest, the distance of the middles.
        """
        manifold, modulus = self._model.manifold, self._model.modulus
        middle = centroids(manifold.elements)
        a, b = (manifold.boundary.element[edge] for edge in (joints.edge_a, joints.edge_b))
        far_a, far_b, apart = (
            np.abs(np.einsum("ij,ij->i", way, joints.normal))
            for way in (middle[a] - joints.start, middle[b] - joints.start, middle[a] - middle[b])
        )
        softness = modulus.max() / modulus
        share = far_a / (far_a + far_b)
        mixed = share * softness[a] + (1 - share) * softness[b]
        return np.asarray(apart * np.where(softness[a] == softness[b], softness[a], mixed))
