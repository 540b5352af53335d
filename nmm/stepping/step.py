"""One step: assemble what is constant in it, solve, judge. Nothing is kept unless accepted."""

from dataclasses import dataclass, replace
from operator import is_not
from time import perf_counter
from typing import TYPE_CHECKING

import numpy as np
from scipy.sparse import csc_array, csr_array

from integration.arrays import Floats, Ints
from nmm.assembly.kept import KeptOfStates
from nmm.assembly.model import Model
from nmm.assembly.motion import State, move, strain_only, vertex_points
from nmm.effects.base import Instant
from nmm.errors import SolveError
from nmm.solvers.bordered import bordered
from nmm.solvers.linear import Factor, LinearSolver
from nmm.solvers.rigid_apart import ROUNDED, Apart, rounding, solve_apart
from nmm.stepping.bodies import rigid_bodies
from nmm.stepping.integrators import Integrator, Shi
from nmm.stepping.plan import Plan
from nmm.stepping.relay import Lay, relay

if TYPE_CHECKING:
    from nmm.contact.held import Held
    from nmm.contact.points import ContactPoints
    from nmm.contact.record import Breaking, ContactRecord, Solved

# Contacts are sought as far as points can move in a step. The first step has no motion to go by
# and looks this far, in sizes of the domain; a step that moves further is solved again.
FIRST_REACH = 1e-6
# How often a step is solved again with contact forces where they act half way.
HALVES = 4


@dataclass(frozen=True)
class Attempt:
    """What came of a step; to be accepted or thrown away.

    Attributes
    ----------
    converged, sentence
        The verdict.
    state
        The state at the end; that of the start when the step failed.
    increment
        (n,) unknowns of the step.
    motion
        Largest motion of a point (m).
    residual
        Relative out-of-balance force.
    passes
        Linear systems solved.
    solved
        Contact points with their forces; None without contact.
    """

    converged: bool
    sentence: str
    state: State
    increment: Floats
    motion: float
    residual: float
    passes: int
    solved: "Solved | None" = None


class Stepper:
    """Solves steps of one plan; owns factors and what contact remembers.

    Attributes
    ----------
    anchored
        Whether soft springs hold bodies in statics to where they stand (`nmm.stepping.loose`).
    """

    def __init__(
        self,
        model: Model,
        plan: Plan,
        integrator: Integrator,
        solver: LinearSolver,
        small: bool,
        lay: Lay | None = None,
    ) -> None:
        self.model = model
        self.plan = plan
        self._integrator = integrator
        self._starter = Shi(kinetic_factor=integrator.kinetic_factor)
        self._begun = False
        self.solver = solver
        self.small = small
        self._lay = lay
        self.anchored = False
        self.seconds: dict[str, float] = {}
        self.reference = model.manifold.elements.points
        self.vertices = vertex_points(model.manifold)
        self._size = float(np.hypot(*np.ptp(self.reference, axis=0)))
        self._reach = FIRST_REACH * self._size
        self._factor: Factor | None = None
        self._kept: tuple[float, tuple[csc_array, csc_array], csc_array] | None = None
        self._weighted: tuple[csc_array, float, csc_array] | None = None
        self._soft: tuple[Model, csc_array] | None = None
        self._masses: tuple[csc_array, Ints, Factor] | None = None
        self._places = KeptOfStates(self._placed)
        self._held: Held | None = None

    @property
    def size(self) -> float:
        """Diagonal of the domain (m)."""
        return self._size

    @property
    def factor(self) -> Factor | None:
        """The last factor of a system without contacts."""
        return self._factor

    def attempt(
        self, state: State, end: Instant, step: float | None, breaking: "Breaking" = "all"
    ) -> Attempt:
        """Solve the step from ``state`` to ``end``; ``step`` is its length (s); None is statics."""
        started = perf_counter()
        matrix, force = self._system(state, end, step)
        self._spend("assembly", started)
        try:
            return self._solve(state, end, step, matrix, force, breaking)
        except SolveError as fault:
            return Attempt(False, str(fault), state, np.zeros_like(force), 0.0, np.nan, 1)

    def accept(self, attempt: Attempt) -> tuple[State, "ContactPoints | None"]:
        """Make an attempt the start of the next step; return it with its contacts as left."""
        self._reach = max(2 * attempt.motion, FIRST_REACH * self._size)
        self._begun = True
        state, contact, contacts = attempt.state, self.plan.contact, None
        if contact is not None and attempt.solved is not None:
            contacts = contact.commit(attempt.solved, state)
        if self._lay is not None:
            place = self.place(state)
            self.model, self.plan, state = relay(
                self.model, self.plan, self._lay, state, attempt.increment, place
            )
            self.vertices = vertex_points(self.model.manifold)
            self._places.forget()
        return state, contacts

    def remember(self) -> "ContactRecord | None":
        """Return what contact knows now, for `restore`."""
        return None if self.plan.contact is None else self.plan.contact.record

    def restore(self, record: "ContactRecord | None") -> None:
        """Take back what was accepted since `remember`."""
        if self.plan.contact is not None and record is not None:
            self.plan.contact.record = record

    @property
    def broken_bonds(self) -> int:
        """Number of joint points whose bond is broken."""
        return 0 if self.plan.contact is None else self.plan.contact.broken_bonds

    @property
    def _still(self) -> bool:
        """Whether the bodies' axes stay as they are."""
        return self.small or self._lay is not None

    @property
    def _rule(self) -> Integrator:
        """The integrator of the step.

        The first step is Shi's: no acceleration is known at its start, and it damps the waves of
        loads that come all at once. Its error of the velocity, once of order 2 in the step, leaves
        orders as they are.
        """
        return self._integrator if self._begun else self._starter

    def _system(self, state: State, end: Instant, step: float | None) -> tuple[csc_array, Floats]:
        force = self.plan.force(state, end) - self.model.stiffness @ state.deformation
        inertia = self.plan.inertia
        if step is None or inertia is None:
            held = self._anchors() if self.anchored else self.model.stiffness
            return self.plan.matrix(state, held), force
        integrator, weight = self._rule, self._rule.end_weight
        if weight < 1:
            now = Instant(state.time, state.load_factor)
            earlier = self.plan.force(state, now) - self.model.stiffness @ state.deformation
            force = weight * force + (1 - weight) * earlier
        velocity = integrator.kinetic_factor * state.velocity
        momentum = integrator.momentum(velocity, state.acceleration, step)
        base = self._base(integrator.mass_factor(step) / weight, inertia.mass)
        share = 1.0 if self.plan.contact is None else integrator.contact_factor
        matrix = self._times(weight / share, self.plan.matrix(state, base))
        return matrix, (force + inertia.mass @ momentum) / share

    def _anchors(self) -> csc_array:
        """Return elasticity with anchors (`nmm.stepping.loose`), the same object each time."""
        if self._soft is None or self._soft[0] is not self.model:
            from nmm.stepping.loose import anchors

            self._soft = self.model, csc_array(self.model.stiffness + anchors(self.model))
        return self._soft[1]

    def _times(self, factor: float, matrix: csc_array) -> csc_array:
        """Return ``factor * matrix``, the same object of the same matrix."""
        if factor == 1:
            return matrix
        kept = self._weighted
        if kept is None or kept[0] is not matrix or kept[1] != factor:
            kept = self._weighted = matrix, factor, csc_array(factor * matrix)
        return kept[2]

    def _base(self, mass_factor: float, mass: csc_array) -> csc_array:
        """Return elasticity and inertia, the same object as long as the step's length stays."""
        parts = (self.model.stiffness, mass)
        kept = self._kept
        if kept is None or kept[0] != mass_factor or any(map(is_not, kept[1], parts)):
            kept = mass_factor, parts, csc_array(self.model.stiffness + mass_factor * mass)
            self._kept = kept
        return kept[2]

    def _solve(
        self,
        state: State,
        end: Instant,
        step: float | None,
        matrix: csc_array,
        force: Floats,
        breaking: "Breaking",
    ) -> Attempt:
        if self.plan.contact is None:
            return self._solve_alone(state, end, step, matrix, force)
        contact = self.plan.contact
        weight = 1.0 if step is None else self._rule.contact_weight
        passes, reach, halves = 0, self._reach, 0
        contacts, halfway = self._candidates(state, reach, step), None
        held = self._conditions(state, end)
        while True:
            started = perf_counter()
            solved = contact.solve(
                contacts, state, matrix, force, self.solver, breaking, step, weight, halfway, held
            )
            self._spend("solve", started)
            passes += solved.passes
            verdict, increment = solved.answer.verdict, solved.answer.increment
            rest = force - matrix @ increment
            if held is not None and solved.rows is not None:
                rest = rest - self._holding(held, solved, rest)
            push = -rest if self._integrator.carries and step else None
            result = self._result(state, end, step, increment, push)
            far = result.motion
            good = verdict.converged and far <= self._size and not solved.stopped
            if good and far > reach:
                reach = 1.5 * far
                contacts, halfway = self._candidates(state, reach, step), None
                continue
            if good and step is not None and not self._still:
                half = contact.momentum.halfway(solved, state, result.state, halfway)
                if half is not None and halves < HALVES:
                    halfway, halves = half, halves + 1
                    continue
                result = self._faster(
                    result, contact.momentum.kept(solved, state, result.state, step, rest)
                )
            through = contact.passage(state, result.state) if good else ""
            return replace(
                result,
                converged=good and not through,
                sentence=through or verdict.sentence,
                residual=solved.answer.residual,
                passes=passes,
                solved=solved,
            )

    def _conditions(self, state: State, end: Instant) -> "Held | None":
        """Return the conditions of supports by multipliers in a step with contact."""
        border = self.plan.border(state, end)
        if border is None:
            return None
        from nmm.contact.held import Held

        self._held = Held.of(*border, self._held)
        return self._held

    def _holding(self, held: "Held", solved: "Solved", rest: Floats) -> Floats:
        """Return the forces (n,) of the multipliers, which the supports are told."""
        assert solved.rows is not None
        answer, through = solved.answer, solved.rows
        rest = rest - through.normal.T @ answer.normal_force
        multipliers = held.multipliers(rest - through.tangent.T @ answer.shear_force)
        self.plan.keep(multipliers)
        return np.asarray(held.rows.T @ multipliers)

    def _candidates(self, state: State, reach: float, step: float | None) -> "ContactPoints":
        assert self.plan.contact is not None
        started = perf_counter()
        contacts = self.plan.contact.candidates(state, reach, step)
        self._spend("search", started)
        return contacts

    @staticmethod
    def _faster(result: Attempt, change: Floats) -> Attempt:
        """Return the attempt with its velocity changed."""
        state = replace(result.state, velocity=result.state.velocity + change)
        return replace(result, state=state)

    def _solve_alone(
        self, state: State, end: Instant, step: float | None, matrix: csc_array, force: Floats
    ) -> Attempt:
        started = perf_counter()
        border = self.plan.border(state, end)
        n, solver = len(force), self.solver
        if border is not None:
            matrix = bordered(matrix, border[0])
            force, solver = np.concatenate([force, border[1]]), solver.indefinite()
        if self._factor is None or not _same(self._factor.matrix, matrix):
            self._factor = solver.factorise(matrix)
        increment = self._factor.solve(force)
        residual = self._factor.relative_residual(increment, force)
        apart = None if step is not None else self._apart(state, increment, force, border, residual)
        if border is not None:
            self.plan.keep(increment[n:] if apart is None else apart.multipliers)
            increment = increment[:n]
        self._spend("solve", started)
        result = self._result(state, end, step, increment)
        if apart is None:
            return replace(result, residual=residual)
        moved = strain_only(self.model, state, apart.strain, apart.rigid)
        moved = replace(moved, time=end.time, load_factor=end.load_factor)
        return replace(result, state=moved, residual=apart.residual)

    def _apart(
        self,
        state: State,
        increment: Floats,
        force: Floats,
        border: tuple[csr_array, Floats] | None,
        residual: float,
    ) -> Apart | None:
        """Solution with rigid motions apart where rounding would spoil the stress; else None."""
        if not self.small or self.model.manifold.n_bodies == 1:
            return None
        assert self._factor is not None
        bodies = rigid_bodies(self.model)
        if rounding(self._factor, bodies, increment, force) <= ROUNDED:
            return None
        none = csc_array(self.model.stiffness.shape)
        held = self.plan.matrix(state, none)
        rows = None if border is None else border[0]
        found = solve_apart(self._factor, bodies, held, force, rows)
        return found if found.residual < residual else None

    def _result(
        self,
        state: State,
        end: Instant,
        step: float | None,
        increment: Floats,
        push: Floats | None = None,
    ) -> Attempt:
        """Move by ``increment``; ``push`` (n,) is the contact force if its acceleration counts."""
        started = perf_counter()
        after = state
        if step is not None:
            velocity, acceleration = self._rule.rates(
                increment,
                self._rule.kinetic_factor * state.velocity,
                state.acceleration,
                step,
            )
            if push is not None:
                fast, more = self._rule.contact_kick
                kick = self._accelerated(push)
                velocity, acceleration = velocity + fast * step * kick, acceleration + more * kick
            after = replace(state, velocity=velocity, acceleration=acceleration)
        moved = (strain_only if self._still else move)(self.model, after, increment)
        moved = replace(moved, time=end.time, load_factor=end.load_factor)
        way = self.place(moved) - self.place(state)
        motion = float(np.sqrt((way**2).sum(axis=1).max()))
        self._spend("update", started)
        return Attempt(True, "converged", moved, increment, motion, 0.0, 1)

    def _accelerated(self, push: Floats) -> Floats:
        """Return the acceleration (n,) by a force; none of what has no mass."""
        assert self.plan.inertia is not None
        mass = self.plan.inertia.mass
        if self._masses is None or self._masses[0] is not mass:
            heavy = np.flatnonzero(mass.diagonal() > 0)
            factor = self.solver.factorise(csc_array(mass[heavy][:, heavy]))
            self._masses = mass, heavy, factor
        _, heavy, factor = self._masses
        found = np.zeros_like(push)
        found[heavy] = factor.solve(push[heavy])
        return found

    def place(self, state: State) -> Floats:
        """Return where the elements' vertices are (P, 2)."""
        return self._places.of(state)

    def _placed(self, state: State) -> Floats:
        return self.vertices.place(state.frames, state.deformation)

    def condition(self, state: State) -> float | None:
        """Estimate the condition number of the last system, springs of contact included."""
        if self._factor is not None:
            return self._factor.condition()
        contact = self.plan.contact
        return None if contact is None else contact.condition(self.solver)

    def _spend(self, phase: str, started: float) -> None:
        self.seconds[phase] = self.seconds.get(phase, 0.0) + perf_counter() - started


def _same(a: csc_array, b: csc_array) -> bool:
    return (
        a.nnz == b.nnz and np.array_equal(a.data, b.data) and np.array_equal(a.indices, b.indices)
    )


def scaled_load(stepper: Stepper, factor: float) -> float | None:
    """Return the resultant (N) of the scaled loads at a load factor; None without loads."""
    loads = stepper.plan.loads
    return None if loads is None else loads.scaled_resultant(factor)
