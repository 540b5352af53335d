"""What is solved at present: the model with its effects, and where its bodies are."""

from typing import TYPE_CHECKING

from integration.arrays import Floats
from nmm.assembly.material_points import MaterialPoints
from nmm.assembly.moving.kinematics import Kinematics
from nmm.assembly.state import State
from nmm.model.discretisation import CurrentDiscretisation, Discretisation
from nmm.solvers.linear import Factor, LinearSolver
from nmm.stepping.step.clock import Clock
from nmm.stepping.step.linear.linear_system import LinearSystem
from nmm.stepping.step.mover import Mover
from nmm.stepping.step.step_solver import StepSolver

if TYPE_CHECKING:
    from nmm.assembly.model import Model
    from nmm.contact.points.contact_points import ContactPoints
    from nmm.model.planning.plan import Plan


class PresentModel:
    """The present model of a run, and what is known of its last system.

    Attributes
    ----------
    solver, kinematics
        The linear solver, and how bodies move.
    reference
        (P, 2) the elements' vertices at the start (m).
    size
        Diagonal of the domain (m).
    clock, seconds
        Wall-clock seconds by phase.
    """

    def __init__(
        self,
        discretisation: Discretisation,
        solver: LinearSolver,
        kinematics: Kinematics,
        carries: bool,
    ) -> None:
        self.solver, self.kinematics, self.clock = solver, kinematics, Clock()
        self.seconds = self.clock.seconds
        self.reference = discretisation.model.manifold.elements.points
        self.size = discretisation.model.manifold.elements.extent
        current = self._current = CurrentDiscretisation(discretisation)
        self._mover = Mover(current, solver, kinematics, self.clock)
        self._system = LinearSystem(current, solver, kinematics.small)
        given = self._mover, self._system, self.size, carries, self.clock
        self._steps = StepSolver(current, *given)

    @property
    def small(self) -> bool:
        """Whether displacements are small."""
        return self.kinematics.small

    @property
    def discretisation(self) -> Discretisation:
        """What is solved now."""
        return self._current.discretisation

    @property
    def model(self) -> "Model":
        """Its model."""
        return self._current.model

    @property
    def plan(self) -> "Plan":
        """The effects on it."""
        return self._current.plan

    @property
    def vertices(self) -> MaterialPoints:
        """The elements' vertices, which are followed."""
        return self._mover.vertices

    @property
    def factor(self) -> Factor | None:
        """The last factor of a system without contacts."""
        return self._system.factor

    def candidates(self, state: State, reach: float, step: float | None) -> "ContactPoints":
        """Return the contact points of a step in which no point moves further than ``reach``."""
        return self._steps.candidates(state, reach, step)

    @property
    def broken_bonds(self) -> int:
        """Number of joint points whose bond is broken."""
        return 0 if self.plan.contact is None else self.plan.contact.broken_bonds

    def place(self, state: State) -> Floats:
        """Return where the elements' vertices are (P, 2)."""
        return self._mover.place(state)

    def velocity(self, state: State) -> Floats:
        """Return how fast the elements' vertices are (P, 2)."""
        inertia = self.plan.inertia
        return self.vertices.velocity(state, None if inertia is None else inertia.turning(state))

    def condition(self) -> float | None:
        """Estimate the condition number of the last system, springs of contact included."""
        if self.factor is not None:
            return self.factor.condition()
        contact = self.plan.contact
        return None if contact is None else contact.solver.condition(self.solver)

    def rounding_changes(self) -> list[Floats]:
        """Changes (n,) that rounding may have made of the last static step without contact."""
        return self._system.rounding_changes()
