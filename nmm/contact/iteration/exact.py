"""Exact contact forces: by rounds of multipliers in small problems, by the interior point else.

Rounds are exact to rounding in a few factors of a small matrix, and quick where a step is solved
again because its rows have turned. Where contacts outnumber unknowns
errors that hardly stretch a contact outlive many rounds, and forces of the step before are no help
to the interior point: it takes fifteen to thirty factorisations from nowhere.
"""

from dataclasses import replace

import numpy as np

from nmm.contact.iteration.alternation import IterationBudget
from nmm.contact.iteration.complementarity import Complementarity
from nmm.contact.iteration.cut_spring_solver import FINE, SMALL, inside_start
from nmm.contact.iteration.interior_point import Goal, InteriorPoint
from nmm.contact.iteration.memory import Memory
from nmm.contact.iteration.multiplier_rounds import (
    MultiplierIterate,
    compliances,
    converged_rounds,
    first_round,
    multiplier_round,
    stiff_springs,
)
from nmm.contact.problem.step_problem import StepProblem
from nmm.solvers.linear import LinearSolver

START, AGAIN = 10.0, 100.0
"""Stiffness over compliance of the springs of the first round; and where a step is solved again."""
STIFF = 100.0
"""The same of rounds that finish what the interior point leaves."""
SLIGHT = 1e-5
"""The same of springs that only carry the forces of the interior point."""
ROUNDS, FEW = 12, 3
"""Most rounds in small problems and at the end, and where the step is solved again."""


def exact_round(
    problem: StepProblem,
    linear: LinearSolver,
    memory: Memory,
    goal: Goal,
    factorisations: int = 100,
) -> tuple[MultiplierIterate, str]:
    """Forces within ``goal`` or the best found, and how they were found.

    Parameters
    ----------
    factorisations
        Most of the interior point.

    Raises
    ------
    SolveError
        When even with all contacts acting the load moves a free part.
    """
    small, again = len(problem.force) <= SMALL, memory.again(problem)
    if again:
        problem = replace(problem, start=again[1].increment)
    at, how = None, ""
    if small or again:
        first = first_round(stiff_springs(problem, AGAIN if again else START))
        at = _rounds(first, linear, memory, goal, ROUNDS if small else FEW)
        if at.meets(goal):
            return at, f"{at.count} rounds"
        how = f"{at.count} rounds, then "
    at = interior_round(at, problem, linear, memory, goal, factorisations)
    how = f"{how}{at.result.story}"
    if at.meets(goal):
        return at, how
    more = _rounds(_stiffer(at), linear, memory, goal)
    if more.meets(goal):
        return more, f"{how}, then {more.count - at.count} rounds"
    return at, f"{how}; {more.count - at.count} rounds from there did not help"


def _rounds(
    at: MultiplierIterate, linear: LinearSolver, memory: Memory, goal: Goal, count: int = ROUNDS
) -> MultiplierIterate:
    budget = IterationBudget(300, 12, 0)
    most = at.count + count
    return converged_rounds(at, linear, memory, goal, most, 10.0, budget)


def _stiffer(at: MultiplierIterate) -> MultiplierIterate:
    """The same forces as multipliers of stiff springs."""
    springs = at.result.springs
    exact = ~springs.problem.own_stiffness
    forces = springs.forces(at.result.increment)
    shifts = (np.where(exact, force, 0.0) for force in forces)
    stiff = stiff_springs(springs.problem, STIFF).shifted(*shifts)
    return replace(at, result=replace(at.result, springs=stiff))


def interior_round(
    at: MultiplierIterate | None,
    problem: StepProblem,
    linear: LinearSolver,
    memory: Memory,
    goal: Goal,
    budget: int,
) -> MultiplierIterate:
    """Exact forces by the interior point, at the cost of the rounds before it and its own.

    Small problems are finished to rounding by rounds of Newton's method.
    """
    springs, ease = stiff_springs(problem, SLIGHT), np.stack(compliances(problem))
    sides = Complementarity.of(springs, ~problem.own_stiffness, ease)
    start, before = inside_start(sides, linear, memory), at or first_round(springs)
    found = InteriorPoint(sides, memory.pattern_of(problem), linear).run(start, budget, goal)
    found = replace(
        found,
        solves=before.result.solves + found.solves,
        factorisations=before.result.factorisations + found.factorisations,
    )
    forces = found.springs.forces(found.increment)
    largest = max(float(np.abs(force).max(initial=0.0)) for force in forces)
    gap = found.error * largest * float(ease.max(initial=0.0))
    best = MultiplierIterate(found, before.count, found.error, gap, found.error)
    if len(problem.force) > SMALL:
        return best
    for _ in range(2):
        tried = multiplier_round(_stiffer(best), linear, memory, FINE, IterationBudget(0, 0, 0))
        if not max(tried.result.size, tried.error) < max(best.result.size, best.error):
            break
        best = tried
    return best
