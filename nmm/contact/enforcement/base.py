"""What a contact enforcement is, and the names of the built-in ones."""

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any, ClassVar

from nmm.registry import Registry

if TYPE_CHECKING:
    from nmm.contact.iteration.memory import Memory
    from nmm.contact.problem.step_problem import StepAnswer, StepProblem
    from nmm.solvers.linear import LinearSolver


@dataclass(frozen=True)
class Enforcement(ABC):
    """Base of contact enforcements; a frozen set of options.

    Attributes
    ----------
    name
        Its name in files.
    multipliers
        Whether forces are whatever exact conditions need: on faces of meshes these are then held
        in the mean (`nmm.contact.mortar.face_means`).
    exact
        Whether penalties, stiffnesses that are not a joint's own, are replaced by conditions that
        store no energy; where not, contacts are springs of that stiffness.
    ahead
        Whether contacts push before their sides touch.
    """

    name: ClassVar[str]
    multipliers: ClassVar[bool] = False
    exact: ClassVar[bool] = True
    ahead: ClassVar[bool] = False

    def memory(self) -> "Memory":
        """Return an empty memory for the steps of a run, which keeps as much as options say."""
        from nmm.contact.iteration.memory import Memory

        return Memory()

    @abstractmethod
    def solve(
        self, problem: "StepProblem", linear_solver: "LinearSolver", memory: "Memory | None" = None
    ) -> "StepAnswer":
        """Find unknowns and contact forces of one step.

        Parameters
        ----------
        problem
            The step.
        linear_solver
            Factorises the matrices.
        memory
            What may be kept from step to step (patterns, factors); made once by the step loop and
            handed to every call. It changes the cost, not the answer beyond the tolerance.

        Returns
        -------
        StepAnswer
            Its verdict says whether the forces may be used.

        Raises
        ------
        SolveError
            When the problem itself is malformed (shapes, numbers that are not finite).
        """


ENFORCEMENTS: Registry[type[Enforcement]] = Registry(
    "enforcement",
    Enforcement,
    {
        "penalty": "nmm.contact.enforcement.penalty:Penalty",
        "augmented": "nmm.contact.enforcement.augmented:Augmented",
        "lagrange": "nmm.contact.enforcement.lagrange:Lagrange",
        "cone": "nmm.contact.enforcement.cone:Cone",
        "barrier": "nmm.contact.enforcement.barrier:Barrier",
    },
)


def make_enforcement(
    name: str, options: Mapping[str, Any] | None = None, given: Mapping[str, Any] | None = None
) -> Enforcement:
    """Return the enforcement ``name`` ("penalty", ... or "module:Class") with ``options`` set.

    What is ``given`` besides holds for enforcements that have an option of that name.

    Raises
    ------
    FormulationError
        When the name or an option is not known.
    """
    known = {item.name for item in fields(ENFORCEMENTS.load(name))}
    more = {key: value for key, value in (given or {}).items() if key in known}
    made: Enforcement = ENFORCEMENTS.make(name, more | dict(options or {}))
    return made
