"""Anderson's mixing in compiled code: what whole arrays would do in six calls, in one."""

import numba as nb
import numpy as np

from integration.arrays import Floats

RIDGE = 1e-12
"""Part of the trace that keeps the least squares regular."""


@nb.njit(cache=True)
def add(
    sums: Floats,
    corrections: Floats,
    gram: Floats,
    at: int,
    used: int,
    step: Floats,
    new: Floats,
    old: Floats,
    force_new: Floats,
    force_old: Floats,
) -> None:
    """Put step, change of correction and their products in place ``at`` of ``used``."""
    for i in range(len(step)):
        corrections[at, i] = new[i] - old[i]
        sums[at, i] = step[i] + corrections[at, i]
    for j in range(used):
        total = 0.0
        for i in range(len(step)):
            total -= corrections[j, i] * (force_new[i] - force_old[i])
        gram[at, j] = gram[j, at] = total


@nb.njit(cache=True)
def mixed(
    sums: Floats, corrections: Floats, gram: Floats, used: int, correction: Floats, force: Floats
) -> Floats:
    """``correction`` combined with the remembered steps: least squares in the chord's matrix.

    The normal equations are solved by elimination with the largest pivot; where they are not
    finite or vanish the correction stays as it is.
    """
    trace = 0.0
    for k in range(used):
        trace += gram[k, k]
    result = correction.copy()
    if used == 0 or not (np.isfinite(trace) and trace > 0.0):
        return result
    table = np.empty((used, used + 1))
    for k in range(used):
        table[k, :used] = gram[k, :used]
        table[k, k] += RIDGE * trace
        total = 0.0
        for i in range(len(force)):
            total -= corrections[k, i] * force[i]
        table[k, used] = total
    for k in range(used):
        best = k
        for row in range(k + 1, used):
            if abs(table[row, k]) > abs(table[best, k]):
                best = row
        if not abs(table[best, k]) > 0.0:
            return result
        for column in range(k, used + 1):
            table[k, column], table[best, column] = table[best, column], table[k, column]
        for row in range(k + 1, used):
            share = table[row, k] / table[k, k]
            for column in range(k, used + 1):
                table[row, column] -= share * table[k, column]
    for k in range(used - 1, -1, -1):
        for column in range(k + 1, used):
            table[k, used] -= table[k, column] * table[column, used]
        table[k, used] /= table[k, k]
    for k in range(used):
        share = table[k, used]
        for i in range(len(result)):
            result[i] -= share * sums[k, i]
    return result
