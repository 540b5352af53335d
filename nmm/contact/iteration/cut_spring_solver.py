"""Solve cut springs: by modified Newton steps with two factors, or by the interior point.

The interior point finds most states in ten factorisations whatever the stiffness, and takes many
more over the last few; modified Newton is quick where most states are right, and lost where not.
Which of them goes first follows from what both cost in the last steps (`ways`).
"""

from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from integration.arrays import Floats
from nmm.contact.islands.warm_start import start_from
from nmm.contact.iteration.alternation import Alternation
from nmm.contact.iteration.apart import apart_in, solve_apart
from nmm.contact.iteration.complementarity import Complementarity, InteriorIterate
from nmm.contact.iteration.interior_point import Goal, InteriorPoint
from nmm.contact.iteration.memory import Memory
from nmm.contact.iteration.options import DEFAULT, SMALL, IterationBudget, IterationOptions
from nmm.contact.iteration.semismooth_newton import polish
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
    islands = apart_in(springs, memory, options.islands)
    near = springs.problem.start if start is None else None
    given = near if start is None else start
    if given is None:
        given = start_from(springs, memory.found, memory.moving, islands)
    budget = budget or IterationBudget()

    def together(part: CutSprings, kept: Memory, at: Floats) -> IterationResult:
        return _together(part, linear, kept, tolerance, at, near is not None, budget, options)

    if islands is None:
        found = together(springs, memory, given)
    else:
        found = solve_apart(springs, islands, memory, tolerance, given, together, options.islands)
    memory.keep(found.increment, springs.problem.force)
    return found


def _together(
    springs: CutSprings,
    linear: LinearSolver,
    memory: Memory,
    tolerance: float,
    increment: Floats,
    near: bool,
    budget: IterationBudget,
    options: IterationOptions,
) -> IterationResult:
    """Best of all ways from an increment; ``near`` one that is known to be near the end."""
    small = len(increment) <= SMALL
    ways = _WaysToForces(springs, linear, memory, tolerance, options)
    if small or (near and springs.problem.n_contacts <= options.springs.few):
        quick = ways.polished(increment)
        if quick.size <= tolerance:
            return quick
    # In statics no step is like the last: what goes first is thorough.
    thorough = ways.by_cost if memory.moving else ways.in_order
    found = (thorough if budget.interior else ways.alternated)(increment, budget)
    if small and found.size <= tolerance:
        end = ways.polished(found.increment)
        found = replace(found, increment=end.increment, size=end.size)
    return found


@dataclass(frozen=True)
class _WaysToForces:
    """The ways from unknowns to those at which cut springs balance the step."""

    springs: CutSprings
    linear: LinearSolver
    memory: Memory
    tolerance: float
    options: IterationOptions

    def by_cost(self, increment: Floats, budget: IterationBudget) -> IterationResult:
        """Best of both ways; the one that cost less in the last steps goes first."""
        ways, options = self.memory.ways, self.options
        size = self.springs.residual(increment).size
        near = size <= options.ways.nearness
        found = IterationResult(self.springs, increment, size, 0, 0, "")
        first = ways.budget(budget, near, options.ways)
        if first is not None:
            found = self.alternated(increment, first)
        if found.size <= self.tolerance:
            if not near:
                ways.alternation_met()
            return found
        finishes = ways.finishes
        goals = (options.springs.loose, self.tolerance) if finishes else (self.tolerance,)
        rest = replace(budget, factors=options.springs.first, cost=options.ways.finish)
        ended = self.inside(found, goals, rest)
        if not ended.size <= self.tolerance:
            return ended.then(self.in_order(increment, budget))
        if not near:
            ways.interior_took(_less(ended, found), options.ways)
        return ended

    def in_order(self, increment: Floats, budget: IterationBudget) -> IterationResult:
        """Best of the alternation and, where it has not met the tolerance, of all there is."""
        first = replace(budget, factors=min(budget.factors, self.options.springs.first))
        found = self.alternated(increment, first)
        if found.size <= self.tolerance:
            return found
        return self.inside(found, (self.options.springs.loose, self.tolerance), first)

    def alternated(self, increment: Floats, budget: IterationBudget) -> IterationResult:
        """Best of modified Newton steps with two factors."""
        given = self.springs, self.linear, self.memory, self.tolerance
        return Alternation(*given, increment, self.options).run(budget)

    def inside(
        self, found: IterationResult, goals: tuple[float, ...], rest: IterationBudget
    ) -> IterationResult:
        """Best of the interior point; at each of the ``goals`` alternation may spend ``rest``."""
        springs, problem, best = self.springs, self.springs.problem, found
        memory, options = self.memory, self.options
        stiffness = np.stack([springs.normal_stiffness, springs.shear_stiffness])
        sides = Complementarity.of(springs, np.zeros(problem.n_contacts, dtype=bool), 1 / stiffness)
        start = inside_start(sides, self.linear, memory, options)
        for balance in goals:
            pattern = memory.pattern_of(problem)
            method = InteriorPoint(sides, pattern, self.linear, options.interior)
            if best.size > balance:
                goal = Goal(max(balance, self.tolerance))
                best = best.then(method.run(start, rest.interior, goal))
                start = method.reached if best.size <= balance else start
            if best.size <= self.tolerance:
                break
            best = best.then(self.alternated(best.increment, rest))
            memory.ways.finishes = best.size <= self.tolerance
            if best.size <= self.tolerance:
                break
        return best

    def polished(self, increment: Floats) -> IterationResult:
        """End of Newton's method on the springs that act."""
        pattern = partial(self.memory.pattern_of, self.springs.problem)
        linear = self.linear.unsymmetric()
        return polish(self.springs, pattern, linear, increment, self.options.springs.fine)


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
    problem = springs.problem
    increment = kept.factor.solve(problem.force, problem.among)
    return sides.start(increment, np.stack(alike.forces(increment)), options.interior.within)


def _less(whole: IterationResult, part: IterationResult) -> IterationResult:
    """The whole with the cost of what came after the part alone."""
    return replace(
        whole,
        solves=whole.solves - part.solves,
        factorisations=whole.factorisations - part.factorisations,
    )
