"""Semismooth Newton on Coulomb's law: fast near a solution, not safe far from it."""

from integration.arrays import Floats
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
    ``linear`` must be a solver for such.
    """
    problem = springs.problem
    residual = springs.residual(increment)
    taken = solves = 0
    while taken < budget and residual.size > tolerance:
        matrix = pattern.matrix(problem, *springs.tangent(increment))
        step = linear.factorise(matrix).refined(residual.force)
        taken, solves = taken + 1, solves + 1
        found = springs.residual(increment - step)
        if not found.size < 0.5 * residual.size:
            break
        increment, residual = increment - step, found
    return IterationResult(
        springs,
        increment,
        residual.size,
        solves,
        taken,
        f"Newton with {taken} factorisation{'' if taken == 1 else 's'}",
    )
