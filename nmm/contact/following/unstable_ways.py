"""In how many ways a step of a path is not stable, by what softens in it.

With the tangent ``K`` at the end of a step, ``n`` of whose eigenvalues are negative, ``n - 1`` or
more are left where any one displacement is held, whichever a control holds (Cauchy's interlacing).
One is a load that falls. With two the path is one of several: on another one some of what softens
here unloads, and less is stored (Hill 1958; Bazant and Cedolin 1991, chapter 10).

Let ``M = K + R' D R`` rise by as much as ``K`` falls at the points that soften, ``R`` being the
rows of their jumps. It is definite, and ``K`` has as many negative eigenvalues as ``D R M^-1 R'``
has beyond one. So functions that depend on one another, eigenvalues of nothing, do not count.
"""

import numpy as np
from scipy.linalg import block_diag
from scipy.sparse import vstack

from integration.arrays import Floats
from nmm.contact.following.path_problem import PathProblem, PathStep
from nmm.errors import SolveError
from nmm.solvers.linear import LinearSolver

# An eigenvalue is beyond one by more than this, and real to this: at a limit it is one.
BEYOND = 1e-6


def unstable_ways(problem: PathProblem, end: PathStep, solver: LinearSolver) -> int:
    """Return the number of negative eigenvalues of the tangent at the end of a step.

    None are counted where a part is loose though what softens resists as much.
    """
    slope = end.contacts.tangent
    risen = _risen(slope)
    fall = risen - slope
    soft = np.flatnonzero(np.abs(fall).max(axis=(1, 2), initial=0.0) > 0)
    if len(soft) == 0:
        return 0
    rows = vstack([problem.rows.normal[soft], problem.rows.tangent[soft]]).toarray()
    try:
        stable = solver.unsymmetric().factorise(problem.tangent(end, risen))
        jumps = np.array([rows @ stable.solve(row) for row in rows])  # a solution each
    except SolveError:
        return 0
    order = np.arange(2 * len(soft)).reshape(2, -1).T.ravel()  # both jumps of a point together
    values = np.linalg.eigvals(block_diag(*fall[soft]) @ jumps[np.ix_(order, order)])
    return int(np.sum((values.real > 1 + BEYOND) & (np.abs(values.imag) < BEYOND)))


def _risen(slope: Floats) -> Floats:
    """Return slopes (m, 2, 2) with the sizes of their negative eigenvalues in place of these."""
    values, ways = np.linalg.eig(slope)
    falls = (values.imag == 0) & (values.real < 0)
    soft = falls.any(axis=1)
    ways, values = ways[soft], np.where(falls, -values, values)[soft]
    risen = slope.copy()
    risen[soft] = (ways @ (values[:, :, None] * np.linalg.inv(ways))).real
    return risen
