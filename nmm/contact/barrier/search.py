"""Newton's method on a barrier, and the interior point that finds a start near enough for it."""

from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats
from nmm.contact.barrier.newton import Newton, Start
from nmm.contact.barrier.potential import Potential
from nmm.contact.iteration.interior.complementarity import Complementarity, InteriorIterate
from nmm.contact.iteration.interior.interior_point import InteriorPoint
from nmm.contact.iteration.multiplier_rounds import compliances
from nmm.contact.iteration.tools import Tools
from nmm.contact.problem.cut_springs import CutSprings, IterationResult
from nmm.contact.problem.step_problem import StepAnswer, StepProblem


@dataclass(frozen=True)
class Search:
    """One search for the balance of a `Potential`.

    Newton's method on unknowns and forces begins at the springs that the rough solution balanced:
    near, while a step is like the last. Otherwise an interior point finds most states first, on
    the central path of the exact problem down to the width of the barrier.
    """

    well: Potential
    tools: Tools
    tolerance: float

    def run(
        self,
        rough: IterationResult,
        passes: int,
        solved: tuple[StepProblem, StepAnswer] | None = None,
    ) -> IterationResult:
        """Unknowns in balance, or no motion, which crosses no wall.

        ``solved`` is the last problem with its answer, where it was of the same step.
        """
        well, options = self.well, self.tools.options.barrier
        springs = CutSprings.of(well.problem)
        newton = Newton(well, self.tools, springs.weight)
        path = InteriorPoint(_sides(well), self.tools)
        starts = [] if solved is None else [_end(newton, *solved)]
        increment = None
        for start in [*starts, _cut(newton, rough)]:
            if increment is None:
                increment = newton.run(
                    start, self.tolerance, min(options.quick, passes), patient=False
                )
        if increment is None and well.problem.n_contacts:
            increment = self._inside(newton, path, rough, passes)
        if increment is None:
            increment = np.zeros_like(well.problem.force)
        steps = newton.factorisations + path.factorisations
        story = f"{newton.factorisations} Newton steps"
        if path.factorisations:
            story = f"an interior point of {path.factorisations} and {story}"
        size, solves = well.imbalance(increment, springs.weight), newton.solves + path.solves
        made = rough.factorisations + steps
        return IterationResult(springs, increment, size, solves, made, story)

    def _inside(
        self, newton: Newton, path: InteriorPoint, rough: IterationResult, passes: int
    ) -> Floats | None:
        """Unknowns (n,) by way of the interior point."""
        options, within = self.tools.options.barrier, self.tools.options.interior.within
        size = options.goal * self.well.scale * self.well.width**2
        trial = rough.springs.forces(rough.increment)
        point = path.centred(
            path.sides.start(rough.increment, trial, within), size, min(options.path, passes)
        )
        if point is None:
            return None
        start = _free(newton, point)
        found = newton.run(start, self.tolerance, min(options.patient, passes), patient=True)
        bound = self.well.bound(point.normal)
        for _ in range(options.bounds):
            if found is not None:
                break
            start, normal = newton.under_bound(start, bound, min(options.held, passes))
            bound = self.well.bound(normal)
            found = newton.run(start, self.tolerance, min(options.quick, passes), patient=False)
        return found


def _sides(well: Potential) -> Complementarity:
    """The exact problem, its walls where those of the barrier are but for their width."""
    problem = well.shifted
    springs = CutSprings.of(problem)
    compliance = np.where(well.spring, 1 / springs.stiffness, compliances(problem))
    return Complementarity(springs, ~well.spring, compliance)


def _free(newton: Newton, point: InteriorIterate) -> Start:
    """Start at a point of the path."""
    gap = point.flow[0] - newton.well.behind
    slip = point.flow[1] - point.flow[2]
    trials = newton.curves.trials(gap, slip, point.normal, point.shear)
    return Start(point.increment, trials)


def _end(newton: Newton, problem: StepProblem, answer: StepAnswer) -> Start:
    """Start where the same step was solved with rows that have turned since."""
    gap, slip = problem.jumps(answer.increment)
    forces = answer.normal_force, answer.shear_force
    return Start(answer.increment, newton.curves.trials(gap, slip, *forces))


def _cut(newton: Newton, rough: IterationResult) -> Start:
    """Start at cut springs: what they are stretched past their forces is gap and slip."""
    springs, increment = rough.springs, rough.increment
    normal, shear = springs.forces(increment)
    trial_n, trial_t = springs.trial(increment)
    gap = (trial_n - normal) / springs.stiffness[0]
    slip = (trial_t - shear) / springs.stiffness[1]
    return Start(increment, newton.curves.trials(gap, slip, normal, shear))
