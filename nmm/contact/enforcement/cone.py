"""Exact contact on Coulomb's cone: no penetration, no regularised friction."""

from dataclasses import dataclass
from typing import ClassVar

from nmm.contact.enforcement.iterative import IterativeEnforcement
from nmm.contact.iteration.answers import answer, singular_answer
from nmm.contact.iteration.exact import exact_round
from nmm.contact.iteration.memory import Memory
from nmm.contact.iteration.multiplier_rounds import exact_goal, rounds_verdict, stiff_springs
from nmm.contact.problem.step_problem import StepAnswer, StepProblem
from nmm.errors import SolveError
from nmm.registry import above_zero
from nmm.solvers.linear import LinearSolver


@dataclass(frozen=True)
class Cone(IterativeEnforcement):
    """Forces in the cone ``|T| <= c - mu N, N <= t``, gaps and slips exactly complementary to them.

    An interior point finds them from nowhere in fifteen to thirty factorisations, whatever the
    contacts do (`nmm.contact.iteration.exact`). Friction is not associated: the bound moves with
    the normal force, no dilatancy. Contacts whose stiffness is the joint's own are springs.

    Where blocks have more contacts than unknowns forces are not unique; those found lie in the
    middle of what is admissible, and do not depend on the step before.

    Attributes
    ----------
    max_factorisations
        Most factorisations of the interior point.
    tolerance
        Largest relative out-of-balance force (-).
    gap_tolerance
        Largest gap or slip that should not be, over the compliance times the largest force (-);
        ``tolerance`` stands in for it in problems of up to 120 unknowns.
    """

    name: ClassVar[str] = "cone"
    multipliers: ClassVar[bool] = True
    max_factorisations: int = above_zero(100)
    tolerance: float = above_zero(1e-8)
    gap_tolerance: float = above_zero(1e-7)

    def solve(
        self, problem: StepProblem, linear_solver: LinearSolver, memory: Memory | None = None
    ) -> StepAnswer:
        """Find admissible forces that balance the step with complementary gaps."""
        problem.check()
        memory = memory or Memory()
        goal = exact_goal(problem, self.tolerance, self.gap_tolerance)
        try:
            at, how = exact_round(
                problem, linear_solver, memory, goal, self.max_factorisations, self.iterations
            )
        except SolveError as fault:
            return singular_answer(
                stiff_springs(problem, self.iterations.rounds.start), linear_solver, fault
            )
        verdict = rounds_verdict(at, linear_solver, memory, goal, how)
        return answer(at.result, linear_solver, verdict)
