"""Solve cut springs: by modified Newton steps with two factors, or by the interior point.

The interior point finds most states in ten factorisations whatever the stiffness, and takes many
more over the last few; modified Newton is quick where most states are right, and lost where not.
Which of them goes first follows from what both cost in the last steps (`ways`).
"""

from dataclasses import replace

import numpy as np

from integration.arrays import Floats
from nmm.contact.iteration.alternation import Alternation
from nmm.contact.iteration.complementarity import Complementarity, InteriorIterate
from nmm.contact.iteration.interior_point import Goal, InteriorPoint
from nmm.contact.iteration.memory import Memory
from nmm.contact.iteration.options import DEFAULT, SMALL, IterationBudget, IterationOptions
from nmm.contact.iteration.semismooth_newton import polish
from nmm.contact.iteration.warm_start import start_from
from nmm.contact.problem.cut_springs import CutSprings, IterationResult
from nmm.solvers.linear import LinearSolver


def solve_springs(
    springs: CutSprings,
    linear: LinearSolver,
    memory: Memory,
    tolerance: float,
    start: Floats | None = None,
    budget: IterationBudget | None = None,
    options: IterationOptions = DEFAULT,
) -> IterationResult:
    """Return unknowns whose cut spring forces balance the step within ``tolerance``, or the best.

    Raises
    ------
    SolveError
        When even with all springs acting the load moves a free part.
    """
    budget = budget or IterationBudget()
    near = springs.problem.start if start is None else None
    given = near if start is None else start
    small = len(springs.problem.force) <= SMALL
    increment = start_from(springs, memory.found, memory.moving) if given is None else given
    if small or (near is not None and springs.problem.n_contacts <= options.springs.few):
        quick = _polished(springs, linear, memory, increment, options)
        if quick.size <= tolerance:
            return _kept(quick, memory)
    # In statics no step is like the last: what goes first is thorough.
    way = (_by_cost if memory.moving else _in_order) if budget.interior else _alternated
    found = way(springs, linear, memory, tolerance, increment, budget, options)
    if small and found.size <= tolerance:
        end = _polished(springs, linear, memory, found.increment, options)
        found = replace(found, increment=end.increment, size=end.size)
    return _kept(found, memory)


def _by_cost(
    springs: CutSprings,
    linear: LinearSolver,
    memory: Memory,
    tolerance: float,
    increment: Floats,
    budget: IterationBudget,
    options: IterationOptions,
) -> IterationResult:
    """Best of both ways; the one that cost less in the last steps goes first."""
    ways, size = memory.ways, springs.residual(increment).size
    near = size <= options.ways.nearness
    found = IterationResult(springs, increment, size, 0, 0, "")
    first = ways.budget(budget, near, options.ways)
    if first is not None:
        found = _alternated(springs, linear, memory, tolerance, increment, first, options)
    if found.size <= tolerance:
        if not near:
            ways.alternation_met()
        return found
    goals = (options.springs.loose, tolerance) if ways.finishes else (tolerance,)
    rest = replace(budget, factors=options.springs.first, cost=options.ways.finish)
    ended = _inside(found, linear, memory, goals, rest, options)
    if not ended.size <= tolerance:
        more = _in_order(springs, linear, memory, tolerance, increment, budget, options)
        return _joined(ended, more)
    if not near:
        ways.interior_took(_less(ended, found), options.ways)
    return ended


def _in_order(
    springs: CutSprings,
    linear: LinearSolver,
    memory: Memory,
    tolerance: float,
    increment: Floats,
    budget: IterationBudget,
    options: IterationOptions,
) -> IterationResult:
    """Best of the alternation and, where it has not met the tolerance, of all there is."""
    first = replace(budget, factors=min(budget.factors, options.springs.first))
    found = _alternated(springs, linear, memory, tolerance, increment, first, options)
    if found.size <= tolerance:
        return found
    goals = options.springs.loose, tolerance
    return _inside(found, linear, memory, goals, first, options)


def _alternated(
    springs: CutSprings,
    linear: LinearSolver,
    memory: Memory,
    tolerance: float,
    increment: Floats,
    budget: IterationBudget,
    options: IterationOptions,
) -> IterationResult:
    return Alternation(springs, linear, memory, tolerance, increment, options).run(budget)


def _inside(
    found: IterationResult,
    linear: LinearSolver,
    memory: Memory,
    goals: tuple[float, ...],
    rest: IterationBudget,
    options: IterationOptions,
) -> IterationResult:
    """Best of the interior point; at each of its ``goals`` the alternation may spend ``rest``."""
    springs, problem, best = found.springs, found.springs.problem, found
    stiffness = np.stack([springs.normal_stiffness, springs.shear_stiffness])
    sides = Complementarity.of(springs, np.zeros(problem.n_contacts, dtype=bool), 1 / stiffness)
    start = inside_start(sides, linear, memory, options)
    tolerance = goals[-1]
    for balance in goals:
        method = InteriorPoint(sides, memory.pattern_of(problem), linear, options.interior)
        if best.size > balance:
            best = _joined(best, method.run(start, rest.interior, Goal(max(balance, tolerance))))
            start = method.reached if best.size <= balance else start
        if best.size <= tolerance:
            break
        more = _alternated(springs, linear, memory, tolerance, best.increment, rest, options)
        best = _joined(best, more)
        memory.ways.finishes = best.size <= tolerance
        if best.size <= tolerance:
            break
    return best


def inside_start(
    sides: Complementarity,
    linear: LinearSolver,
    memory: Memory,
    options: IterationOptions = DEFAULT,
) -> InteriorIterate:
    """Start of the interior point: as if all contacts were springs that pull and push.

    Exact ones are as stiff there as what they join. Raises `SolveError` when the load moves a
    free part even so.
    """
    springs, exact = sides.springs, sides.exact
    stiffness = np.stack([springs.normal_stiffness, springs.shear_stiffness])
    normal, shear = np.where(exact, 1 / sides.compliance, stiffness)
    shifts = np.stack([springs.normal_shift, springs.shear_shift])
    alike = replace(springs, normal_stiffness=normal, shear_stiffness=shear).shifted(
        *np.where(exact, 0.0, shifts)
    )
    kept, _ = memory.factor_of(alike, linear)
    increment = kept.factor.solve(springs.problem.force)
    return sides.start(increment, np.stack(alike.forces(increment)), options.interior.within)


def _joined(before: IterationResult, then: IterationResult) -> IterationResult:
    """The better of two, with the cost of both."""
    return replace(
        then if then.size < before.size else before,
        solves=before.solves + then.solves,
        factorisations=before.factorisations + then.factorisations,
        story=f"{before.story}, then {then.story}",
    )


def _less(whole: IterationResult, part: IterationResult) -> IterationResult:
    """The whole with the cost of what came after the part alone."""
    return replace(
        whole,
        solves=whole.solves - part.solves,
        factorisations=whole.factorisations - part.factorisations,
    )


def _polished(
    springs: CutSprings,
    linear: LinearSolver,
    memory: Memory,
    increment: Floats,
    options: IterationOptions,
) -> IterationResult:
    pattern = memory.pattern_of(springs.problem)
    return polish(springs, pattern, linear.unsymmetric(), increment, options.springs.fine)


def _kept(found: IterationResult, memory: Memory) -> IterationResult:
    memory.keep(found.increment, found.springs.problem.force)
    return found
