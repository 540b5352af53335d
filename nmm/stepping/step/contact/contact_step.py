"""A step with contact: solved, and judged by how far bodies moved."""

from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Floats
from nmm.assembly.state import State
from nmm.contact.solution.request import StepRequest
from nmm.frozen import with_parts
from nmm.model.discretisation import CurrentDiscretisation
from nmm.solvers.linear import LinearSolver
from nmm.solvers.unchecked import product
from nmm.stepping.step.clock import Clock
from nmm.stepping.step.contact.contact_search import ContactSearch, SoughtContacts
from nmm.stepping.step.linear.equations import Equations, spinning
from nmm.stepping.step.mover import Mover
from nmm.stepping.step.trial import Attempt

if TYPE_CHECKING:
    from nmm.contact.enforcement.null_space import NullSpace
    from nmm.contact.solution.record import Breaking, BrokenBonds, ContactSolution
    from nmm.stepping.step.contact.contact_path import PathSteps


class ContactStepSolver:
    """Solves steps with contact.

    Parameters
    ----------
    size
        Diagonal of the domain (m): a step that moves further has not converged.
    carries
        Whether accelerations count (`Integrator.carries`).

    Attributes
    ----------
    search
        Seeks the contacts.
    """

    def __init__(
        self,
        current: CurrentDiscretisation,
        mover: Mover,
        solver: LinearSolver,
        size: float,
        carries: bool,
        clock: Clock,
    ) -> None:
        self._current, self._mover, self.solver, self._clock = current, mover, solver, clock
        self._size, self._carries = size, carries
        self.search = ContactSearch(current, mover, size, clock)
        self._held: NullSpace | None = None
        self._paths: PathSteps | None = None

    def forget(self) -> None:
        """Drop what is kept for speed alone, and of one model: the conditions of supports."""
        self._held = self._paths = None
        self.search.forget()

    def attempt(
        self,
        equations: Equations,
        breaking: "Breaking",
        broken: "BrokenBonds | None",
        reach: float,
        foreseen: Attempt | None = None,
    ) -> tuple[Equations, Attempt]:
        """Solve a step; ``breaking`` says which bonds break at a time, beside those ``broken``.

        Contacts are sought up to ``reach`` (m) at first. Those of bodies that bend by any angle act
        between where the step begins and where it was ``foreseen`` to end.

        Returns
        -------
        The last equations, with the spins that were found, and their solution.

        Raises
        ------
        SolveError
            Where the load moves a part that nothing holds.
        """
        state, partners = equations.state, self.search.contact.partners
        near, passes = self._near(equations, foreseen), 0
        again = foreseen is not None and near is None
        sought = self.search.first(equations, reach, again, broken)
        held = self._conditions(equations)
        while True:
            solved = self._solve(equations, sought, breaking, held, near)
            passes += solved.passes
            verdict, motion = solved.answer.verdict, None
            result, rest = self._judged(equations, solved, held)
            good = verdict.converged and result.motion <= self._size and not solved.stopped
            if good and result.motion <= sought.reach:
                motion = partners.motion(state, result.state)
            given = equations, sought, solved, result, motion
            if good:
                further = self.search.again(*given)
            else:
                stuck = not (verdict.converged or solved.stopped)
                further = self.search.held_back(equations, sought) if stuck else None
            if further is None:
                break
            sought = further
            if sought.contacts.gap.size:  # in flight as without contact
                equations = self._spinning(equations, result.state)
        self.search.keep(state, sought)
        if good and solved.rows is not None:
            result = self._completed(equations, solved, result, rest, near is not None)
        passage = "" if motion is None else partners.passage(motion, sought.contacts)
        sentence = passage or self._why(verdict.sentence, result, solved)
        return equations, result.told(good and not passage, sentence, solved, passes)

    def _spinning(self, equations: Equations, end: State) -> Equations:
        """Return equations of a step in time with the spins that were found at its ``end``."""
        inertia = self._current.plan.inertia
        return equations if inertia is None else spinning(equations, inertia, end)

    @property
    def paths(self) -> "PathSteps":
        """What solves steps of statics along paths; made for the first one."""
        from nmm.stepping.step.contact.contact_path import PathSteps

        self._paths = self._paths or PathSteps(self.search, self._mover, self.solver)
        return self._paths

    def _why(self, solution: str, result: Attempt, solved: "ContactSolution") -> str:
        """Return why a solution of the equations is not accepted as a step."""
        if solved.stopped:
            return "a bond cannot hold: the increment is cut before it breaks"
        if solved.answer.verdict.converged and result.motion > self._size:
            return f"points move by {result.motion:.3g} m, further than the domain is large"
        return solution

    def _conditions(self, equations: Equations) -> "NullSpace | None":
        """Return the conditions of supports by multipliers."""
        border = self._current.plan.border(equations.origin, equations.end)
        if border is None:
            return None
        from nmm.contact.enforcement.null_space import NullSpace

        self._held = NullSpace.of(*border, self._held)
        return self._held

    def _solve(
        self,
        equations: Equations,
        sought: SoughtContacts,
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
            broken=sought.broken,
            uncovers=partial(self.search.contact.uncovers, sought.broken),
            time=equations.end.time,
            foreseen=None if foreseen is None else foreseen.increment,
            among=equations.among,
            carried=None if equations.carriage is None else equations.carriage.way,
        )
        end = None if foreseen is None else foreseen.state
        with self._clock.phase("solve"):
            given = sought.contacts, equations.state, request, sought.midpoint, sought.forces
            return self.search.contact.steps.solve(*given, end)

    def _near(self, equations: Equations, foreseen: Attempt | None) -> Attempt | None:
        """Return the predicted end of a step in time under finite strain; else None."""
        bends = self._mover.kinematics.finite and self.search.contact.geometry.conserves
        if equations.step is None or not bends:
            return None
        still = np.zeros(len(equations.force))
        return foreseen or Attempt(True, "", equations.state, still, 0.0, 0.0, 0)

    def _missed(self, state: State, solved: "ContactSolution", end: State) -> Floats:
        """Return the contact forces (n,) at the end that was found beyond those of a solution."""
        assert solved.rows is not None
        rows = self.search.contact.geometry.conserving(solved.contacts, state, end)
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

    def _completed(
        self,
        equations: Equations,
        solved: "ContactSolution",
        result: Attempt,
        rest: Floats,
        foreseen: bool,
    ) -> Attempt:
        """Return the attempt with the velocity that keeps momentum and angular momentum.

        Where its end was ``foreseen`` it has the difference of the forces at the end.
        """
        begin, state = equations.state, result.state
        if self.search.turns(equations):
            assert equations.step is not None
            momentum = self.search.contact.momentum
            change = momentum.kept(solved, begin, state, equations.step, rest)
            result = with_parts(result, state=with_parts(state, velocity=state.velocity + change))
        if not foreseen:
            return result
        return with_parts(result, missed=self._missed(begin, solved, result.state))
