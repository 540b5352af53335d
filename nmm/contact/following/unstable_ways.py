"""In how many ways a step of a path is not stable, by what softens in it.

With the tangent ``K`` at the end of a step, ``n`` of whose eigenvalues are negative, ``n - 1`` or
more are left where any one displacement is held, whichever a control holds (Cauchy's interlacing).
One is a load that falls. With two the path is one of several: on another one some of what softens
here unloads, and less is stored (Hill 1958; Bazant and Cedolin 1991, chapter 10).

Let ``M = K + R' D R`` have the slopes of unloading at the points that soften, ``R`` being the rows
of their jumps. It is definite, and ``K`` has as many negative eigenvalues as ``D R M^-1 R'`` has
beyond one. So functions that depend on one another, eigenvalues of nothing, do not count.
"""

import numpy as np
from scipy.linalg import block_diag
from scipy.sparse import vstack

from integration.arrays import Floats
from nmm.contact.following.path_problem import LOADED_FURTHER, PathProblem, PathStep
from nmm.errors import SolveError
from nmm.solvers.linear import LinearSolver

# Share of the largest slope by which one is negative.
SOFTENS = 1e-9
# An eigenvalue is beyond one by more than this, and real to this: at a limit it is one.
BEYOND = 1e-6


def unstable_ways(problem: PathProblem, end: PathStep, solver: LinearSolver) -> int:
    """Return the number of negative eigenvalues of the tangent at the end of a step.

    None are counted where a part is loose though what softens unloads.
    """
    slope = end.contacts.tangent
    soft = np.flatnonzero(_least(slope) < -SOFTENS * np.abs(slope).max(initial=0.0))
    if len(soft) == 0:
        return 0
    unloads = 1 - LOADED_FURTHER
    held = slope.copy()
    held[soft] = problem.law(unloads * problem.gap, unloads * problem.slip).tangent[soft]
    rows = vstack([problem.rows.normal[soft], problem.rows.tangent[soft]]).toarray()
    try:
        stable = solver.unsymmetric().factorise(problem.tangent(end, held))
        jumps = np.array([rows @ stable.solve(row) for row in rows])  # a solution each
    except SolveError:
        return 0
    fall = (held - slope)[soft]
    order = np.arange(2 * len(soft)).reshape(2, -1).T.ravel()  # both jumps of a point together
    values = np.linalg.eigvals(block_diag(*fall) @ jumps[np.ix_(order, order)])
    return int(np.sum((values.real > 1 + BEYOND) & (np.abs(values.imag) < BEYOND)))


def _least(slope: Floats) -> Floats:
    """Return the least eigenvalue (m,) of the symmetric part of slopes (m, 2, 2)."""
    mean, half = (slope[:, 0, 0] + slope[:, 1, 1]) / 2, (slope[:, 0, 0] - slope[:, 1, 1]) / 2
    return np.asarray(mean - np.hypot(half, (slope[:, 0, 1] + slope[:, 1, 0]) / 2))
