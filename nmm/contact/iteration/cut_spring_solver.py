"""Solve cut springs: by modified Newton steps with two factors and, by rule, the interior point.

The interior point finds most states in ten factorisations whatever the stiffness, and takes many
more over the last few; modified Newton is quick where most states are right, and lost where not.
"""

from dataclasses import replace

import numpy as np

from integration.arrays import Floats
from nmm.contact.iteration.alternation import Alternation, IterationBudget
from nmm.contact.iteration.complementarity import Complementarity, InteriorIterate
from nmm.contact.iteration.interior_point import Goal, InteriorPoint
from nmm.contact.iteration.memory import Memory
from nmm.contact.iteration.options import DEFAULT, SMALL, IterationOptions
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
    increment = start_from(springs, memory.found, memory.moving) if given is None else given
    small = len(increment) <= SMALL
    if small or (near is not None and springs.problem.n_contacts <= options.springs.few):
        quick = _polished(springs, linear, memory, increment, options)
        if quick.size <= tolerance:
            return _kept(quick, memory)
    first = (
        replace(budget, factors=min(budget.factors, options.springs.first))
        if budget.interior
        else budget
    )
    found = Alternation(springs, linear, memory, tolerance, increment, options.alternation).run(
        first
    )
    if found.size <= tolerance and small:
        end = _polished(springs, linear, memory, found.increment, options)
        found = replace(found, increment=end.increment, size=end.size)
    elif not found.size <= tolerance and budget.interior > 0:
        found = _inside(found, linear, memory, tolerance, budget, options)
    return _kept(found, memory)


def _inside(
    found: IterationResult,
    linear: LinearSolver,
    memory: Memory,
    tolerance: float,
    budget: IterationBudget,
    options: IterationOptions,
) -> IterationResult:
    """Best of the interior point, broken off near the end for modified Newton, and gone on with."""
    springs, problem, best = found.springs, found.springs.problem, found
    stiffness = np.stack([springs.normal_stiffness, springs.shear_stiffness])
    sides = Complementarity.of(springs, np.zeros(problem.n_contacts, dtype=bool), 1 / stiffness)
    start = inside_start(sides, linear, memory, options)
    for balance in (options.springs.loose, tolerance):
        method = InteriorPoint(sides, memory.pattern_of(problem), linear, options.interior)
        if best.size > balance:
            best = _joined(best, method.run(start, budget.interior, Goal(max(balance, tolerance))))
        if best.size <= tolerance:
            break
        rest = replace(budget, factors=options.springs.first)
        best = _joined(
            best,
            Alternation(
                springs, linear, memory, tolerance, best.increment, options.alternation
            ).run(rest),
        )
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
