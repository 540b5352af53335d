"""Augmented Lagrangian: penalty springs relieved by multipliers."""

from dataclasses import dataclass
from typing import ClassVar

from nmm.contact.enforcement.iterative import IterativeEnforcement
from nmm.contact.iteration.alternation import IterationBudget
from nmm.contact.iteration.answers import answer, singular_answer
from nmm.contact.iteration.exact import exact_round
from nmm.contact.iteration.memory import Memory
from nmm.contact.iteration.multiplier_rounds import (
    converged_rounds,
    exact_goal,
    first_round,
    rounds_verdict,
    stiff_springs,
)
from nmm.contact.problem.step_problem import StepAnswer, StepProblem
from nmm.errors import SolveError
from nmm.registry import above_zero
from nmm.solvers.linear import LinearSolver


@dataclass(frozen=True)
class Augmented(IterativeEnforcement):
    """Uzawa's iteration on penalty springs (Lin 1995; Amadei, Lin, Dwyer 1996).

    ``lambda <- lambda + p d`` after every round, the shear multiplier cut at Coulomb's bound; a
    round settles springs shifted by the multipliers. For one contact of compliance ``c`` the
    error of the force falls by exactly ``1/(1 + p c)`` a round, so the result does not depend on
    ``p``, only the number of rounds does. The multipliers are the contact forces.

    Attributes
    ----------
    scale
        ``p c`` (-), from which ``p`` of each contact follows; None takes the stiffnesses of the
        problem.
    growth
        Factor on ``p`` (-) after a round that reduced the error by less than fifty, up to 100
        times the first ``p``; 1 keeps ``p``.
    max_rounds
        Most updates of the multipliers a step.
    rescue
        Most factorisations of the interior point, which takes over when the rounds fail; 0
        reports the failure instead.
    tolerance
        Largest relative out-of-balance force (-).
    gap_tolerance
        Largest gap or slip that should not be, over the compliance times the largest force (-);
        ``tolerance`` stands in for it in problems of up to 120 unknowns.
    """

    name: ClassVar[str] = "augmented"
    multipliers: ClassVar[bool] = True
    scale: float | None = 10.0
    growth: float = above_zero(10.0)
    max_rounds: int = above_zero(50)
    rescue: int = 100
    tolerance: float = above_zero(1e-8)
    gap_tolerance: float = above_zero(1e-7)

    def solve(
        self, problem: StepProblem, linear_solver: LinearSolver, memory: Memory | None = None
    ) -> StepAnswer:
        """Alternate settling and updating until forces and multipliers agree."""
        problem.check()
        memory = memory or Memory()
        at = first_round(stiff_springs(problem, self.scale))
        goal = exact_goal(problem, self.tolerance, self.gap_tolerance)
        budget = IterationBudget(400, 20, 0) if self.rescue else IterationBudget()
        try:
            at = converged_rounds(
                at,
                linear_solver,
                memory,
                goal,
                self.max_rounds,
                self.growth,
                budget,
                self.iterations,
            )
            how = f"{at.count} rounds"
            if self.rescue and not at.meets(goal):
                at, rest = exact_round(
                    problem, linear_solver, memory, goal, self.rescue, self.iterations
                )
                how = f"{how}, then {rest}"
        except SolveError as fault:
            return singular_answer(at.result.springs, linear_solver, fault)
        verdict = rounds_verdict(at, linear_solver, memory, goal, how)
        return answer(at.result, linear_solver, verdict)
