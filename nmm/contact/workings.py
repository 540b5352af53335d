"""What seeks the contacts of a model and solves them, made in the first step that asks for it."""

from functools import cached_property
from typing import TYPE_CHECKING

from nmm.assembly.model import Model
from nmm.contact.parts import ContactParts
from nmm.contact.points.contact_points import ContactPoints
from nmm.contact.solution.step_bonds import StepBonds

if TYPE_CHECKING:
    from nmm.contact.candidates.candidates import Candidates
    from nmm.contact.solution.driver import ContactSolver
    from nmm.contact.solution.geometry import ContactGeometry
    from nmm.contact.solution.momentum import Momentum
    from nmm.contact.solution.steps import ContactSteps


class ContactWorkings:
    """What works on the contacts of a model.

    Attributes
    ----------
    model
        What is in contact.
    laws, partners
        Which laws act, and which points may meet.
    exact
        Whether nothing penetrates, so that speeds jump at an impact.
    bonds
        Those that consistent terms hold.
    geometry, momentum, solver
        Rows of contact points, what keeps momentum, and the solver of a problem.
    steps
        What puts the problem of a step together and solves it.
    """

    def __init__(
        self, model: Model, parts: ContactParts, bonds: StepBonds, joints: ContactPoints
    ) -> None:
        self.model, self.bonds = model, bonds
        self.laws, self.partners, self.exact = parts.laws, parts.partners, parts.enforcement.exact
        self._parts, self._joints = parts, joints

    @cached_property
    def geometry(self) -> "ContactGeometry":
        """Rows of contact points."""
        from nmm.contact.solution.geometry import ContactGeometry

        bends, traces = self._parts.bends, self._parts.trace_space
        return ContactGeometry(self.model, self.partners.sides, self._joints, bends, traces)

    @cached_property
    def _candidates(self) -> "Candidates":
        """What seeks the contact points of a step."""
        from nmm.contact.candidates.candidates import Candidates

        ways = self._parts.keeps_energy, self._parts.enforcement.ahead
        return Candidates(self.partners, self.laws, self.geometry, *ways)

    @cached_property
    def momentum(self) -> "Momentum":
        """Inertia of the bodies as contact needs it."""
        from nmm.contact.solution.momentum import Momentum

        geometry, model = self.geometry, self.model
        # Exact forces among dependent functions are not always found when a step is solved again.
        on_meshes = geometry.joined or (self.exact and bool(model.manifold.dependent))
        from_start = geometry.curved if model.of_blocks else on_meshes
        return Momentum(self.model, self.partners.sides, self._parts.held, from_start)

    @cached_property
    def solver(self) -> "ContactSolver":
        """What solves the contacts of a step."""
        from nmm.contact.solution.driver import ContactSolver

        enforcement, compliance = self._parts.enforcement, self.momentum.compliance
        return ContactSolver(self.model, self.laws, enforcement, compliance)

    @cached_property
    def steps(self) -> "ContactSteps":
        """What puts the problem of a step together."""
        from nmm.contact.solution.steps import ContactSteps

        surface = self.partners.surface
        return ContactSteps(self.laws, self.geometry, self.bonds, self.solver, surface)
