"""A step in which bodies may touch: contacts are sought, solved, and judged by how far all moved.

Contacts are sought as far as points can move in a step. The first step has no motion to go by; one
that moves further is solved again, and so is one whose forces act elsewhere half way.
"""

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Floats
from nmm.assembly.motion import State, middle
from nmm.contact.candidates.held_back import joined
from nmm.contact.detection.tolerances import (
    CROSSING_SOLUTIONS,
    FIRST_REACH,
    FURTHER,
    MIDPOINT_SOLUTIONS,
)
from nmm.contact.solution.request import StepRequest
from nmm.effects.base import Instant
from nmm.frozen import with_parts
from nmm.model.discretisation import Current
from nmm.solvers.linear import LinearSolver
from nmm.solvers.unchecked import product
from nmm.stepping.step.clock import Clock
from nmm.stepping.step.equations import Equations
from nmm.stepping.step.mover import Mover
from nmm.stepping.step.trial import Attempt, Sought

if TYPE_CHECKING:
    from nmm.contact.candidates.held_back import Crossed
    from nmm.contact.detection.crossing import Motion
    from nmm.contact.enforcement.null_space import NullSpace
    from nmm.contact.points.contact_points import ContactPoints
    from nmm.contact.solution.momentum import Momentum
    from nmm.contact.solution.record import Breaking, ContactSolution
    from nmm.controls.path_equation import PathEquation
    from nmm.effects.change import Change
    from nmm.effects.contact import Contact

# Solutions of a step along a path, each with contacts sought further.
PATH_SOLUTIONS = 4


class Touching:
    """Solves steps with contact.

    Parameters
    ----------
    size
        Diagonal of the domain (m): a step that moves further has not converged.
    carries
        Whether accelerations count (`Integrator.carries`).
    """

    def __init__(
        self,
        current: Current,
        mover: Mover,
        solver: LinearSolver,
        size: float,
        carries: bool,
        clock: Clock,
    ) -> None:
        self._current, self._mover, self.solver, self._clock = current, mover, solver, clock
        self._size, self._carries = size, carries
        self._held: NullSpace | None = None
        self._last: tuple[State, Sought] | None = None

    def follow(self, change: "Change") -> None:
        """Forget the conditions of the old model; how far bodies move in a step stays known."""
        self.forget()

    def reach(self, motion: float = 0.0) -> float:
        """Return how far contacts are sought after a step that moved by ``motion`` (m)."""
        return max(2 * motion, FIRST_REACH * self._size)

    def forget(self) -> None:
        """Drop what is kept for speed alone."""
        self._held = self._last = None

    def attempt(
        self,
        equations: Equations,
        breaking: "Breaking",
        reach: float,
        foreseen: Attempt | None = None,
    ) -> Attempt:
        """Solve a step; ``breaking`` says which bonds break at a time.

        Contacts are sought up to ``reach`` (m) at first. Those of bodies that bend by any angle act
        between where the step begins and where it was ``foreseen`` to end.

        Raises
        ------
        SolveError
            Where the load moves a part that nothing holds.
        """
        contact, state = self.contact, equations.state
        near, passes = self._near(equations, foreseen), 0
        again = foreseen is not None and near is None
        sought, held = self._found(equations, reach, again), self._conditions(equations)
        while True:
            solved = self._solve(equations, sought, breaking, held, near)
            passes += solved.passes
            verdict, motion = solved.answer.verdict, None
            result, rest = self._judged(equations, solved, held)
            good = verdict.converged and result.motion <= self._size and not solved.stopped
            if good and result.motion <= sought.reach:
                motion = contact.partners.motion(state, result.state)
            further = self._again(equations, sought, solved, result, motion) if good else None
            if further is not None:
                sought = further
                continue
            self._last = state, sought
            if good and self._turns(equations) and solved.rows is not None:
                result = self._kept(equations, solved, result, rest)
            if good and near is not None and solved.rows is not None:
                result = with_parts(result, missed=self._missed(state, solved, result.state))
            passage = "" if motion is None else contact.partners.passage(motion)
            sentence = passage or self._why(verdict.sentence, result, solved)
            return result.told(good and not passage, sentence, solved, passes)

    def _found(self, equations: Equations, reach: float, again: bool) -> Sought:
        """Return the contacts of a step: those of its last iteration where it is solved ``again``.

        Forces that bend move bodies by little from one iteration to the next.
        """
        state = equations.state
        if again and self._last is not None and self._last[0] is state:
            return replace(self._last[1], crossings=0, midpoints=0)
        contacts = self.candidates(state, reach, equations.step)
        ahead = self._ahead(equations, contacts, self.contact.momentum)
        return Sought(reach, contacts, ahead, ahead)

    def _again(
        self,
        equations: Equations,
        sought: Sought,
        solved: "ContactSolution",
        result: Attempt,
        motion: "Motion | None",
    ) -> Sought | None:
        """Return with what a step is solved again; None where its solution stands.

        ``motion`` is None where bodies went further than contacts were sought.
        """
        if motion is None:
            return self._looked(equations, replace(sought, reach=FURTHER * result.motion))
        missed = self.contact.overlooked(sought.contacts, motion)
        if missed is not None and sought.crossings < CROSSING_SOLUTIONS:
            crossed, count = joined(sought.crossed, missed), sought.crossings + 1
            return self._looked(equations, replace(sought, crossed=crossed, crossings=count))
        if not self._turns(equations) or sought.midpoints == MIDPOINT_SOLUTIONS:
            return None
        given = solved, equations.state, result.state, sought.midpoint
        half = self.contact.momentum.midpoint(*given)
        if half is None:
            return None
        return replace(sought, midpoint=half, midpoints=sought.midpoints + 1)

    def _looked(self, equations: Equations, sought: Sought) -> Sought:
        """Return what was sought with contacts found anew."""
        given = equations.state, sought.reach, equations.step, sought.crossed
        return replace(sought, contacts=self.candidates(*given), midpoint=sought.ahead)

    def _turns(self, equations: Equations) -> bool:
        """Whether bodies turn in a step in time."""
        return equations.step is not None and self._mover.kinematics.turns

    def _ahead(
        self, equations: Equations, contacts: "ContactPoints", momentum: "Momentum"
    ) -> State | None:
        """Return where bodies are half way if they go on turning; None where they hardly turn.

        It goes by the state alone, so that a run that is resumed foresees the same.
        """
        state, step = equations.state, equations.step
        if step is None or not self._turns(equations):
            return None
        flight, half = step * state.velocity, 0.5 * step**2
        way = momentum.foreseen(contacts, flight, state.acceleration, half)
        if way is None:
            return None
        return middle(state, self._mover.moved(state, way))

    def along(self, equations: Equations, path: "PathEquation", reach: float) -> Attempt:
        """Solve a step of statics whose load factor is found with the unknowns.

        Contacts are sought up to ``reach`` (m) at first. The equations are of the load factor that
        the step begins with.

        Raises
        ------
        SolveError
            Where nothing holds a part.
        """
        from nmm.contact.following.path_solution import path_solution

        state, still, contact = equations.state, equations.end, self.contact
        request = StepRequest(equations.matrix, equations.force, self.solver, time=still.time)
        given, joints = (state, request, path), contact.record.book.points
        for _ in range(PATH_SOLUTIONS):
            contacts = self.candidates(state, reach, None)
            solved, change = path_solution(contact.steps, contacts, *given, joints)
            end = Instant(still.time, still.load_factor + change)
            result = self._mover.after(replace(equations, end=end), solved.answer.increment)
            if result.motion <= reach or not solved.answer.verdict.converged:
                break
            reach = FURTHER * result.motion
        verdict = solved.answer.verdict
        return result.told(verdict.converged, verdict.sentence, solved, solved.passes)

    def _why(self, solution: str, result: Attempt, solved: "ContactSolution") -> str:
        """Say why a solution is no step, though it be one of its equations."""
        if solved.stopped:
            return "a bond cannot hold: the increment is cut before it breaks"
        if solved.answer.verdict.converged and result.motion > self._size:
            return f"points move by {result.motion:.3g} m, further than the domain is large"
        return solution

    def candidates(
        self, state: State, reach: float, step: float | None, crossed: "Crossed | None" = None
    ) -> "ContactPoints":
        """Return the contact points of a step in which no point moves further than ``reach``."""
        with self._clock.phase("search"):
            return self.contact.candidates(state, reach, step, crossed)

    @property
    def contact(self) -> "Contact":
        """The contact effect."""
        contact = self._current.plan.contact
        assert contact is not None
        return contact

    def _conditions(self, equations: Equations) -> "NullSpace | None":
        """Return the conditions of supports by multipliers."""
        border = self._current.plan.border(equations.state, equations.end)
        if border is None:
            return None
        from nmm.contact.enforcement.null_space import NullSpace

        self._held = NullSpace.of(*border, self._held)
        return self._held

    def _solve(
        self,
        equations: Equations,
        sought: Sought,
        breaking: "Breaking",
        held: "NullSpace | None",
        foreseen: Attempt | None,
    ) -> "ContactSolution":
        def near(increment: Floats) -> bool:
            return self._mover.after(equations, increment).motion <= sought.reach

        request = StepRequest(
            matrix=equations.matrix,
            force=equations.force,
            solver=self.solver,
            step=equations.step,
            weight=1.0 if equations.step is None else equations.rule.contact_weight,
            null_space=held,
            breaking=breaking,
            near=near,
            time=equations.end.time,
            foreseen=None if foreseen is None else foreseen.increment,
            among=equations.among,
        )
        end = None if foreseen is None else foreseen.state
        with self._clock.phase("solve"):
            given = sought.contacts, equations.state, request, sought.midpoint
            return self.contact.steps.solve(*given, end)

    def _near(self, equations: Equations, foreseen: Attempt | None) -> Attempt | None:
        """Return what is foreseen of a step in time of bodies that bend by any angle; else None."""
        bends = self._mover.kinematics.finite and self.contact.geometry.conserves
        if equations.step is None or not bends:
            return None
        still = np.zeros(len(equations.force))
        return foreseen or Attempt(True, "", equations.state, still, 0.0, 0.0, 0)

    def _missed(self, state: State, solved: "ContactSolution", end: State) -> Floats:
        """Return the contact forces (n,) at the end that was found beyond those of a solution."""
        assert solved.rows is not None
        rows = self.contact.geometry.conserving(solved.contacts, state, end)
        normal, shear = solved.answer.normal_force, solved.answer.shear_force
        whole = normal if solved.missed is None else normal + solved.missed
        return rows.push(whole, shear) - solved.push

    def _judged(
        self, equations: Equations, solved: "ContactSolution", held: "NullSpace | None"
    ) -> tuple[Attempt, Floats]:
        """Return the bodies moved, and what contact takes of the forces (n,)."""
        increment = solved.answer.increment
        rest = equations.force - product(equations.matrix, increment)
        multipliers = solved.answer.multipliers
        if held is not None and multipliers is not None and solved.rows is not None:
            self._current.plan.keep(multipliers)
            rest = rest - held.rows.T @ multipliers
        push = -rest if self._carries and equations.step else None
        return self._mover.after(equations, increment, push), rest

    def _kept(
        self, equations: Equations, solved: "ContactSolution", result: Attempt, rest: Floats
    ) -> Attempt:
        """Return the attempt with the velocity that keeps momentum and angular momentum."""
        assert equations.step is not None
        state = result.state
        change = self.contact.momentum.kept(solved, equations.state, state, equations.step, rest)
        return with_parts(result, state=with_parts(state, velocity=state.velocity + change))
