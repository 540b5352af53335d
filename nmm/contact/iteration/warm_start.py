"""Where the search for a step's unknowns starts: a mix of what the last steps moved.

A motion goes on as it did in the last steps, so that the combination of their unknowns with the
least out-of-balance force is near: on walls of bricks three to six times nearer than the unknowns
of the last step alone, with two thirds of their contacts in a wrong state. In statics no inertia
says where a loose piece belongs: what starts from a mix may leave it anywhere.
"""

from typing import Any

import numpy as np

from integration.arrays import Floats
from nmm.compiled import compiled
from nmm.contact.problem.cut_springs import CutSprings
from nmm.contact.problem.residual_kernel import residual

MIX_RIDGE = 1e-10
"""Part of the trace that keeps the least squares regular where the last steps were alike."""


def start_from(springs: CutSprings, known: list[Floats], mixes: bool) -> Floats:
    """Unknowns (n,) to start from: nothing, those ``known`` last, or a mix of all of them.

    Parameters
    ----------
    springs
        The equations of the step.
    known
        (n,) unknowns of the last steps, latest first.
    mixes
        Whether a mix ``sum a_i d_i``, ``sum a_i = 1``, may be: of the least weighted out-of-balance
        force as far as that is linear between the ``d_i`` (minimal residuals over past solutions,
        Fischer 1998).
    """
    points = [np.zeros_like(springs.problem.force), *known[: None if mixes else 1]]
    if len(points) == 1:
        return points[0]
    found: Floats = _nearest(np.stack(points), mixes, springs.columns)
    return found


@compiled
def _nearest(points: Floats, mixes: bool, columns: Any) -> Floats:
    """Unknowns (n,) of the least out-of-balance force among ``points`` (k, n) and their mix."""
    count, weight = len(points), columns[1]
    forces, sizes, order = np.empty_like(points), np.empty(count), np.arange(count)
    for i in range(count):
        forces[i], sizes[i] = residual(points[i], *columns)
    best = 0
    for i in range(1, count):
        if sizes[i] < sizes[best]:
            best = i
    if not mixes:
        alone: Floats = points[best].copy()
        return alone
    for i in range(best, 0, -1):
        order[i] = i - 1
    order[0] = best
    mixed: Floats = _mixed(points[order], forces[order], weight)
    _, size = residual(mixed, *columns)
    if not size < sizes[best]:
        mixed = points[best].copy()
    return mixed


@compiled
def _mixed(points: Floats, forces: Floats, weight: Floats) -> Floats:
    """Mix (n,) of ``points`` (k, n) of the least weighted force, on lines from the first.

    The normal equations are positive definite by their ridge; where they are not finite or vanish
    it is the first point.
    """
    count, n = points.shape[0] - 1, len(weight)
    table = np.zeros((count, count + 1))
    for k in range(n):
        square = weight[k] ** 2
        for i in range(count):
            way = forces[i + 1, k] - forces[0, k]
            table[i, count] -= square * way * forces[0, k]
            for j in range(i + 1):
                table[i, j] += square * way * (forces[j + 1, k] - forces[0, k])
    trace = 0.0
    for i in range(count):
        trace += table[i, i]
        for j in range(i):
            table[j, i] = table[i, j]
    found: Floats = points[0].copy()
    if not (np.isfinite(trace) and trace > 0.0):
        return found
    for i in range(count):
        table[i, i] += MIX_RIDGE * trace
    for i in range(count):
        for row in range(i + 1, count):
            share = table[row, i] / table[i, i]
            for column in range(i, count + 1):
                table[row, column] -= share * table[i, column]
    for i in range(count - 1, -1, -1):
        for column in range(i + 1, count):
            table[i, count] -= table[i, column] * table[column, count]
        table[i, count] /= table[i, i]
        found += table[i, count] * (points[i + 1] - points[0])
    return found
