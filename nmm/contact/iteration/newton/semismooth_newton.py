"""Semismooth Newton on Coulomb's law: fast near a solution, not safe far from it."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from integration.arrays import Floats
from nmm.contact.iteration.newton.full_newton import newton_in_full
from nmm.contact.problem.cut_springs import CutSprings, IterationResult
from nmm.contact.problem.matrix_pattern import SpringPattern
from nmm.solvers.linear import Factor, LinearSolver

STEPS = 8
"""Most steps from one point."""
GAIN = 0.1
"""Part of the force that a step with the tangent of another point must leave at most."""


def polish(
    springs: CutSprings,
    pattern: Callable[[], SpringPattern],
    linear: LinearSolver,
    increment: Floats,
    tolerance: float,
    keep: Callable[[Factor], None] = lambda factor: None,
) -> IterationResult:
    """Take full Newton steps while each halves the out-of-balance force, or two together do.

    The step that sets the last wrong states right may raise the force before the next ends it.

    The tangent of a sliding contact follows the bound: its shear force changes with the normal
    force by the friction coefficient (Alart, Curnier 1991), so the matrix is unsymmetric and
    ``linear`` must be a solver for such. Where it would factorise full matrices all of it is one
    compiled function, which asks for no ``pattern``. Each factor is handed to ``keep``.
    """
    problem = springs.problem
    if linear.in_full(len(increment)):
        full = newton_in_full(springs, increment, tolerance, STEPS)
        if full is not None:
            return _result(springs, *full)
    residual = springs.residual(increment)
    taken, at, rest, risen = 0, increment, residual, False
    while taken < STEPS and residual.size > tolerance:
        matrix = pattern().matrix(problem, *springs.tangent(at))
        factor = linear.factorise(matrix)
        keep(factor)
        at = at - factor.refined(rest.force)
        taken, rest = taken + 1, springs.residual(at)
        halved = rest.size < 0.5 * residual.size
        if not halved and (risen or not np.isfinite(rest.size)):
            break
        risen = not halved
        if halved:
            increment, residual = at, rest
    return _result(springs, increment, residual.size, taken)


def chords(found: IterationResult, factor: Factor, tolerance: float) -> IterationResult:
    """Take Newton steps with a ``factor`` of another point while each leaves a tenth of the force.

    The tangent of the last solution of a step is that of the next one, where rows have but turned.
    """
    best = found
    while best.size > tolerance:
        rest = best.springs.residual(best.increment)
        increment = best.increment - factor.apply(rest.force)
        size, solves = best.springs.residual(increment).size, best.solves + 1
        best = replace(best, solves=solves, story=f"{solves} solves with the last tangent")
        if not size < GAIN * best.size:
            break
        best = replace(best, increment=increment, size=size)
    return best


def _result(springs: CutSprings, increment: Floats, size: float, taken: int) -> IterationResult:
    story = f"Newton with {taken} factorisation{'' if taken == 1 else 's'}"
    return IterationResult(springs, increment, size, taken, taken, story)
