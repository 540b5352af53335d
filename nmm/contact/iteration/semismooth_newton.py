"""Semismooth Newton on Coulomb's law: fast near a solution, not safe far from it."""

from integration.arrays import Floats
from nmm.contact.iteration.full_newton import newton_in_full
from nmm.contact.problem.cut_springs import CutSprings, IterationResult
from nmm.contact.problem.matrix_pattern import SpringPattern
from nmm.solvers.linear import LinearSolver


def polish(
    springs: CutSprings,
    pattern: SpringPattern,
    linear: LinearSolver,
    increment: Floats,
    tolerance: float,
    budget: int = 8,
) -> IterationResult:
    """Take full Newton steps while each halves the out-of-balance force.

    The tangent of a sliding contact follows the bound: its shear force changes with the normal
    force by the friction coefficient (Alart, Curnier 1991), so the matrix is unsymmetric and
    ``linear`` must be a solver for such. Where it would factorise full matrices all of it is one
    compiled function.
    """
    problem = springs.problem
    if linear.in_full(len(increment)):
        full = newton_in_full(springs, increment, tolerance, budget)
        if full is not None:
            return _result(springs, *full)
    residual = springs.residual(increment)
    taken = 0
    while taken < budget and residual.size > tolerance:
        matrix = pattern.matrix(problem, *springs.tangent(increment))
        step = linear.factorise(matrix).refined(residual.force)
        taken += 1
        found = springs.residual(increment - step)
        if not found.size < 0.5 * residual.size:
            break
        increment, residual = increment - step, found
    return _result(springs, increment, residual.size, taken)


def _result(springs: CutSprings, increment: Floats, size: float, taken: int) -> IterationResult:
    story = f"Newton with {taken} factorisation{'' if taken == 1 else 's'}"
    return IterationResult(springs, increment, size, taken, taken, story)
