"""Modified Newton, alternating between two factorisations, from the best unknowns so far.

The factor of all springs acting is kept over steps and is safe wherever the search stands. That of
the springs that act there makes the end quick, once most states are right: what is wrong with few
contacts acceleration mends in as many solves. On a wall of 1 000 bricks at ten times Young's
modulus 10 solves with the first, one factorisation and 6 solves with the second do what the first
alone does in 30 to 100, and at a hundred times what it does not do in 300
(`benchmarks/enforcement.py`).
"""

from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats
from nmm.contact.iteration.memory import KeptFactor, Memory
from nmm.contact.iteration.modified_newton import Chord, Patience
from nmm.contact.problem.cut_springs import CutSprings, IterationResult
from nmm.errors import SolveError
from nmm.solvers.linear import Factor, LinearSolver

WIDE, NARROW = 20, 20
"""Solves in a row with the factor of all springs, and with that of those that act."""
SLOW = Patience(ahead=10, below=1e-3)
"""When the first is left before its turn is over: where most states are right and it is slow."""
LOST = Patience(ahead=40)
"""When the second is: it would take long, because states are wrong."""
QUICK = 0.1
"""Reduction after which the second is renewed at once, without the first in between."""
REST = 1e-6
"""Part of their stiffness left to springs that do not act, so that nothing comes free."""
DRAG = 0.02
"""Part of the shear stiffness left where contacts slide: some of them may stick in the end."""


@dataclass(frozen=True)
class IterationBudget:
    """How long each method may try.

    Attributes
    ----------
    solves
        Most chord steps.
    factors
        Most factorisations of the springs that act.
    interior
        Most factorisations of the interior point.
    """

    solves: int = 1000
    factors: int = 40
    interior: int = 100


class Alternation:
    """One search for unknowns at which cut springs balance the step."""

    def __init__(
        self,
        springs: CutSprings,
        linear: LinearSolver,
        memory: Memory,
        tolerance: float,
        increment: Floats,
    ) -> None:
        self.springs, self.linear, self.memory = springs, linear, memory
        self.tolerance = tolerance
        self.increment, self.defect = increment, springs.defect(increment)
        self.solves = self.factorisations = 0

    def run(self, budget: IterationBudget) -> IterationResult:
        """Alternate until the tolerance is met or the budget is spent.

        Raises
        ------
        SolveError
            When even with all springs acting the load moves a free part.
        """
        kept = self._all_acting()
        self._steps(kept.factor, min(WIDE, budget.solves), SLOW)
        narrow = 0
        while self._open and narrow < budget.factors and self.solves < budget.solves:
            before, narrow = self.defect.size, narrow + 1
            factor = self._acting()
            if factor is not None:
                self._steps(factor, NARROW, LOST)
            if self._open and not self.defect.size < QUICK * before:
                if not kept.as_new(self.springs.problem):
                    self.memory.forget(kept)
                    kept = self._all_acting()
                self._steps(kept.factor, WIDE)
        story = f"{self.solves} solves with {self.factorisations or 'no'} new factors"
        return IterationResult(
            self.springs,
            self.increment,
            self.defect.size,
            self.solves,
            self.factorisations,
            story,
        )

    @property
    def _open(self) -> bool:
        return not self.defect.size <= self.tolerance

    def _all_acting(self) -> KeptFactor:
        kept, new = self.memory.factor_of(self.springs, self.linear)
        if new:
            self.factorisations += 1
            # Judged once: says so when the load moves a part that nothing holds.
            kept.factor.solve(self.springs.problem.force)
        return kept

    def _acting(self) -> Factor | None:
        """Factor with the springs that act where the search stands; None where it has none."""
        springs = self.springs
        pattern = self.memory.pattern_of(springs.problem)
        is_open, sliding = springs.states(self.increment)
        loose = is_open & (springs.problem.limits.tension <= 0)
        normal = np.where(is_open, REST, 1.0) * springs.normal_stiffness
        left = np.where(loose, REST, np.where(sliding, DRAG, 1.0))
        shear = left * springs.shear_stiffness
        self.factorisations += 1
        try:
            return self.linear.factorise(pattern.matrix(springs.problem, normal, shear))
        except SolveError:
            return None

    def _steps(self, factor: Factor, budget: int, patience: Patience | None = None) -> None:
        chord = Chord(self.springs, factor, self.increment, self.defect)
        chord.run(budget, self.tolerance, patience)
        self.solves += chord.solves
        self.increment, self.defect = chord.increment, chord.defect
