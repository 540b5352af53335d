"""Newton's method on balance and path equation together (Riks 1979; Crisfield 1981).

Contacts answer by their laws' own tangents, softening ones among them, so that a path is followed
where no load holds it: past its peak, and back.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from scipy.sparse import csc_array, csr_array, diags_array

from integration.arrays import Floats
from nmm.contact.following.path_equation import PathEquation
from nmm.contact.laws.tractions import ContactForces
from nmm.contact.points.midpoint import ContactRows
from nmm.errors import SolveError
from nmm.solvers.linear import LinearSolver

# Iterations of a step, out-of-balance force over the largest one at which they end, and that below
# which an iteration that no longer helps is rounding.
ITERATIONS, CLOSE, ROUNDED = 60, 1e-11, 1e-8
# Halves of an iteration that are tried where the whole is worse in balance.
SHORTER = 4

# From gaps and slips (m,) to forces.
Law = Callable[[Floats, Floats], ContactForces]


@dataclass(frozen=True)
class PathProblem:
    """Balance of a step along a path.

    Attributes
    ----------
    matrix, force
        (n, n) and (n,) of all but contacts, at the load factor of the start.
    rows
        Of the contacts.
    gap, slip
        (m,) at the start (m).
    law
        What contacts answer.
    scale
        Force (N) beside which what is out of balance is small; that of contacts and load besides.
    """

    matrix: csc_array
    force: Floats
    rows: ContactRows
    gap: Floats
    slip: Floats
    law: Law
    scale: float


@dataclass(frozen=True)
class PathStep:
    """Solution of a step.

    Attributes
    ----------
    increment
        (n,) unknowns.
    change
        Of the load factor.
    contacts
        What contacts answer.
    gap, slip
        (m,) at the end (m).
    rest, residual
        Out-of-balance force (N), and the same over the largest force.
    iterations
        Linear systems solved.
    """

    increment: Floats
    change: float
    contacts: ContactForces
    gap: Floats
    slip: Floats
    rest: float
    residual: float
    iterations: int = 0

    @property
    def converged(self) -> bool:
        """Whether forces are in balance."""
        return self.residual <= ROUNDED


def follow(problem: PathProblem, path: PathEquation, solver: LinearSolver) -> PathStep:
    """Solve a step along a path.

    Raises
    ------
    SolveError
        Where nothing holds a part.
    """
    step = _at(problem, path, np.zeros_like(problem.force), 0.0)
    for count in range(1, ITERATIONS + 1):
        factor = solver.unsymmetric().factorise(_tangent(problem, step.contacts))
        rest = _rest(problem, path, step)
        along = factor.solve(path.load)
        # What is left is rounding in the end, which dependent functions cannot follow: the balance
        # of the iterate judges it.
        still = step.increment + factor.refined(rest)
        change = path.change(along, still, step.change)
        increment = still + change * along
        if not np.isfinite(increment).all():
            raise SolveError("the path has no next step: the load moves nothing that is controlled")
        found = _nearest(problem, path, step, (increment, step.change + change))
        found = replace(found, iterations=count)
        stands = found.residual <= CLOSE or step.residual <= min(ROUNDED, 2 * found.residual)
        step = found
        if stands and count > 1:
            break
    return step


def _nearest(
    problem: PathProblem, path: PathEquation, step: PathStep, end: tuple[Floats, float]
) -> PathStep:
    """Return the whole step of an iteration, or a part of it that is better in balance."""
    best, share = _at(problem, path, *end), 1.0
    for _ in range(SHORTER):
        if best.rest <= step.rest or best.residual <= ROUNDED:
            break
        share /= 2
        part = step.increment + share * (end[0] - step.increment)
        found = _at(problem, path, part, step.change + share * (end[1] - step.change))
        best = min(best, found, key=lambda one: one.rest)
    return best


def _at(problem: PathProblem, path: PathEquation, increment: Floats, change: float) -> PathStep:
    gap = problem.gap + problem.rows.normal @ increment
    slip = problem.slip + problem.rows.tangent @ increment
    found = PathStep(increment, change, problem.law(gap, slip), gap, slip, np.inf, np.inf)
    rest = _rest(problem, path, found)
    pushed = problem.rows.push(*np.abs(found.contacts.force.T))
    size = max(
        problem.scale,
        float(np.linalg.norm(pushed)),
        abs(change) * float(np.linalg.norm(path.load)),
    )
    out = float(np.linalg.norm(rest))
    return replace(found, rest=out, residual=out / (size or 1.0))


def _rest(problem: PathProblem, path: PathEquation, step: PathStep) -> Floats:
    """Out-of-balance force (n,)."""
    inner = problem.matrix @ step.increment + problem.rows.push(*step.contacts.force.T)
    return np.asarray(problem.force + step.change * path.load - inner)


def _tangent(problem: PathProblem, contacts: ContactForces) -> csc_array:
    normal, tangent = problem.rows.normal, problem.rows.tangent
    slope = contacts.tangent
    total = problem.matrix
    if not len(slope):
        return total
    for one, row in ((0, normal), (1, tangent)):
        part = diags_array(slope[:, one, 0]) @ normal + diags_array(slope[:, one, 1]) @ tangent
        total = csc_array(total + csr_array(row).T @ part)
    return total
