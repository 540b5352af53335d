"""Exact contact on Coulomb's cone: no penetration, no regularised friction."""

from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

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
from nmm.contact.springs import CutSprings, Settled
from nmm.errors import SolveError
from nmm.solvers.linear import LinearSolver

START = 10.0
"""Stiffness over compliance of the springs by which the interior point measures forces."""
STIFF = 100.0
"""The same of the springs of the rounds that follow it."""
FIRST_ROUNDS = 2
"""Rounds before the interior point is asked which contacts act."""
CLOSE = 1e-4
"""Error of the forces at which most contacts have their state."""


@dataclass(frozen=True)
class Cone(Enforcement):
    """Forces in the cone ``|T| <= c - mu N, N <= t``, gaps and slips exactly complementary to them.

    Starts cheap and falls back by rule. Rounds of multipliers start from the forces of the last
    step, each a few solves with kept factors (`nmm.contact.alternation`), their springs stiffer
    from round to round. Where the first rounds are not near the interior point finds most states
    in some ten factorisations, and stiffer rounds finish; where these fail it goes on to the end,
    and the verdict says so. Friction is not associated: the bound moves with the normal force, no
    dilatancy. Contacts whose stiffness is the joint's own are springs.

    Where blocks have more contacts than unknowns single forces are not unique, and with friction
    resultants hardly are: on a wall of 100 bricks answers that obey every condition to 1e-7 differ
    by up to 4e-3 in them, without friction by 4e-6 (docs/enforcements.md).

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
    multipliers: ClassVar[bool] = True
    scale: float = 10.0
    growth: float = 10.0
    max_rounds: int = 12
    max_solves: int = 300
    max_factorisations: int = 100
    tolerance: float = 1e-8
    gap_tolerance: float = 1e-7

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
    budget = Budget(solves, 12, 0)
    small = len(springs.problem.force) <= SMALL
    few = rounds if small else FIRST_ROUNDS
    at = first_round(springs)
    at = converged_rounds(at, linear, memory, tolerance, gap_tolerance, few, growth, budget)
    if at.meets(tolerance, gap_tolerance):
        return at, f"{at.count} rounds"
    how = f"{at.count} rounds"
    if not at.error <= CLOSE:
        how = f"{how}, interior point"
        at = interior_round(at, linear, memory, CLOSE, CLOSE, factorisations)
    stiff = converged_rounds(
        _stiffer(at), linear, memory, tolerance, gap_tolerance, at.count + rounds, growth, budget
    )
    if stiff.meets(tolerance, gap_tolerance):
        return stiff, f"{how} and {stiff.count - at.count} rounds"
    at = replace(at, settled=_cost(at.settled, stiff.settled))
    at = interior_round(at, linear, memory, tolerance, gap_tolerance, factorisations)
    return at, f"{how} and {stiff.count - at.count} rounds, then {at.settled.story}"


def _stiffer(at: Round) -> Round:
    """The same forces as multipliers of stiffer springs."""
    springs = at.settled.springs
    exact = ~springs.problem.own_stiffness
    forces = springs.forces(at.settled.increment)
    shifts = (np.where(exact, force, 0.0) for force in forces)
    stiff = stiff_springs(springs.problem, STIFF).shifted(*shifts)
    return replace(at, settled=replace(at.settled, springs=stiff))


def _cost(settled: Settled, later: Settled) -> Settled:
    """What was settled, at the cost of what came after it."""
    return replace(settled, solves=later.solves, factorisations=later.factorisations)


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
        slack=tolerance / (START * gap_tolerance),
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
