"""Three methods in turn for one step of a barrier, quickest first, surest last."""

from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats
from nmm.contact.barrier.descent import Descent
from nmm.contact.barrier.newton import Newton, Start
from nmm.contact.barrier.path import Path, Point
from nmm.contact.barrier.potential import Potential
from nmm.contact.problem.cut_springs import CutSprings, IterationResult
from nmm.contact.problem.matrix_pattern import SpringPattern
from nmm.contact.problem.step_problem import StepAnswer, StepProblem
from nmm.solvers.linear import LinearSolver

QUICK, PATIENT, LONG = 20, 40, 40
"""Most steps of the first attempt, of the second, and of the path before it."""
GOAL = 3e-3
"""Product of force and distance at which the path is left, over largest force and width."""
BOUNDS = 6
"""Most friction bounds that are held before the descent."""


@dataclass(frozen=True)
class Search:
    """One search for the balance of a `Potential`.

    Newton's method on unknowns and forces begins at the springs that the rough solution balanced:
    near, while a step is like the last. Otherwise an interior point finds most states first. Both
    say when they fail, and descent inside the walls for held friction bounds starts from rest.
    """

    well: Potential
    pattern: SpringPattern
    linear: LinearSolver
    tolerance: float

    def run(
        self,
        rough: IterationResult,
        passes: int,
        solved: tuple[StepProblem, StepAnswer] | None = None,
    ) -> IterationResult:
        """Unknowns in balance, or the last of the descent, always before the walls.

        ``solved`` is the last problem with its answer, where it was of the same step.
        """
        well = self.well
        springs = CutSprings.of(well.problem)
        newton = Newton(well, self.pattern, self.linear, springs.weight)
        starts = [] if solved is None else [_end(newton, *solved)]
        increment = None
        for start in [*starts, _cut(newton, rough)]:
            if increment is None:
                increment = newton.run(start, self.tolerance, min(QUICK, passes), patient=False)
        path = Path(well.problem, well.offset - well.width / 2, self.pattern, self.linear)
        if increment is None and well.problem.n_contacts and not well.spring.any():
            increment = self._inside(newton, path, rough, passes)
        steps = newton.factorisations + path.factorisations
        made, solves = rough.factorisations + steps, newton.solves + 2 * path.factorisations
        story = f"{newton.factorisations} Newton steps"
        if path.factorisations:
            story = f"an interior point of {path.factorisations} and {story}"
        if increment is not None:
            size = well.imbalance(increment, springs.weight)
            return IterationResult(springs, increment, size, solves, made, story)
        descent = Descent(self.pattern, self.linear, springs.weight)
        bound = well.bound(rough.springs.forces(rough.increment)[0])
        increment, size, updates = descent.balanced(
            well, np.zeros_like(well.problem.force), bound, self.tolerance, passes
        )
        made, solves = made + descent.factorisations, solves + descent.factorisations
        story = f"{story}, then {descent.factorisations} of descent and {updates} friction bounds"
        return IterationResult(springs, increment, size, solves, made, story)

    def _inside(
        self, newton: Newton, path: Path, rough: IterationResult, passes: int
    ) -> Floats | None:
        """Unknowns (n,) by way of the interior point."""
        size = GOAL * self.well.scale * self.well.width**2
        begun = path.start(rough.springs, rough.increment)
        point = path.followed(begun, size, min(LONG, passes))
        if point is None:
            return None
        start = _free(newton, path, point)
        found = newton.run(start, self.tolerance, min(PATIENT, passes), patient=True)
        bound = self.well.bound(-point.pressure)
        for _ in range(BOUNDS):
            if found is not None:
                break
            start, normal = newton.under_bound(start, bound, min(LONG, passes))
            bound = self.well.bound(normal)
            found = newton.run(start, self.tolerance, min(QUICK, passes), patient=False)
        return found


def _free(newton: Newton, path: Path, point: Point) -> Start:
    """Start at a point of the path."""
    gap, slip = point.distance - path.behind, point.ahead - point.back
    trials = newton.curves.trials(gap, slip, -point.pressure, point.shear)
    return Start(point.increment, trials)


def _end(newton: Newton, problem: StepProblem, answer: StepAnswer) -> Start:
    """Start where the same step was solved with rows that have turned since."""
    gap, slip = problem.gaps(answer.increment), problem.slips(answer.increment)
    forces = answer.normal_force, answer.shear_force
    return Start(answer.increment, newton.curves.trials(gap, slip, *forces))


def _cut(newton: Newton, rough: IterationResult) -> Start:
    """Start at cut springs: what they are stretched past their forces is gap and slip."""
    springs, increment = rough.springs, rough.increment
    normal, shear = springs.forces(increment)
    trial_n, trial_t = springs.trial(increment)
    gap = (trial_n - normal) / springs.normal_stiffness
    slip = (trial_t - shear) / springs.shear_stiffness
    return Start(increment, newton.curves.trials(gap, slip, normal, shear))
