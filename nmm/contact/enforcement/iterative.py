"""Bases of the enforcements that find contact forces by the iterations of this package."""

from abc import abstractmethod
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, ClassVar

from nmm.contact.enforcement.base import Enforcement
from nmm.contact.iteration.options import IterationOptions
from nmm.errors import SolveError
from nmm.registry import above_zero

if TYPE_CHECKING:
    from nmm.contact.iteration.interior.interior_point import Goal
    from nmm.contact.iteration.memory import Memory
    from nmm.contact.iteration.multiplier_rounds import MultiplierIterate
    from nmm.contact.iteration.tools import Tools
    from nmm.contact.problem.step_problem import StepAnswer, StepProblem
    from nmm.solvers.linear import LinearSolver


@dataclass(frozen=True)
class IterativeEnforcement(Enforcement):
    """An enforcement whose iterations have options of their own.

    Attributes
    ----------
    iterations
        Tables ``[contact.options.iterations.alternation]``, ``springs``, ``interior``,
        ``rounds``, ``barrier`` and ``memory`` (`nmm.contact.iteration.options`).
    """

    iterations: IterationOptions = field(default_factory=IterationOptions, kw_only=True)

    def memory(self) -> "Memory":
        from nmm.contact.iteration.memory import Memory

        return Memory(options=self.iterations.memory)

    def tools(self, linear: "LinearSolver", memory: "Memory | None") -> "Tools":
        """Return the tools of its iterations, with an empty memory where none is given."""
        from nmm.contact.iteration.tools import Tools

        return Tools(linear, memory or self.memory(), self.iterations)


@dataclass(frozen=True)
class ExactEnforcement(IterativeEnforcement):
    """No penetration and no regularised friction: gaps are complementary to forces.

    Attributes
    ----------
    tolerance
        Largest relative out-of-balance force (-).
    gap_tolerance
        Largest gap or slip that should not be, over the compliance times the largest force (-);
        ``tolerance`` stands in for it in problems of up to 120 unknowns.
    """

    multipliers: ClassVar[bool] = True
    tolerance: float = above_zero(1e-8)
    gap_tolerance: float = above_zero(1e-7)

    @abstractmethod
    def forces(
        self, problem: "StepProblem", tools: "Tools", goal: "Goal"
    ) -> "tuple[MultiplierIterate, str]":
        """Forces within ``goal`` or the best found, and how they were found.

        Raises
        ------
        SolveError
            When even with all contacts acting the load moves a free part.
        """

    def solve(
        self, problem: "StepProblem", linear_solver: "LinearSolver", memory: "Memory | None" = None
    ) -> "StepAnswer":
        """Find admissible forces that balance the step with complementary gaps."""
        from nmm.contact.iteration.answers import answer, singular_answer
        from nmm.contact.iteration.multiplier_rounds import (
            exact_goal,
            rounds_verdict,
            stiff_springs,
        )
        from nmm.contact.problem.refusal import refuse

        refuse(problem)
        tools = self.tools(linear_solver, memory)
        goal = exact_goal(problem, self.tolerance, self.gap_tolerance)
        try:
            at, how = self.forces(problem, tools, goal)
        except SolveError as fault:
            springs = stiff_springs(problem, self.iterations.rounds.start)
            return singular_answer(springs, linear_solver, fault)
        verdict = rounds_verdict(at, tools, goal, how)
        return answer(at.result, linear_solver, verdict)
