"""`modified_newton` in one compiled loop, for factors on substitution.

Residual, solution, mixing and judging of a pass call no Python. What it finds is what the plain
loop finds, to the last digits.
"""

import numpy as np

from integration.arrays import Floats
from nmm.compiled import compiled
from nmm.contact.iteration.options.budgets import Patience
from nmm.contact.problem.residual_kernel import SpringColumns, residual
from nmm.solvers.anderson import add_step, mixed_step
from nmm.solvers.frontal.frontal_factor import FrontalFactor
from nmm.solvers.frontal.numbers import substitution
from nmm.solvers.frontal.numbers.blas import Inside, Outside
from nmm.solvers.linear import Factor
from nmm.solvers.threads import OneThread

NEVER = Patience(-1.0)
"""Of a loop that is not lost however slow it is."""


def serves(factor: Factor) -> bool:
    """Whether the compiled loop can solve with a factor."""
    return isinstance(factor.decomposition, FrontalFactor)


def run(
    factor: Factor,
    springs: SpringColumns,
    start: tuple[Floats, Floats, float],
    budget: int,
    tolerance: float,
    patience: Patience | None,
    steer: tuple[int, float],
) -> tuple[Floats, Floats, float, int]:
    """Take passes; best unknowns, their out-of-balance force and its size, and solves.

    Parameters
    ----------
    springs
        The equations.
    start
        Unknowns (n,), out-of-balance force (n,) and its size.
    steer
        Last steps that are combined, and growth of the size that is put up with.
    """
    decomposition = factor.decomposition
    assert isinstance(decomposition, FrontalFactor)
    outside, plan = decomposition.for_loops
    x, force, size = start
    depth, growth = steer
    # Of one type each, so that the loop is compiled once.
    given = float(size), int(budget), float(tolerance)
    turn = int(depth), float(growth)
    with OneThread():
        found = loop(x, force, *given, terms(patience), turn, factor.scale, outside, plan, springs)
    increment, force, size, solves = found
    return increment, force, float(size), int(solves)


def terms(patience: Patience | None) -> tuple[float, float, int]:
    """Return a patience as `lost` takes it, of one type each: options may give whole numbers."""
    wait = patience or NEVER
    return float(wait.ahead), float(wait.below), int(wait.look)


@compiled
def loop(
    increment: Floats,
    force: Floats,
    size: float,
    budget: int,
    tolerance: float,
    patience: tuple[float, float, int],
    steer: tuple[int, float],
    scale: Floats,
    outside: Outside,
    plan: Inside,
    springs: SpringColumns,
) -> tuple[Floats, Floats, float, int]:
    """See `run`; ``outside``, ``plan`` and ``scale`` are those of the factor."""
    depth, growth = steer
    n, count, solves, known = len(increment), 0, 0, False
    sums, corrections = np.empty((depth, n)), np.empty((depth, n))
    gram, sizes, passes = np.zeros((depth, depth)), np.empty(budget + 2), 0
    best, best_force, best_size = increment, force, size
    at, correction, solution = increment, np.empty(n), np.empty(n)
    sizes[0] = size
    while best_size > tolerance and solves < budget:
        if not known:
            substitution.solve(outside, scale * force, plan, solution)
            correction, known, solves = -scale * solution, True, solves + 1
        used = min(count, depth)
        step = mixed_step(sums, corrections, gram, used, correction, force)
        there = at + step
        new_force, new_size = residual(there, springs)
        if count > 0 and not new_size < growth * best_size:
            count, at, force, known = 0, best, best_force, False
            continue
        if new_size <= tolerance:
            best, best_force, best_size = there, new_force, new_size
            break
        substitution.solve(outside, scale * new_force, plan, solution)
        new, solves = -scale * solution, solves + 1
        place, count = count % depth, count + 1
        used = min(count, depth)
        add_step(sums, corrections, gram, place, used, step, new, correction, new_force, force)
        at, force, correction = there, new_force, new
        if not np.isfinite(new_size):
            break
        if new_size < best_size:
            best, best_force, best_size = at, force, new_size
        passes += 1
        sizes[passes] = best_size
        if lost(sizes[: passes + 1], patience, tolerance):
            break
    return best, best_force, best_size, solves


@compiled
def lost(sizes: Floats, patience: tuple[float, float, int], tolerance: float) -> bool:
    """Whether the best ``sizes`` so far, one a solve, forecast too many solves."""
    ahead, below, look = patience
    last = len(sizes) - 1
    if ahead < 0 or last < look or not sizes[last] < below:
        return False
    gain = np.log(sizes[last - look] / sizes[last]) / look
    return not gain * ahead >= np.log(sizes[last] / tolerance)
