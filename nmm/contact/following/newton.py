"""Newton's method on balance and path equation together (Riks 1979; Crisfield 1981).

Contacts answer by their laws' own tangents, softening ones among them, so that a path is followed
where no load holds it: past its peak, and back.
"""

from dataclasses import replace

import numpy as np

from integration.arrays import Floats
from nmm.contact.following.linear_step import linear_step
from nmm.contact.following.path_problem import ROUNDED, PathProblem, PathStep
from nmm.controls.path_equation import PathEquation
from nmm.errors import SolveError
from nmm.solvers.linear import LinearSolver

# Iterations, and the out-of-balance force over the largest one at which they end.
ITERATIONS, CLOSE = 20, 1e-11
# Iterations cycle where so many of them leave more than this share of the least residual before.
FRUITLESS, FRUIT = 6, 0.7
# Halves of an iteration that are tried where the whole is worse in balance.
SHORTER = 4
# Iterations of the patient: faces that touch everywhere open some points at a time.
PATIENT_ITERATIONS = 60


def newton(
    problem: PathProblem,
    path: PathEquation,
    solver: LinearSolver,
    begin: PathStep,
    patient: bool = False,
) -> PathStep:
    """Return the last iterate; its residual says whether it is a solution.

    ``patient`` iterations take whole steps even where the residual grows: points that open one
    after another reduce it only when the last one has opened.

    Raises
    ------
    SolveError
        Where nothing holds a part.
    """
    step, outs = begin, [begin.residual]
    for count in range(1, (PATIENT_ITERATIONS if patient else ITERATIONS) + 1):
        further, along = linear_step(solver, problem.tangent(step), path, step)
        still = step.increment + further
        change = path.change(along, still, step.change)
        increment = still + change * along
        if not np.isfinite(increment).all():
            raise SolveError("the path has no next step: the load moves nothing that is controlled")
        end = increment, step.change + change
        found = problem.at(path, *end) if patient else _nearest(problem, path, step, end)
        stands = found.residual <= CLOSE or step.residual <= min(ROUNDED, 2 * found.residual)
        step = replace(found, iterations=count)
        # A part of an iteration may be in balance short of the target.
        if stands and found.short <= ROUNDED and count > 1:
            break
        outs.append(found.residual)
        if not patient and _to_and_fro(outs):
            break
    return step


def _to_and_fro(residuals: list[float]) -> bool:
    """Whether the last iterations made no progress."""
    # The first one leaves the guess, which may be in balance short of the target.
    last, before = residuals[-FRUITLESS:], residuals[1:-FRUITLESS]
    return bool(before) and min(last) > FRUIT * min(before)


def _nearest(
    problem: PathProblem, path: PathEquation, step: PathStep, end: tuple[Floats, float]
) -> PathStep:
    """Return the whole step of an iteration, or a part of it with a smaller residual."""
    best, share = problem.at(path, *end), 1.0
    for _ in range(SHORTER):
        if best.out <= step.out or best.residual <= ROUNDED:
            break
        share /= 2
        part = step.increment + share * (end[0] - step.increment)
        found = problem.at(path, part, step.change + share * (end[1] - step.change))
        best = min(best, found, key=lambda one: one.out)
    return best
