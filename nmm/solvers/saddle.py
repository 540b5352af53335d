"""Systems with conditions held by multipliers, zeros on the diagonal, and their scaling."""

import numpy as np

from integration.arrays import Floats
from integration.sparse import csc_array, csr_array, hstack, vstack
from nmm.solvers.scaling import ruiz_scale
from nmm.solvers.unchecked import largest

# Conditions are linked to stiff unknowns over at most so many free ones.
LINKS = 20
# An entry below this share of the largest of its column is rounding and no link.
ROUNDED = 1e-12


def bordered(matrix: csc_array, rows: csr_array) -> csc_array:
    """Return ``[[A, C^T], [C, 0]]`` of a matrix (n, n) and the rows ``C`` (k, n) of conditions."""
    k = rows.shape[0]
    upper = hstack([matrix, csr_array(rows.T)])
    lower = hstack([rows, csr_array((k, k))])
    return csc_array(vstack([upper, lower]))


def saddle_scale(matrix: csc_array) -> Floats:
    """(n,) factors: unknowns by their stiffness, multipliers by that of their conditions.

    With ``D`` the positive part of the diagonal a condition ``c`` is scaled by the root of
    ``c D^-1 c^T``, so that its pivot after elimination is about one. What has neither a stiffness
    nor a link to one, a translation of a glued block, takes the scale of its largest condition.
    Scaling by the largest entry instead makes of a block without springs a stiff one, and loses
    the digits of its strain.
    """
    diagonal = np.abs(matrix.diagonal())
    known = diagonal > 0
    scale = np.where(known, 1 / np.sqrt(np.where(known, diagonal, 1.0)), 0.0)
    square = csc_array((_links(matrix) ** 2, matrix.indices, matrix.indptr), shape=matrix.shape)
    for _ in range(LINKS):  # from stiff unknowns to conditions, and on
        if known.all():
            break
        reach = np.sqrt(square.T @ scale**2)
        found = ~known & (reach > 0)
        if not found.any():
            break
        scale = np.where(found, 1 / np.where(found, reach, 1.0), scale)
        known |= found
    return np.asarray(np.where(known, scale, 1.0))


def equilibrated_scale(matrix: csc_array) -> Floats:
    """(n,) factors by the largest entries, or by the stiffness of conditions on zero diagonals."""
    return ruiz_scale(matrix) if matrix.diagonal().all() else saddle_scale(matrix)


def _links(matrix: csc_array) -> Floats:
    """Entries, zero where they are rounding beside others of their column."""
    size = np.abs(matrix.data)
    beside = np.repeat(largest(matrix), np.diff(matrix.indptr))
    return np.asarray(np.where(size > ROUNDED * beside, matrix.data, 0.0))
