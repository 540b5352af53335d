"""Modified Newton, alternating between two factorisations, from the best unknowns so far.

The factor of all springs acting is kept over steps and is safe wherever the search stands. That of
the springs that act there makes the end quick, once most states are right: what is wrong with few
contacts acceleration mends in as many solves. On a wall of 1 000 bricks at ten times Young's
modulus 10 solves with the first, one factorisation and 6 solves with the second do what the first
alone does in 30 to 100, and at a hundred times what it does not do in 300
(`benchmarks/bench_contact.py`). Where many contacts slide the second gains nothing: a factorisation
of 6 000 unknowns takes as long as 20 solves, so the first is left the later the larger the problem
is, and the later for each turn of the second that did not pay in this step and the last ones.
"""

import numpy as np

from integration.arrays import Floats
from nmm.contact.iteration.memory import KeptFactor
from nmm.contact.iteration.newton.modified_newton import ModifiedNewton
from nmm.contact.iteration.options.budgets import IterationBudget, Patience
from nmm.contact.iteration.tools import Tools
from nmm.contact.problem.cut_springs import CutSprings, IterationResult
from nmm.errors import SolveError
from nmm.solvers.linear import Factor


class Alternation:
    """One search for unknowns at which cut springs balance the step."""

    def __init__(
        self, springs: CutSprings, tools: Tools, tolerance: float, increment: Floats
    ) -> None:
        self.springs, self.linear, self.memory = springs, tools.linear, tools.memory
        self.tolerance, self.options = tolerance, tools.options.alternation
        self._size = self.options.size(len(increment))
        self._price = tools.options.ways.acting
        self.increment, self.residual = increment, springs.residual(increment)
        self.solves = self.factorisations = 0

    def run(self, budget: IterationBudget) -> IterationResult:
        """Alternate until the tolerance is met or the budget is spent.

        Raises
        ------
        SolveError
            When even with all springs acting the load moves a free part.
        """
        kept, options, ways = self._all_acting(), self.options, self.memory.ways
        self._wide(kept.factor, budget, options.slow.longer(self._size, ways.stay))
        narrow = 0
        while self._open and narrow < budget.factors and self._within(budget):
            before, narrow = self.residual.size, narrow + 1
            factor = self._acting()
            if factor is not None:
                self._steps(factor, options.narrow, options.lost)
            pays = self.residual.size < options.renewed * before
            ways.second_factor(pays, self._size)
            if self._open and not pays:
                if not kept.as_new(self.springs.problem):
                    self.memory.forget(kept)
                    kept = self._all_acting()
                self._wide(kept.factor, budget)
        if self._open:
            ways.stay = 1.0
        story = f"{self.solves} solves with {self.factorisations or 'no'} new factors"
        return IterationResult(
            self.springs,
            self.increment,
            self.residual.size,
            self.solves,
            self.factorisations,
            story,
        )

    def _within(self, budget: IterationBudget) -> bool:
        return self.solves < budget.solves and self._spent < budget.cost

    @property
    def _spent(self) -> float:
        """What the search has cost, in solves."""
        return self.solves + self._price * self.factorisations

    @property
    def _open(self) -> bool:
        return not self.residual.size <= self.tolerance

    def _all_acting(self) -> KeptFactor:
        kept, new = self.memory.factor_of(self.springs, self.linear)
        if new:
            self.factorisations += 1
            # Judged once: says so when the load moves a part that nothing holds.
            problem = self.springs.problem
            kept.factor.solve(problem.force, problem.among)
        return kept

    def _acting(self) -> Factor | None:
        """Factor with the springs that act where the search stands; None where it has none."""
        springs, rest = self.springs, self.options.rest
        pattern = self.memory.pattern_of(springs.problem)
        is_open, sliding = springs.states(self.increment)
        loose = is_open & (springs.problem.limits.tension <= 0)
        normal = np.where(is_open, rest, 1.0) * springs.stiffness[0]
        left = np.where(loose, rest, np.where(sliding, self.options.drag, 1.0))
        shear = left * springs.stiffness[1]
        self.factorisations += 1
        try:
            return self.linear.factorise(pattern.matrix(springs.problem, normal, shear))
        except SolveError:
            return None

    def _wide(
        self, factor: Factor, budget: IterationBudget, patience: Patience | None = None
    ) -> None:
        """Take a turn of the first factor."""
        turn = self.options.wide * self._size**2 * self.memory.ways.stay
        turn = min(turn, budget.cost - self._spent, budget.solves - self.solves)
        self._steps(factor, max(1, int(turn)), patience)

    def _steps(self, factor: Factor, budget: int, patience: Patience | None = None) -> None:
        search = ModifiedNewton(self.springs, factor, self.increment, self.residual, self.options)
        search.run(budget, self.tolerance, patience)
        self.solves += search.solves
        self.increment, self.residual = search.increment, search.residual
