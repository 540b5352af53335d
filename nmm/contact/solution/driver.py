"""The contact problem of one step: set up, solved, repeated until the interface laws agree.

Limits, springs and lifted faces are fixed during one solution. Between two solutions the laws
update their history (`nmm.contact.laws.history_iteration`), and overloaded bonds break.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial

import numpy as np
from scipy.sparse import csc_array

from integration.arrays import Floats
from integration.contraction import largest, some
from nmm.assembly.model import Model
from nmm.contact.bonds.release import given_way, lost_energy
from nmm.contact.enforcement.base import Enforcement
from nmm.contact.enforcement.rebalanced import solve_rebalanced
from nmm.contact.laws.contact_laws import ContactLaws
from nmm.contact.laws.dashpots import RigidMass
from nmm.contact.laws.failing_bonds import breaking
from nmm.contact.laws.history_iteration import HistoryIteration
from nmm.contact.points.contact_points import ContactPoints
from nmm.contact.points.contact_rows import ContactRows
from nmm.contact.points.joint_book import not_pressed
from nmm.contact.problem.coulomb import shear_bound, turned_back
from nmm.contact.problem.step_problem import SLIDE, StepAnswer, StepProblem
from nmm.contact.problem.transform import Transform, solve_through
from nmm.contact.solution.agreed import Agreed
from nmm.contact.solution.posed_step import Posing
from nmm.contact.solution.record import BrokenBonds, ContactSolution
from nmm.contact.solution.request import StepRequest
from nmm.contact.solution.untouched import StepsWithoutContacts
from nmm.errors import SolveError
from nmm.solvers.linear import LinearSolver
from nmm.solvers.unchecked import product


class ContactSolver:
    """Solves the contacts of the steps of a run.

    Attributes
    ----------
    memory
        Factors, patterns and starts that are kept between solutions; see `Memory`.
    untouched
        Solves steps without contact points.
    last
        The problem that the enforcement solved last, and its answer; None after a step without
        contact points.

    Parameters
    ----------
    model, laws
        What is in contact, and by which laws.
    enforcement
        Solves the problem.
    compliance
        (3 B,) of the bodies as a whole.
    """

    def __init__(
        self, model: Model, laws: ContactLaws, enforcement: Enforcement, compliance: Floats
    ) -> None:
        manifold = model.manifold
        mass = RigidMass(manifold.boundary.body, manifold.rigid_modes, compliance)
        softness = model.modulus[manifold.boundary.element] / model.modulus.max()
        self.memory = enforcement.memory()
        self.last: tuple[StepProblem, StepAnswer] | None = None
        self.untouched = StepsWithoutContacts()
        self._laws, self._posing = laws, Posing(laws, softness, mass, enforcement.exact)
        self._enforcement, self._unknown_body = enforcement, manifold.unknown_body
        self._edge_body = manifold.boundary.body

    def forget(self) -> None:
        """Drop what is kept for speed alone, and the last problem with its answer."""
        self.memory.forget_all()
        self.untouched.forget()
        self.last = None

    def alone(self, contacts: ContactPoints, request: StepRequest) -> ContactSolution | None:
        """Solve a step in time without contact points; return None where there are any."""
        if contacts.gap.size or request.step is None or request.null_space is not None:
            return None
        self.last = None
        return self.untouched.solve(contacts, request)

    def solve(
        self,
        contacts: ContactPoints,
        rows: ContactRows,
        request: StepRequest,
        more: Callable[[ContactPoints], Sequence[Transform]] = lambda contacts: (),
    ) -> ContactSolution:
        """Solve a step; overloaded bonds break and the step is solved again.

        ``more`` returns further transforms: whole bonds, averages over faces, constraints.
        """
        self.memory.moving = request.step is not None
        passes, gone, besides = 0, request.broken, more(contacts)
        loss, opened = (0.0, contacts.key[:0]) if gone is None else (gone.loss, gone.opened)
        while True:
            agreed = self._agreed(contacts, rows, request, besides)
            answer, iteration = agreed.answer, agreed.iteration
            passes += agreed.passes
            found = ContactSolution(iteration.contacts, answer, passes, loss, broken=gone)
            if not answer.verdict.converged:
                return found
            broken = breaking(self._laws, iteration.contacts, answer, request.breaking == "worst")
            brittle = broken & self._laws.brittle[contacts.interface]
            if not some(broken):
                body = self._edge_body if request.step is None else None
                return agreed.told(found, contacts, rows, body)
            if request.near is not None and not request.near(answer.increment):
                return found
            if request.breaking == "stop" and brittle.any():
                return replace(found, stopped=True)
            freed = broken & contacts.tied
            # In statics bonds break at the load of the answer; in time a step goes without them.
            loaded = answer if request.step is None else contacts
            loss += lost_energy(agreed.posed.problem, loaded, brittle, contacts)
            springs, limits = iteration.springs, iteration.response.limits
            overloaded = broken, brittle
            contacts, stored = given_way(self._laws, contacts, overloaded, loaded, springs, limits)
            loss += stored
            opened = np.union1d(opened, not_pressed(contacts, broken, loaded.normal_force))
            gone = BrokenBonds(contacts, loss, opened)
            if request.uncovers is not None and request.uncovers(gone):
                return replace(found, broken=gone, uncovered=True)
            besides = more(contacts) if freed.any() else besides

    def _agreed(
        self,
        contacts: ContactPoints,
        rows: ContactRows,
        request: StepRequest,
        besides: Sequence[Transform],
    ) -> Agreed:
        """Repeat until the history agrees with the solution it was used for, or none is found."""
        iteration, passes = HistoryIteration(self._laws, contacts), 0
        start: Floats | None = None
        while True:
            posed = self._posing.posed(iteration, rows, request, besides, start)
            enforced = partial(self._enforced, posed.transforms, request.solver)
            answer = solve_through(posed.transforms, posed.problem, enforced)
            passes += answer.passes
            sliding = posed.slid(answer, iteration.softening, contacts.slid)
            if answer.verdict.converged:
                fault = iteration.settled(answer, sliding)
                answer = answer if fault is None else replace(answer, verdict=fault)
            if iteration.done or not answer.verdict.converged:
                return Agreed(iteration, posed, answer, sliding, passes)
            start = answer.increment

    def acting(self, back: Floats | None = None) -> csc_array | None:
        """Return the matrix of the last system with the springs that acted in it.

        Contacts that slid stick where the motion ``back`` (n,) would turn them back.
        """
        if self.last is None:
            return self.untouched.matrix
        problem, answer = self.last
        closed = answer.normal_force != 0
        bound = shear_bound(answer.normal_force, closed, problem.limits)
        slid = answer.state == SLIDE
        sticks = closed & (bound > 0) & (~slid | turned_back(problem, answer, back))
        normal = np.where(closed, problem.normal_stiffness, 0.0)
        shear = np.where(sticks, problem.shear_stiffness, 0.0)
        return self.memory.pattern_of(problem).matrix(problem, normal, shear)

    def unbalanced(self) -> Floats | None:
        """Return the force (n,) that the last solution left out of balance; None without one."""
        if self.last is None:
            return None
        problem, answer = self.last
        carried = problem.pushed(answer.normal_force, answer.shear_force)
        return problem.force - product(problem.matrix, answer.increment) - carried

    def condition(self, solver: LinearSolver) -> float | None:
        """Estimate the condition number of the last system with the springs that acted in it."""
        if self.last is None and self.untouched.factor is not None:
            return self.untouched.factor.condition()
        matrix = self.acting()
        try:
            return None if matrix is None else solver.factorise(matrix).condition()
        except SolveError:
            return None

    @property
    def stiffest(self) -> float | None:
        """Largest stiffness (N/m) of a contact that pressed in the last step, None without any."""
        if self.last is None or self._enforcement.exact:
            return None
        problem, answer = self.last
        pressed = answer.normal_force < 0
        return float(largest(problem.normal_stiffness[pressed])) if some(pressed) else None

    def _enforced(
        self, transforms: list[Transform], solver: LinearSolver, problem: StepProblem
    ) -> StepAnswer:
        """Return the answer to a problem after all transforms."""
        # A search with a larger reach may find the same contacts: the problem is the same then.
        answer = self.memory.known(problem)
        if answer is None:
            started = self.memory.started(problem)
            body = self._unknown_body
            for transform in transforms:
                body = transform.of_unknowns(body)
            answer = solve_rebalanced(self._enforcement, started, solver, self.memory, body)
        self.memory.answered = self.last = problem, answer
        return answer
