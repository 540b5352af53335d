"""Semismooth Newton on few unknowns in one compiled function: full matrices, Gauss's elimination.

`semismooth_newton` says the same by sparse matrices and factors of a solver, which cost a hundred
times their arithmetic where two blocks meet. What has no regular matrix is left to it.
"""

import math
from typing import Any

import numpy as np

from integration.arrays import Floats
from nmm.compiled import compiled
from nmm.contact.problem.cut_springs import CutSprings
from nmm.contact.problem.residual_kernel import SpringColumns, residual
from nmm.contact.problem.row_products import Compressed
from nmm.solvers.factor import PIVOT
from nmm.solvers.kernels.gauss import eliminated, substituted

REFINED = 2
"""Most steps of iterative refinement of a Newton step."""


def newton_in_full(
    springs: CutSprings, increment: Floats, tolerance: float, budget: int
) -> tuple[Floats, float, int] | None:
    """Return unknowns, relative out-of-balance force there, and steps taken; None if singular."""
    found, size, taken = _newton(increment, springs.columns, tolerance, budget)
    return None if taken < 0 else (found, size, taken)


@compiled
def _newton(increment: Floats, springs: SpringColumns, tolerance: float, budget: int) -> Any:
    """Newton steps while each halves the force, or two do; -1 steps where a pivot vanishes."""
    rest, size = residual(increment, springs)
    taken, at, risen = 0, increment, False
    while taken < budget and size > tolerance:
        step, regular = _solved(_matrix(at, springs), rest)
        if not regular:
            return increment, size, -1
        at, taken = at - step, taken + 1
        rest, left = residual(at, springs)
        halved = left < 0.5 * size
        if not halved and (risen or not np.isfinite(left)):
            break
        risen = not halved
        if halved:
            increment, size = at, left
    return increment, size, taken


@compiled
def _matrix(increment: Floats, springs: SpringColumns) -> Floats:
    """Matrix (n, n) of the step and of the tangents of its springs (Alart, Curnier 1991)."""
    pointers, rows, entries = springs.matrix
    stiff, hard = springs.stiffness
    n, m = len(increment), len(springs.gap)
    found = np.zeros((n, n))
    for j in range(n):
        for k in range(pointers[j], pointers[j + 1]):
            found[rows[k], j] += entries[k]
    normal, tangent = np.empty(n), np.empty(n)
    for c in range(m):
        opening = springs.gap[c] + _row(c, springs.normal_rows, increment, normal)
        sliding = springs.slip[c] + _row(c, springs.tangent_rows, increment, tangent)
        along, across, mixed = _slopes(
            stiff[c] * opening + springs.shift[0, c],
            hard[c] * sliding + springs.shift[1, c],
            springs.tension[c],
            springs.cohesion[c],
            springs.friction[c],
        )
        along, across, mixed = along * stiff[c], across * hard[c], mixed * stiff[c]
        for k in range(n):
            one, other = along * normal[k] + mixed * tangent[k], across * tangent[k]
            if one != 0.0 or other != 0.0:
                for j in range(n):
                    found[k, j] += one * normal[j] + other * tangent[j]
    return found


@compiled
def _slopes(
    pull: float, drag: float, tension: float, cohesion: float, friction: float
) -> tuple[float, float, float]:
    """`nmm.contact.problem.coulomb.tangent` of one contact."""
    is_open, held = pull > tension, min(pull, tension)
    lost = is_open and tension <= 0.0
    bound = friction * max(-held, 0.0) + (0.0 if lost else cohesion)
    acts = 0.0 if is_open else 1.0
    if not abs(drag) > bound:
        return acts, 0.0 if lost else 1.0, 0.0
    slope = friction if held < 0.0 else 0.0
    return acts, 0.0, -math.copysign(slope * acts, drag)


@compiled
def _row(c: int, rows: Compressed, increment: Floats, row: Floats) -> float:
    """Write row ``c`` of compressed ones in full to ``row`` (n,); return its product."""
    pointers, columns, entries = rows
    row[:] = 0.0
    moved = 0.0
    for k in range(pointers[c], pointers[c + 1]):
        row[columns[k]] += entries[k]
        moved += entries[k] * increment[columns[k]]
    return moved


@compiled
def _solved(matrix: Floats, load: Floats) -> tuple[Floats, bool]:
    """Solution (n,) refined with the matrix itself, and whether there is one."""
    n = len(load)
    scale = np.empty(n)
    for i in range(n):
        if not 0.0 < abs(matrix[i, i]) < math.inf:
            return load, False
        scale[i] = 1.0 / math.sqrt(abs(matrix[i, i]))
    triangles, order = np.empty((n, n)), np.arange(n)
    for i in range(n):
        for j in range(n):
            triangles[i, j] = scale[i] * matrix[i, j] * scale[j]
        triangles[i, i] += PIVOT
    if not eliminated(triangles, order):
        return load, False
    found, rest = np.zeros(n), load.copy()
    best, least = found, math.inf
    for _ in range(REFINED + 1):
        found = found + scale * substituted(triangles, order, scale * rest)
        square = 0.0
        for i in range(n):
            total = load[i]
            for j in range(n):
                total -= matrix[i, j] * found[j]
            rest[i] = total
            square += (scale[i] * total) ** 2
        if not square < least:
            break
        # Rounding has the last word where a turn does not halve what is left.
        stays = square > 0.25 * least
        best, least = found, square
        if stays:
            break
    return best, least < math.inf
