"""Penalty springs and Shi's open-close iteration."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from nmm.contact.enforcement.iterative import IterativeEnforcement
from nmm.errors import FormulationError
from nmm.registry import above_zero

if TYPE_CHECKING:
    from nmm.contact.iteration.memory import Memory
    from nmm.contact.problem.step_problem import StepAnswer, StepProblem
    from nmm.solvers.linear import LinearSolver


@dataclass(frozen=True)
class Penalty(IterativeEnforcement):
    """Springs at closed contacts, states found by open-close iteration (Shi 1988).

    A pass solves the linear system of the present states: a normal spring at closed contacts, a
    shear spring where they stick, and where they slide a friction force taken from the normal
    force of the pass before. Passes end when no state changes and the step is in balance with the
    friction of its own normal forces. Penetration is force over stiffness.

    Attributes
    ----------
    iteration
        How states and forces are found. "open_close": Shi's passes and nothing else; they may
        cycle, which the verdict reports. "settle": the same springs by one kept factor and, where
        that stalls, the interior point (`nmm.contact.iteration.cut_spring_solver`); the answer is
        the same, the cost a fraction.
    max_passes
        Most open-close passes a step (Shi: 6).
    tolerance
        Largest relative out-of-balance force (-) of an accepted step.
    """

    name: ClassVar[str] = "penalty"
    exact: ClassVar[bool] = False
    iteration: str = "settle"
    max_passes: int = above_zero(20)
    tolerance: float = above_zero(1e-8)

    def __post_init__(self) -> None:
        if self.iteration not in ("settle", "open_close"):
            raise FormulationError(
                f'penalty enforcement: iteration = "{self.iteration}": expected "settle" or '
                '"open_close"'
            )

    def solve(
        self, problem: "StepProblem", linear_solver: "LinearSolver", memory: "Memory | None" = None
    ) -> "StepAnswer":
        """Find the forces of the springs."""
        from nmm.contact.problem.refusal import refuse

        refuse(problem)
        tools = self.tools(linear_solver, memory)
        if self.iteration == "open_close":
            from nmm.contact.enforcement.open_close_passes import OpenClosePasses

            limits, pattern = (self.max_passes, self.tolerance), tools.memory.pattern_of(problem)
            return OpenClosePasses(*limits, problem, linear_solver, pattern).run()
        from nmm.contact.iteration.answers import spring_answer
        from nmm.contact.problem.cut_springs import CutSprings

        return spring_answer(CutSprings.of(problem), tools, self.tolerance)
