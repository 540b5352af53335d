"""Exact contact on Coulomb's cone: no penetration, no regularised friction."""

from dataclasses import dataclass, replace
from typing import ClassVar

from nmm.contact.alternation import Budget
from nmm.contact.answer import answer, singular_answer
from nmm.contact.enforcement import Enforcement
from nmm.contact.interior import InteriorPoint
from nmm.contact.memory import Memory
from nmm.contact.problem import StepAnswer, StepProblem
from nmm.contact.rounds import (
    Round,
    converged_rounds,
    first_round,
    measured,
    multiplier_round,
    rounds_verdict,
    stiff_springs,
    updated,
)
from nmm.contact.settle import FINE, SMALL
from nmm.contact.springs import CutSprings
from nmm.errors import SolveError
from nmm.solvers.linear import LinearSolver


@dataclass(frozen=True)
class Cone(Enforcement):
    """Forces in the cone ``|T| <= c - mu N, N <= t``, gaps and slips exactly complementary to them.

    Starts cheap and falls back by rule. First rounds of multipliers with one factor of
    ``K + sum p (g_n g_n^T + g_t g_t^T)``, each round a few Anderson-accelerated solves, started
    from the forces of the last step. Where many contacts share few unknowns, so that forces are
    not determined one by one, the rounds are cut short and the interior point takes over; it is
    exact too. Friction is not associated: the bound moves with the normal force, no dilatancy.
    Contacts whose stiffness is the joint's own are springs.

    Attributes
    ----------
    scale
        ``p c`` (-), stiffness of the springs over the contacts' compliance.
    max_rounds
        Rounds before the interior point takes over.
    max_solves
        Most linear solves a round.
    max_factorisations
        Most factorisations of the interior point.
    tolerance
        Largest relative out-of-balance force (-), and largest gap or slip that should not be over
        the compliance times the largest force (-).
    """

    name: ClassVar[str] = "cone"
    scale: float = 10.0
    max_rounds: int = 10
    max_solves: int = 40
    max_factorisations: int = 100
    tolerance: float = 1e-8

    def solve(
        self, problem: StepProblem, linear_solver: LinearSolver, memory: Memory | None = None
    ) -> StepAnswer:
        """Find admissible forces that balance the step with complementary gaps."""
        problem.check()
        memory = memory or Memory()
        springs = stiff_springs(problem, self.scale)
        try:
            at, how = exact_round(
                springs,
                linear_solver,
                memory,
                self.tolerance,
                self.max_rounds,
                self.max_solves,
                self.max_factorisations,
            )
        except SolveError as fault:
            return singular_answer(springs, linear_solver, fault)
        verdict = rounds_verdict(at, linear_solver, memory, self.tolerance, how)
        return answer(at.settled, linear_solver, verdict)


def exact_round(
    springs: CutSprings,
    linear: LinearSolver,
    memory: Memory,
    tolerance: float,
    rounds: int = 10,
    solves: int = 40,
    factorisations: int = 100,
) -> tuple[Round, str]:
    """Exact forces by rounds of multipliers or, by rule, the interior point; and how.

    Raises
    ------
    SolveError
        When even with all contacts acting the load moves a free part.
    """
    at = first_round(springs)
    budget = Budget(solves, 4, 0)
    allowed = 1 if memory.redundant else rounds
    at = converged_rounds(at, linear, memory, tolerance, allowed, 1.0, budget)
    how = f"{at.count} rounds"
    if at.meets(tolerance):
        return at, how
    memory.redundant = memory.redundant or at.count > 1
    at = interior_round(at, linear, memory, tolerance, factorisations)
    return at, f"{how}, then {at.settled.story}"


def interior_round(
    at: Round, linear: LinearSolver, memory: Memory, tolerance: float, budget: int
) -> Round:
    """Exact forces from where the rounds stand, by the interior point.

    Small problems are finished to rounding by rounds of Newton's method.
    """
    before, problem = at.settled, at.settled.springs.problem
    method = InteriorPoint(
        before.springs, memory.pattern_of(problem), linear, exact=~problem.own_stiffness
    )
    found = method.run(before, budget, tolerance)
    total = replace(
        found,
        solves=before.solves + found.solves,
        factorisations=before.factorisations + found.factorisations,
    )
    best = measured(total, at.count)
    if len(problem.force) > SMALL:
        return best
    for _ in range(2):
        tried = multiplier_round(updated(best), linear, memory, FINE, Budget(0, 0, 0))
        if not max(tried.settled.size, tried.error) < max(best.settled.size, best.error):
            break
        best = tried
    return best
