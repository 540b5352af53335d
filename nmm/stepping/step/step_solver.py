"""One trial step from a state: assemble what is constant in it, solve, return the result.

Only what may be dropped at any time is kept: factors, patterns and lists.
"""

from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Floats
from nmm.assembly.moving.motion import carried_on
from nmm.assembly.state import State
from nmm.effects.base import Instant, Span
from nmm.errors import SolveError
from nmm.frozen import with_parts
from nmm.integrators.base import Integrator
from nmm.model.discretisation import CurrentDiscretisation
from nmm.solvers.linear import LinearSolver
from nmm.solvers.unchecked import product
from nmm.stepping.step.booking import booked
from nmm.stepping.step.carried import CarriedState
from nmm.stepping.step.clock import Clock
from nmm.stepping.step.linear.assembly import Assembly
from nmm.stepping.step.linear.equations import Carriage, Equations, Linearisation, spinning
from nmm.stepping.step.linear.free_step import FreeStepSolver
from nmm.stepping.step.linear.linear_system import LinearSystem
from nmm.stepping.step.mover import Mover
from nmm.stepping.step.nonlinear.inner import InternalForces
from nmm.stepping.step.nonlinear.iterate import Solution, Solve
from nmm.stepping.step.nonlinear.newton import newton
from nmm.stepping.step.trial import Attempt

if TYPE_CHECKING:
    from nmm.constraints.driven_bodies import DrivenBodies
    from nmm.contact.points.contact_points import ContactPoints
    from nmm.contact.solution.record import Breaking, BrokenBonds
    from nmm.controls.path_equation import PathEquation
    from nmm.effects.change import Change
    from nmm.stepping.step.contact.contact_step import ContactStepSolver


class StepSolver:
    """Solves trial steps of the present discretisation.

    Parameters
    ----------
    mover, system
        Moves the bodies, and solves the equations of steps without contact.
    size
        Diagonal of the domain (m).
    carries
        Whether accelerations count (`Integrator.carries`).
    """

    def __init__(
        self,
        current: CurrentDiscretisation,
        mover: Mover,
        system: LinearSystem,
        size: float,
        carries: bool,
        clock: Clock,
    ) -> None:
        self._current, self._kinematics, self._clock = current, mover.kinematics, clock
        self._assembly, self._mover, self._system = Assembly(current), mover, system
        self._alone = FreeStepSolver(current, mover, system, clock)
        touches = current.plan.contact is not None
        self._touching = self._contact_step(size, carries) if touches else None

    def _contact_step(self, size: float, carries: bool) -> "ContactStepSolver":
        """Return what solves steps with contact; not imported where nothing may touch."""
        from nmm.stepping.step.contact.contact_step import ContactStepSolver

        given = self._current, self._mover, self._system.solver
        return ContactStepSolver(*given, size, carries, self._clock)

    @property
    def _solvers(self) -> "tuple[Mover | LinearSystem | ContactStepSolver, ...]":
        """What solves a step and keeps factors for it."""
        always = self._mover, self._system
        return always if self._touching is None else (*always, self._touching)

    def solve_by(self, solver: LinearSolver) -> None:
        """Take another linear solver."""
        for part in self._solvers:
            part.solver = solver

    def follow(self, change: "Change") -> None:
        """Continue on the discretisation after a change."""
        self._mover.follow(change)
        if self._touching is not None:
            self._touching.forget()

    def forget(self) -> None:
        """Drop factors, patterns and lists."""
        for part in (self._assembly, *self._solvers):
            part.forget()

    def reach(self, motion: float = 0.0) -> float:
        """Return how far contacts are sought after a step that moved by ``motion`` (m)."""
        return 0.0 if self._touching is None else self._touching.search.reach(motion)

    def candidates(self, state: State, reach: float, step: float | None) -> "ContactPoints":
        """Return the contact points of a step in which no point moves further than ``reach``."""
        assert self._touching is not None
        return self._touching.search.candidates(state, reach, step)

    def attempt(
        self,
        state: State,
        end: Instant,
        step: float | None,
        rule: Integrator,
        carried: CarriedState,
        breaking: "Breaking",
        broken: "BrokenBonds | None" = None,
    ) -> Attempt:
        """Solve the step from ``state`` to ``end``; ``step`` is its length (s); None is statics.

        ``broken`` are bonds that broke in an attempt of it before.
        """

        def solve(matter: Linearisation | None, before: Attempt | None = None) -> Solution:
            with self._clock.phase("assembly"):
                start = state if carriage is None else carriage.state
                given = start, end, step, rule, carried.anchored, matter
                equations = self._assembly.of(*given)
                if carriage is not None:
                    equations = with_parts(equations, state=state, carriage=carriage)
                if before is not None and plan.inertia is not None:
                    equations = spinning(equations, plan.inertia, before.state)
            return self._solved(equations, (breaking, broken), carried.reach, before)

        model, plan = self._current.model, self._current.plan
        linear = model.matter is None and not plan.bent
        carriage = self._carriage(state, end) if linear and step is None else None
        if linear:
            equations, found = solve(None)
        else:
            try:
                equations, found = self._bent(state, end, step, rule, solve)
            except SolveError as fault:
                return Attempt.failed(state, fault)
        if not found.converged or equations.inertia is None:
            return found
        missed = 0.0 if equations.rule.conserves else model.missed_work(state, found.state)
        off = driven = 0.0
        if equations.inertia.weight != 0.5:
            span = Span(step, equations.inertia.weight, half=not equations.rule.carries)
            off = plan.work_correction(state, found.state, found.increment, span)
            if plan.supports is not None:
                driven = plan.supports.late_work(state, found.state, equations.rule)
        work = booked(equations, found.increment, found.solved, missed, off, driven)
        return with_parts(found, booked=work)

    def carried_way(self, state: State, end: Instant) -> float:
        """Return how far (m) driven ground carries a body that may touch at most."""
        driven = self._driven(state, end)
        return 0.0 if driven is None else float(np.hypot(*driven.way.T).max())

    def _driven(self, state: State, end: Instant) -> "DrivenBodies | None":
        supports = self._current.plan.supports
        if self._touching is None or supports is None or state.frames.way is None:
            return None
        return supports.driven(state, end) if self._kinematics.turns else None

    def _carriage(self, state: State, end: Instant) -> Carriage | None:
        """Return where driven ground has carried bodies that may touch; None where nowhere."""
        model, driven = self._current.model, self._driven(state, end)
        if driven is None:
            return None
        bodies, rigid = np.arange(len(driven.way)), np.zeros((len(driven.way), 3))
        rigid[:, :2] = state.frames.to_body(bodies, driven.way)
        moved = carried_on(state, driven.ground, driven.way, driven.beside)
        return Carriage(moved, product(model.manifold.rigid_modes, rigid.ravel()))

    def _bent(
        self, state: State, end: Instant, step: float | None, rule: Integrator, solve: Solve
    ) -> Solution:
        """Solve a step whose internal forces are not linear."""
        current, moves, clock = self._current, self._kinematics, self._clock
        # Methods of contact are for symmetric matrices.
        symmetric = current.plan.contact is not None
        inner = InternalForces(current, state, end, step, rule, moves, symmetric, clock)
        equations, found = newton(inner, state, solve, clock)
        factor, matter = self._system.factor, current.model.matter
        if not moves.finite or factor is None or matter is None:
            return equations, found
        from nmm.stepping.step.stability import unless_unstable

        elastic, measure = matter.elastic_stiffness, current.model.measure
        return equations, unless_unstable(found, equations, factor, elastic, measure)

    def along(self, state: State, path: "PathEquation", rule: Integrator, reach: float) -> Attempt:
        """Solve a step of statics along a path (`nmm.contact.following`)."""
        assert self._touching is not None
        with self._clock.phase("path"):
            equations = self._standing(state, rule)
            try:
                return self._touching.paths.attempt(equations, path, reach)
            except SolveError as fault:
                return Attempt.failed(equations.state, fault)

    def losing(self, state: State, rule: Integrator, reach: float) -> Floats:
        """Return the energy (n,) by unknown (J) that bonds lose on a path from a state."""
        assert self._touching is not None
        with self._clock.phase("path"):
            return self._touching.paths.losing(self._standing(state, rule), reach)

    def _standing(self, state: State, rule: Integrator) -> Equations:
        """Return the equations of a step of statics under the load of the state itself."""
        return self._assembly.of(state, Instant.of(state), None, rule, anchored=False)

    def _solved(
        self,
        equations: Equations,
        bonds: tuple["Breaking", "BrokenBonds | None"],
        reach: float,
        before: Attempt | None,
    ) -> Solution:
        """Solve equations, with contact where the scene has it, near an answer ``before``."""
        try:
            if self._touching is None:
                return equations, self._alone.attempt(equations)
            with self._clock.phase("contact"):
                return self._touching.attempt(equations, *bonds, reach, before)
        except SolveError as fault:
            return equations, Attempt.failed(equations.state, fault)
