"""Exact contact forces: by rounds of multipliers in small problems, by the interior point else.

Rounds are exact to rounding in a few factors of a small matrix, and quick where a step is solved
again because its rows have turned. Where contacts outnumber unknowns
errors that hardly stretch a contact outlive many rounds, and forces of the step before are no help
to the interior point: it takes fifteen to thirty factorisations from nowhere.
"""

from dataclasses import replace

import numpy as np

from nmm.contact.iteration.cut_spring_solver import inside_start
from nmm.contact.iteration.interior.complementarity import Complementarity
from nmm.contact.iteration.interior.interior_point import Goal, InteriorPoint
from nmm.contact.iteration.multiplier_rounds import (
    MultiplierIterate,
    compliances,
    converged_rounds,
    first_round,
    multiplier_round,
    stiff_springs,
)
from nmm.contact.iteration.options.budgets import SMALL, IterationBudget
from nmm.contact.iteration.tools import Tools
from nmm.contact.problem.step_problem import StepProblem


def exact_round(
    problem: StepProblem, tools: Tools, goal: Goal, factorisations: int
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
    rounds = tools.options.rounds
    small, again = len(problem.force) <= SMALL, tools.memory.again(problem)
    if again:
        problem = replace(problem, start=again[1].increment)
    at, how = None, ""
    if small or again:
        first = first_round(stiff_springs(problem, rounds.again if again else rounds.start))
        at = _rounds(first, tools, goal, rounds.most if small else rounds.few)
        if at.meets(goal):
            return at, f"{at.count} rounds"
        how = f"{at.count} rounds, then "
    at = _interior_round(at, problem, tools, goal, factorisations)
    how = f"{how}{at.result.story}"
    if at.meets(goal):
        return at, how
    more = _rounds(_stiffer(at, rounds.stiff), tools, goal, rounds.most)
    if more.meets(goal):
        return more, f"{how}, then {more.count - at.count} rounds"
    return at, f"{how}; {more.count - at.count} rounds from there did not help"


def _rounds(at: MultiplierIterate, tools: Tools, goal: Goal, count: int) -> MultiplierIterate:
    return converged_rounds(at, tools, goal, at.count + count, 10.0, IterationBudget(300, 12, 0))


def _stiffer(at: MultiplierIterate, scale: float) -> MultiplierIterate:
    """The same forces as multipliers of stiff springs."""
    springs = at.result.springs
    exact, forces = ~springs.problem.own_stiffness, springs.forces(at.result.increment)
    stiff = stiff_springs(springs.problem, scale).shifted(np.where(exact, forces, 0.0))
    return replace(at, result=replace(at.result, springs=stiff))


def _interior_round(
    at: MultiplierIterate | None, problem: StepProblem, tools: Tools, goal: Goal, budget: int
) -> MultiplierIterate:
    """Exact forces by the interior point, at the cost of the rounds before it and its own.

    Small problems are finished to rounding by rounds of Newton's method.
    """
    rounds, compliance = tools.options.rounds, compliances(problem)
    springs = stiff_springs(problem, rounds.slight)
    sides = Complementarity(springs, ~problem.own_stiffness, compliance)
    start, before = inside_start(sides, tools), at or first_round(springs)
    found = InteriorPoint(sides, tools).run(start, budget, goal).at_cost_of(before.result)
    forces = found.springs.forces(found.increment)
    largest = float(np.abs(forces).max(initial=0.0))
    gap = found.error * largest * float(compliance.max(initial=0.0))
    best = MultiplierIterate(found, before.count, gap, found.error)
    if len(problem.force) > SMALL:
        return best
    for _ in range(2):
        stiff, fine = _stiffer(best, rounds.stiff), tools.options.springs.fine
        tried = multiplier_round(stiff, tools, fine, IterationBudget(0, 0, 0))
        if not max(tried.result.size, tried.error) < max(best.result.size, best.error):
            break
        best = tried
    return best
