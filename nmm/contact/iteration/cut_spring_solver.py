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
from nmm.contact.iteration.cells import FEW, from_cell_to_cell
from nmm.contact.iteration.interior.central_start import central_start
from nmm.contact.iteration.interior.complementarity import Complementarity, InteriorIterate
from nmm.contact.iteration.interior.interior_point import Goal, InteriorPoint
from nmm.contact.iteration.newton.semismooth_newton import chords, polish
from nmm.contact.iteration.options.budgets import SMALL, IterationBudget
from nmm.contact.iteration.tools import Tools
from nmm.contact.problem.cut_springs import CutSprings, IterationResult
from nmm.errors import SolveError


def solve_springs(
    springs: CutSprings,
    tools: Tools,
    tolerance: float,
    start: Floats | None = None,
    budget: IterationBudget | None = None,
) -> IterationResult:
    """Return unknowns whose cut spring forces balance the step within ``tolerance``, or the best.

    Raises
    ------
    SolveError
        When even with all springs acting the load moves a free part.
    """
    islands, memory = apart_in(springs, tools), tools.memory
    near = springs.problem.start if start is None else None
    given = near if start is None else start
    if given is None:
        given = start_from(springs, memory.found, memory.moving, islands)
    budget = budget or IterationBudget()

    def together(part: CutSprings, own: Tools, at: Floats) -> IterationResult:
        return _WaysToForces(part, own, tolerance).best(at, near is not None, budget)

    if islands is None:
        found = together(springs, tools, given)
    else:
        found = solve_apart(springs, islands, tools, tolerance, given, together)
    memory.keep(found.increment, springs.problem.force)
    return found


@dataclass(frozen=True)
class _WaysToForces:
    """The ways from unknowns to those at which cut springs balance the step."""

    springs: CutSprings
    tools: Tools
    tolerance: float

    def best(self, increment: Floats, near: bool, budget: IterationBudget) -> IterationResult:
        """Best of all ways from an increment; ``near`` one that is known to be near the end."""
        small, few = len(increment) <= SMALL, self.tools.options.springs.few
        if small or (near and self.springs.problem.n_contacts <= few):
            quick = self.polished(increment)
            if quick.size <= self.tolerance:
                return quick
        elif self.springs.problem.n_contacts * self.tools.options.springs.rare <= len(increment):
            quick = self.shortly(increment, budget)
            if quick.size <= self.tolerance:
                return quick
        # In statics no step is like the last: what goes first is thorough.
        thorough = self.by_cost if self.tools.memory.moving else self.in_order
        found = (thorough if budget.interior else self.alternated)(increment, budget)
        if small and found.size <= self.tolerance:
            end = self.polished(found.increment)
            found = replace(found, increment=end.increment, size=end.size)
        few = self.springs.problem.n_contacts <= FEW
        if budget.interior and few and not found.size <= self.tolerance:
            found = found.then(self.by_cells(found.increment))
        return found

    def by_cells(self, increment: Floats) -> IterationResult:
        """End of the line from an increment to the solution; the increment where it has none.

        Nor has it one where even with all springs acting a part is free.
        """
        try:
            end = from_cell_to_cell(self.springs, self.tools, increment)
        except SolveError:
            end = None
        return self.polished(increment if end is None else end)

    def shortly(self, increment: Floats, budget: IterationBudget) -> IterationResult:
        """End of Newton's method after as many solves as one factorisation of it costs.

        Few contacts beside many unknowns, as those of cracks in a body, have few states to find,
        and a solution with the factor of all springs is dear.
        """
        found = self.alternated(increment, replace(budget, cost=self.tools.options.ways.inside))
        if found.size <= self.tolerance:
            return found
        return found.then(self.polished(found.increment))

    def by_cost(self, increment: Floats, budget: IterationBudget) -> IterationResult:
        """Best of both ways; the one that cost less in the last steps goes first."""
        ways, options = self.tools.memory.ways, self.tools.options
        size = self.springs.residual(increment).size
        near = size <= options.ways.nearness
        found = IterationResult(self.springs, increment, size, 0, 0, "")
        tangent = self.tools.memory.last_tangent(self.springs.problem)
        if near and tangent is not None:
            found = chords(found, tangent, self.tolerance)
            if found.size <= self.tolerance:
                self.tools.memory.keep_tangent(tangent)
                return found
        first = ways.budget(budget, near, options.ways)
        if first is not None:
            further = self.alternated(increment, first)
            found = found.then(further) if found.solves else further
        if near and found.size > self.tolerance:  # few states are wrong where it is cut short
            found = found.then(self.polished(found.increment))
        if found.size <= self.tolerance:
            if not near:
                ways.alternation_met()
            return found
        finishes = ways.finishes
        goals = (options.springs.crossover, self.tolerance) if finishes else (self.tolerance,)
        rest = replace(budget, factors=options.springs.first, cost=options.ways.finish)
        ended = self.inside(found, goals, rest, central=True)
        if not ended.size <= self.tolerance:
            return ended.then(self.in_order(increment, budget))
        if not near:
            price = options.ways.inside
            ways.interior_took(ended.cost(price) - found.cost(price), options.ways)
        return ended

    def in_order(self, increment: Floats, budget: IterationBudget) -> IterationResult:
        """Best of the alternation and, where it has not met the tolerance, of all there is."""
        steer = self.tools.options.springs
        first = replace(budget, factors=min(budget.factors, steer.first))
        found = self.alternated(increment, first)
        # Cut short near its end, it ends sooner than a path from afar.
        if found.size <= self.tools.options.ways.nearness and found.solves >= first.solves:
            found = found.then(self.alternated(found.increment, first))
        if found.size <= self.tolerance:
            return found
        return self.inside(found, (steer.crossover, self.tolerance), first)

    def alternated(self, increment: Floats, budget: IterationBudget) -> IterationResult:
        """Best of modified Newton steps with two factors."""
        return Alternation(self.springs, self.tools, self.tolerance, increment).run(budget)

    def inside(
        self,
        found: IterationResult,
        goals: tuple[float, ...],
        rest: IterationBudget,
        central: bool = False,
    ) -> IterationResult:
        """Best of the interior point; at each of the ``goals`` alternation may spend ``rest``.

        Its first path is from what was ``found``, if ``central``.
        """
        springs, tools, best = self.springs, self.tools, found
        exact = np.zeros(springs.problem.n_contacts, dtype=bool)
        sides = Complementarity(springs, exact, 1 / springs.stiffness)
        start = inside_start(sides, tools)
        nearer = None
        if central and 0 < found.size < 1:
            nearer = central_start(sides, found.increment, found.size * sides.mean(start))
        for balance in goals:
            method, before = InteriorPoint(sides, tools), best.size
            if best.size > balance:
                goal = Goal(max(balance, self.tolerance))
                best = best.then(method.run(start, rest.interior, goal, nearer))
                if best.size <= balance:
                    start, nearer = method.reached, None
            # From where the alternation ended it would only do the same again.
            if best.size <= self.tolerance or best.size == before > balance:
                break
            best = best.then(self.alternated(best.increment, rest))
            tools.memory.ways.finishes = best.size <= self.tolerance
            # A path that does not come as far as a rough balance comes to no finer one.
            if best.size <= self.tolerance or best.size > balance:
                break
        return best

    def polished(self, increment: Floats) -> IterationResult:
        """End of Newton's method on the springs that act."""
        pattern = partial(self.tools.memory.pattern_of, self.springs.problem)
        linear, fine = self.tools.linear.unsymmetric(), self.tools.options.springs.fine
        return polish(
            self.springs, pattern, linear, increment, fine, keep=self.tools.memory.keep_tangent
        )


def inside_start(sides: Complementarity, tools: Tools) -> InteriorIterate:
    """Start of the interior point: as if all contacts were springs that pull and push.

    Exact ones are as stiff there as what they join. Raises `SolveError` when the load moves a
    free part even so.
    """
    springs, exact = sides.springs, sides.exact
    stiffness = np.where(exact, 1 / sides.compliance, springs.stiffness)
    alike = replace(springs, stiffness=stiffness, shift=np.where(exact, 0.0, springs.shift))
    kept, _ = tools.memory.factor_of(alike, tools.linear)
    problem, within = springs.problem, tools.options.interior.within
    increment = kept.factor.solve(problem.force, problem.among)
    return sides.start(increment, alike.forces(increment), within)
