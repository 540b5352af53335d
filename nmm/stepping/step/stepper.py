"""Accepted steps: what is carried from one to the next, and how changes are followed."""

from dataclasses import replace
from typing import TYPE_CHECKING

from integration.arrays import Floats
from nmm.assembly.moving.kinematics import Kinematics
from nmm.assembly.state import State
from nmm.effects.base import Instant
from nmm.integrators.base import Integrator
from nmm.integrators.starting import rule_of
from nmm.model.build import reshaped
from nmm.model.discretisation import Discretisation
from nmm.model.solver_settings import solver_of_run
from nmm.solvers.linear import LinearSolver
from nmm.stepping.step.budget import Budget
from nmm.stepping.step.carried import CarriedState, LaidAnew
from nmm.stepping.step.present import PresentModel
from nmm.stepping.step.remap import Lay, laid_as, laid_here
from nmm.stepping.step.trial import Attempt

if TYPE_CHECKING:
    from nmm.contact.points.contact_points import ContactPoints
    from nmm.contact.solution.record import Breaking, BrokenBonds, ContactRecord
    from nmm.controls.path_equation import PathEquation
    from nmm.effects.change import Change
    from nmm.geometry.geometry import Geometry


class Stepper(PresentModel):
    """Takes the steps of a run: nothing of a trial step is kept unless it is accepted.

    Attributes
    ----------
    budget
        What the run may cost.
    """

    def __init__(
        self,
        discretisation: Discretisation,
        integrator: Integrator,
        solver: LinearSolver,
        kinematics: Kinematics,
        lay: Lay | None = None,
    ) -> None:
        self._among = discretisation.plan.contact is not None
        self._integrator = self._ruling(integrator)
        super().__init__(discretisation, solver, kinematics, self._integrator.carries)
        self.budget, self._lay = Budget(), lay
        self._geometry: Geometry | None = None
        self._carried = CarriedState(self._steps.reach())

    def _ruling(self, integrator: Integrator) -> Integrator:
        return integrator.among_contacts if self._among else integrator

    @property
    def carried(self) -> CarriedState:
        """All that is carried from accepted step to accepted step besides the bodies' state."""
        laid, stress = None, self.plan.initial_stress
        if self._lay is not None and stress is not None:
            laid = LaidAnew(self.model.manifold.elements.points, stress.stress)
        effects = self.plan.carried()
        return replace(self._carried, laid=laid, geometry=self._geometry, effects=effects)

    def carry(self, carried: CarriedState) -> None:
        """Continue from what was carried in another run, without what was kept here."""
        if carried.geometry is not None and self._geometry is None:
            self.reshape(carried.geometry, self.discretisation.setup.start)
        self._carried = replace(carried, laid=None, geometry=None, effects={})
        if self._lay is not None and carried.laid is not None:
            self._relaid(*laid_as(self.discretisation, self._lay, carried.laid))
        self.plan.carry(carried.effects)
        self.forget()

    def return_to(self, carried: CarriedState) -> None:
        """Return to the accepted step of `carried`; what is kept for speed stays."""
        self._carried = replace(carried, laid=None, geometry=None, effects={})
        self.plan.carry(carried.effects)
        if self.plan.contact is not None:
            self.plan.contact.restore(self.plan.contact.record)

    def forget(self) -> None:
        """Drop the workspace: factors, patterns, lists and starts that are kept for speed alone."""
        self._steps.forget()
        self.plan.forget()

    @property
    def integrator(self) -> Integrator:
        """The time integrator."""
        return self._integrator

    @property
    def anchored(self) -> bool:
        """Whether soft springs hold bodies in statics to where they stand (`anchors`)."""
        return self._carried.anchored

    @anchored.setter
    def anchored(self, anchored: bool) -> None:
        self._carried = replace(self._carried, anchored=anchored)

    @property
    def geometry(self) -> "Geometry | None":
        """Blocks and cracks, where an event has changed those with which scene or stage began."""
        return self._geometry

    def attempt(
        self,
        state: State,
        end: Instant,
        step: float | None,
        breaking: "Breaking" = "all",
        broken: "BrokenBonds | None" = None,
    ) -> Attempt:
        """Solve the step from ``state`` to ``end``; ``step`` is its length (s); None is statics.

        ``broken`` are bonds that broke in an attempt of it before.

        Raises
        ------
        BudgetSpentError
            When the run may cost no more.
        """
        self.budget.check()
        given = self._rule, self._carried, breaking, broken
        return self._steps.attempt(state, end, step, *given)

    def along(self, state: State, path: "PathEquation") -> Attempt:
        """Solve a step of statics along a path (`nmm.contact.following`).

        Raises
        ------
        BudgetSpentError
            When the run may cost no more.
        """
        self.budget.check()
        return self._steps.along(state, path, self._rule, self._carried.reach)

    def losing(self, state: State) -> Floats:
        """Return the energy (n,) by unknown (J) that bonds at their limit lose from a state on."""
        return self._steps.losing(state, self._rule, self._carried.reach)

    def accept(self, attempt: Attempt) -> tuple[State, "ContactPoints | None"]:
        """Accept a trial step as the start of the next one; return it with its final contacts."""
        reach, restarts = self._steps.reach(attempt.motion), self._integrator.restarts_at_impact
        self._carried = self._carried.after(attempt, reach, restarts)
        plan, state, contacts = self._current.plan, attempt.state, None
        if plan.contact is not None and attempt.solved is not None:
            contacts = plan.contact.commit(attempt.solved, state)
        plan.accepted(state)
        if self._lay is not None:
            place, increment = self.place(state), attempt.increment
            state = self._relaid(
                *laid_here(self.discretisation, self._lay, state, increment, place)
            )
        return state, contacts

    def carried_way(self, state: State, end: Instant) -> float:
        """Return how far (m) driven ground carries a body that may touch in a step, at most."""
        return self._steps.carried_way(state, end)

    def correct(self, attempt: Attempt, start: State) -> bool:
        """Let the next attempt correct the step from ``start`` of which one was accepted.

        Return whether its friction is that of the whole step.
        """
        laid_anew = self._lay is not None  # contacts go on as those of another model
        if self.plan.contact is None or attempt.solved is None or laid_anew:
            return False
        self.plan.contact.correct(attempt.solved, start)
        return True

    def _relaid(self, change: "Change", new: Discretisation) -> State:
        """Solve blocks laid anew; places still count from where the run began."""
        start = self.reference
        self.follow(change, new)
        self.reference = start
        return change.state

    def follow(self, change: "Change", new: Discretisation) -> None:
        """Continue on the ``new`` discretisation after a change."""
        self._current.become(new)
        self.reference = change.new.manifold.elements.points
        self._steps.follow(change)

    def reshape(self, geometry: "Geometry", state: State, held: bool = False) -> "Change":
        """Solve the same blocks in another geometry; ``state`` is carried over to it.

        ``held`` says whether accelerations go on as they were (`nmm.effects.event.Event`).
        """
        with self.clock.phase("change"):
            old = self.discretisation
            change = old.change(reshaped(old.setup, geometry), state)
            # Rules that carry no acceleration need none after a jump of it.
            goes_on = held or not self._integrator.carries
            known = goes_on and self._carried.knows_start
            self.begin_anew(change)
            self._carried = replace(self._carried, knows_start=known)
            self._geometry = geometry
        return change

    def begin_anew(self, change: "Change", integrator: Integrator | None = None) -> None:
        """Continue on the discretisation after a change, with other unknowns.

        The next step is a first one: no acceleration is known, and nothing is kept for speed.
        ``integrator`` is another one if the change asks for it.
        """
        with self.clock.phase("effects"):
            new = self.discretisation.after(change)
        self.follow(change, new)
        contact = self.plan.contact is not None
        solver = solver_of_run(change.setup, change.new.manifold, contact)
        if integrator is not None:
            self._integrator = self._ruling(integrator)
        self.solver = solver
        self._steps.solve_by(solver)
        self.size = max(self.size, change.new.manifold.elements.extent)
        self._geometry = None
        self._carried = CarriedState(self._carried.reach)
        self.forget()

    def remember(self) -> "ContactRecord | None":
        """Return the present record of contact, for `restore`."""
        return None if self.plan.contact is None else self.plan.contact.record

    def restore(self, record: "ContactRecord | None") -> None:
        """Take back what was accepted since `remember`."""
        if self.plan.contact is not None and record is not None:
            self.plan.contact.restore(record)

    @property
    def _rule(self) -> Integrator:
        """The integrator of the step."""
        return rule_of(self._integrator, self._carried.knows_start)
