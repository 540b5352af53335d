"""Gauss's elimination of a few equations, in compiled functions."""

import numpy as np

from integration.arrays import Floats, Ints
from nmm.compiled import compiled


@compiled
def eliminated(triangles: Floats, order: Ints) -> bool:
    """Whether a matrix (n, n) has both triangles, which are made in place.

    Rows change places for the largest pivots, and ``order`` (n,) with them.
    """
    n = len(order)
    for k in range(n):
        pivot = k
        for i in range(k + 1, n):
            if abs(triangles[i, k]) > abs(triangles[pivot, k]):
                pivot = i
        if not abs(triangles[pivot, k]) > 0.0:
            return False
        if pivot != k:
            order[k], order[pivot] = order[pivot], order[k]
            for j in range(n):
                held = triangles[k, j]
                triangles[k, j], triangles[pivot, j] = triangles[pivot, j], held
        for i in range(k + 1, n):
            share = triangles[i, k] / triangles[k, k]
            triangles[i, k] = share
            if share != 0.0:
                for j in range(k + 1, n):
                    triangles[i, j] -= share * triangles[k, j]
    return True


@compiled
def substituted(triangles: Floats, order: Ints, load: Floats) -> Floats:
    """Solution (n,) by triangles whose rows were exchanged to ``order`` (n,)."""
    n = len(order)
    found = np.empty(n)
    for i in range(n):
        found[i] = load[order[i]]
        for j in range(i):
            found[i] -= triangles[i, j] * found[j]
    for i in range(n - 1, -1, -1):
        for j in range(i + 1, n):
            found[i] -= triangles[i, j] * found[j]
        found[i] /= triangles[i, i]
    return found


@compiled
def ridged(table: Floats, load: Floats, ridge: float) -> Floats:
    """Solution (n,) of normal equations (n, n), with a share of their trace put on their diagonal.

    It is zero where they are not finite or vanish.
    """
    trace = 0.0
    for k in range(len(load)):
        trace += table[k, k]
    order = np.arange(len(load))
    if np.isfinite(trace) and trace > 0.0:
        for k in range(len(load)):
            table[k, k] += ridge * trace
        if eliminated(table, order):
            return substituted(table, order, load)
    return np.zeros(len(load))
