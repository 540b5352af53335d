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
    gap_goal,
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

START = 10.0
"""Stiffness over compliance of the springs by which the interior point measures forces."""
RESIGNED = 5
"""Steps that begin with the interior point after one in which the rounds failed."""


@dataclass(frozen=True)
class Cone(Enforcement):
    """Forces in the cone ``|T| <= c - mu N, N <= t``, gaps and slips exactly complementary to them.

    Starts cheap and falls back by rule. First rounds of multipliers, started from the forces of
    the last step, each a few solves with kept factors (`nmm.contact.alternation`), their springs
    stiffer from round to round. Where a round misses its tolerance the interior point takes over,
    which is exact too, and the verdict says so. Friction is not associated: the bound moves with
    the normal force, no dilatancy. Contacts whose stiffness is the joint's own are springs.

    Where blocks have more contacts than unknowns exact forces are not unique, and with friction
    not even their resultants on the blocks: two searches that meet every condition to 1e-8 differ
    by 1e-3 on a wall of 100 bricks (docs/enforcements.md).

    Attributes
    ----------
    scale
        ``p c`` (-), stiffness of the springs of the first round over the contacts' compliance.
    growth
        Factor on ``p`` after a round that reduced the error by less than fifty.
    max_rounds
        Rounds before the interior point takes over.
    max_solves
        Most linear solves a round.
    max_factorisations
        Most factorisations of the interior point.
    tolerance
        Largest relative out-of-balance force (-).
    gap_tolerance
        Largest gap or slip that should not be, over the compliance times the largest force (-);
        ``tolerance`` stands in for it in problems of up to 120 unknowns.
    """

    name: ClassVar[str] = "cone"
    scale: float = 10.0
    growth: float = 10.0
    max_rounds: int = 12
    max_solves: int = 400
    max_factorisations: int = 100
    tolerance: float = 1e-8
    gap_tolerance: float = 1e-5

    def solve(
        self, problem: StepProblem, linear_solver: LinearSolver, memory: Memory | None = None
    ) -> StepAnswer:
        """Find admissible forces that balance the step with complementary gaps."""
        problem.check()
        memory = memory or Memory()
        springs = stiff_springs(problem, self.scale)
        goal = gap_goal(problem, self.tolerance, self.gap_tolerance)
        try:
            at, how = exact_round(
                springs,
                linear_solver,
                memory,
                self.tolerance,
                goal,
                self.max_rounds,
                self.growth,
                self.max_solves,
                self.max_factorisations,
            )
        except SolveError as fault:
            return singular_answer(springs, linear_solver, fault)
        verdict = rounds_verdict(at, linear_solver, memory, self.tolerance, goal, how)
        return answer(at.settled, linear_solver, verdict)


def exact_round(
    springs: CutSprings,
    linear: LinearSolver,
    memory: Memory,
    tolerance: float,
    gap_tolerance: float,
    rounds: int = 12,
    growth: float = 10.0,
    solves: int = 400,
    factorisations: int = 100,
) -> tuple[Round, str]:
    """Exact forces by rounds of multipliers or, by rule, the interior point; and how.

    Raises
    ------
    SolveError
        When even with all contacts acting the load moves a free part.
    """
    at = first_round(springs)
    budget = Budget(solves, 20, 0)
    if memory.resigned:
        memory.resigned -= 1
        rounds, growth = 1, 1.0
    at = converged_rounds(at, linear, memory, tolerance, gap_tolerance, rounds, growth, budget)
    how = f"{at.count} rounds"
    if at.meets(tolerance, gap_tolerance):
        return at, how
    if rounds > 1:
        memory.resigned = RESIGNED
    at = interior_round(at, linear, memory, tolerance, gap_tolerance, factorisations)
    return at, f"{how}, then {at.settled.story}"


def interior_round(
    at: Round,
    linear: LinearSolver,
    memory: Memory,
    tolerance: float,
    gap_tolerance: float,
    budget: int,
) -> Round:
    """Exact forces from where the rounds stand, by the interior point, from springs as at first.

    Small problems are finished to rounding by rounds of Newton's method.
    """
    before, problem = at.settled, at.settled.springs.problem
    method = InteriorPoint(
        stiff_springs(problem, START),
        memory.pattern_of(problem),
        linear,
        exact=~problem.own_stiffness,
        slack=tolerance / gap_tolerance,
    )
    found = method.run(before, budget, tolerance)
    total = replace(
        found,
        solves=before.solves + found.solves,
        factorisations=before.factorisations + found.factorisations,
    )
    best = measured(total, at.count)
    if len(problem.force) <= SMALL:
        for _ in range(2):
            tried = multiplier_round(updated(best), linear, memory, FINE, Budget(0, 0, 0))
            if not max(tried.settled.size, tried.error) < max(best.settled.size, best.error):
                break
            best = tried
    return best
