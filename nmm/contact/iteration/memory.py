"""Memory of the contact solution between steps: for speed, but for the width of barriers."""

from dataclasses import dataclass, field, fields, replace
from typing import Any

import numpy as np

from integration.arrays import Floats, Ints, same
from integration.contraction import every
from nmm.contact.islands.partition import Islands
from nmm.contact.iteration.options.springs import MemoryOptions
from nmm.contact.iteration.ways import Ways
from nmm.contact.problem.cut_springs import CutSprings
from nmm.contact.problem.matrix_pattern import SpringPattern
from nmm.contact.problem.row_products import compressed
from nmm.contact.problem.step_problem import Limits, StepAnswer, StepProblem
from nmm.solvers.linear import Factor, LinearSolver
from nmm.solvers.norm import norm

STEP = ("force", "gap", "slip")
"""What stays from solution to solution of one step."""
PROBLEM = STEP + tuple(
    part.name for part in fields(StepProblem) if part.name not in (*STEP, "start")
)
"""All that the answer to a problem depends on; what changes in every step comes first."""


@dataclass
class KeptFactor:
    """Factor of the matrix with all springs acting, and what it was made of.

    It goes on serving when contacts come and go, as long as the diagonal hardly changes: two
    contacts that take turns at one corner stiffen the same unknowns.
    """

    factor: Factor
    solver: LinearSolver
    springs: CutSprings
    diagonal: Floats
    options: MemoryOptions

    def serves(self, springs: CutSprings, solver: LinearSolver) -> bool:
        """Whether it is near enough to the matrix of ``springs``."""
        if solver != self.solver or len(springs.weight) != len(self.diagonal):
            return False
        now, drift = springs.weight**-2, self.options.drift
        return bool(np.all(now <= drift * self.diagonal) and np.all(self.diagonal <= drift * now))

    def as_new(self, problem: StepProblem) -> bool:
        """Whether a new factor would hardly differ."""
        old = self.springs.problem
        pairs = (
            (old.matrix.data, problem.matrix.data),
            (old.normal_rows.data, problem.normal_rows.data),
            (old.tangent_rows.data, problem.tangent_rows.data),
        )
        turn = self.options.turn
        return all(a is b or (len(a) == len(b) and norm(a - b) <= turn * norm(b)) for a, b in pairs)


@dataclass
class Memory:
    """Pattern and factor of the last step; owned by the step loop, filled by enforcements.

    One memory belongs to one run. Its contents are used only where the problem handed in still
    has the same unknowns at its contacts, and are replaced otherwise.

    Attributes
    ----------
    pattern
        Pattern of matrix and springs.
    found
        Unknowns found for the last steps, latest first, from which the next one may start.
    moving
        Whether inertia determines the motion of every body (`nmm.contact.islands.warm_start`).
    kept
        Last factors with all springs acting: rounds of multipliers use springs of several
        stiffnesses in one step.
    answered
        The problem solved last and its answer: a step that finds no other contacts when it looks
        further asks the same again.
    ways
        What the ways to the forces of springs cost in the last steps.
    barrier_width
        Width of the barrier chosen in the first step (m). It is no cache: answers depend on it.
    tangent
        Pattern and last factor of Newton's method in the last solution; None where it took none.
    apart
        What is kept of islands solved apart, by their unknowns, latest last.
    options
        How much is kept, and how long it serves.
    """

    pattern: SpringPattern | None = None
    found: list[Floats] = field(default_factory=list)
    moving: bool = False
    kept: list[KeptFactor] = field(default_factory=list)
    answered: tuple[StepProblem, StepAnswer] | None = None
    ways: Ways = field(default_factory=Ways)
    barrier_width: float | None = None
    tangent: tuple[SpringPattern | None, Factor] | None = None
    apart: dict[bytes, "Memory"] = field(default_factory=dict)
    options: MemoryOptions = field(default_factory=MemoryOptions)
    _load: Floats | None = None
    _islands: tuple[SpringPattern, Islands] | None = None

    def known(self, problem: StepProblem) -> StepAnswer | None:
        """Answer of the last solution if it was of the same problem; it took no passes."""
        if self.answered is None or not _alike(self.answered[0], problem, PROBLEM):
            return None
        return replace(self.answered[1], passes=0, factorisations=0)

    def pattern_of(self, problem: StepProblem) -> SpringPattern:
        """Pattern of ``problem``, laid out anew when it changed."""
        if self.pattern is None or not self.pattern.fits(problem):
            self.pattern = SpringPattern.of(problem)
        return self.pattern

    def islands_of(self, springs: CutSprings) -> Islands:
        """Islands of a problem, found anew when its pattern changed."""
        pattern = self.pattern_of(springs.problem)
        if self._islands is None or self._islands[0] is not pattern:
            self._islands = pattern, Islands.of(springs)
        return self._islands[1]

    def of_part(self, unknowns: Ints) -> "Memory":
        """Memory of the islands that have these ``unknowns``; the oldest of many is dropped."""
        key = unknowns.tobytes()
        found = self.apart.pop(key, None) or Memory(options=self.options)
        found.moving, self.apart[key] = self.moving, found
        for old in list(self.apart)[: -self.options.parts]:
            del self.apart[old]
        return found

    def factor_of(self, springs: CutSprings, solver: LinearSolver) -> tuple[KeptFactor, bool]:
        """Factor with all springs acting, and whether it was made just now."""
        for kept in self.kept:
            if kept.serves(springs, solver):
                return kept, False
        pattern = self.pattern_of(springs.problem)
        factor = solver.factorise(pattern.matrix(springs.problem, *springs.stiffness))
        kept = KeptFactor(factor, solver, springs, springs.weight**-2, self.options)
        self.kept = [kept, *self.kept[: self.options.factors - 1]]
        return kept, True

    def keep_tangent(self, factor: Factor) -> None:
        """Keep a factor of Newton's method, of the present pattern, in time alone."""
        if self.moving:
            self.tangent = self.pattern, factor

    def last_tangent(self, problem: StepProblem) -> Factor | None:
        """Return and drop the factor of the last solution if it is of the pattern of a problem."""
        kept, self.tangent = self.tangent, None
        return None if kept is None or kept[0] is not self.pattern_of(problem) else kept[1]

    def forget(self, kept: KeptFactor) -> None:
        """Drop a factor that no longer serves."""
        self.kept = [other for other in self.kept if other is not kept]

    def forget_answers(self) -> None:
        """Drop all that was found: after a step that failed none of it is near the next answer."""
        self.found, self.answered, self.tangent = [], None, None

    def forget_all(self) -> None:
        """Drop what is kept for speed alone: patterns, factors and starts."""
        self.forget_answers()
        self.pattern, self.kept, self.moving, self._load = None, [], False, None
        self.ways, self.apart, self._islands = Ways(), {}, None

    def keep(self, increment: Floats, load: Floats) -> None:
        """Keep the unknowns found under a load, in place of what was found under it before."""
        if not every(np.isfinite(increment)):
            return
        again = self._load is not None and _equal(self._load, load)
        before = [old for old in self.found[int(again) :] if old.shape == increment.shape]
        self.found = [increment, *before[: self.options.steps - 1]]
        self._load = load

    def again(self, problem: StepProblem) -> tuple[StepProblem, StepAnswer] | None:
        """The last problem and its answer, if only the rows have turned since."""
        if self.answered is None:
            return None
        last, answer = self.answered
        same = answer.verdict.converged and _alike(last, problem, STEP)
        return self.answered if same else None

    def started(self, problem: StepProblem) -> StepProblem:
        """The problem with the forces of its last solution, where only its rows have turned."""
        found = self.again(problem)
        if found is None:
            return problem
        _, last = found
        return replace(problem, normal_force=last.normal_force, shear_force=last.shear_force)


def _alike(a: StepProblem, b: StepProblem, names: tuple[str, ...]) -> bool:
    for name in names:
        one, other = getattr(a, name), getattr(b, name)
        if one is not other and not _equal(one, other):
            return False
    return True


def _equal(a: Any, b: Any) -> bool:
    if a is b:
        return True
    if a is None or b is None:
        return False
    if isinstance(a, np.ndarray):
        return same(a, b)
    if isinstance(a, Limits):
        return all(_equal(x, getattr(b, name)) for name, x in vars(a).items())
    return all(map(same, compressed(a), compressed(b)))
