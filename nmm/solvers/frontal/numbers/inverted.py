"""Cholesky factors whose pivot blocks are inverted once: a solution is two products a front.

A panel holds ``L_p`` of its pivots over ``L_b`` below. In their place stand ``L_p^-1`` over
``L_b L_p^-1``: forwards one product gives the pivots' unknowns and what they take from those
below, backwards its transpose does. Substitution within small blocks waits for one unknown after
the other; without it a solution takes 0.7 of the time. To invert takes as long as 10 solutions.
"""

from typing import Any

import numpy as np
import numpy.typing as npt

from integration.arrays import Ints
from nmm.compiled import compiled, place
from nmm.solvers.frontal.numbers import blas
from nmm.solvers.frontal.numbers.blas import Inside, Outside


@compiled
def invert(
    outside: Outside,
    first: Ints,
    row_start: Ints,
    panel_start: Ints,
    panels: npt.NDArray[Any],
) -> None:
    """Put inverses in the place of pivot blocks; kernels are trtri and trsm."""
    kernels, letters, sizes, scalars = outside
    at, n_c, one = letters.ctypes.data, sizes.ctypes.data, scalars.ctypes.data
    low, plain, right = at, at + 1, at + 2
    n_r, n_h, info = n_c + 4, n_c + 8, n_c + 12
    for s in range(len(first) - 1):
        c, r = first[s + 1] - first[s], row_start[s + 1] - row_start[s]
        sizes[0], sizes[1], sizes[2] = c, r, c + r
        panel = panels[panel_start[s] :]
        block, below = panel.ctypes.data, panel[c:].ctypes.data
        if r > 0:
            blas.call11(
                kernels[1], (right, low, plain, plain, n_r, n_c, one, block, n_h, below, n_h)
            )
        blas.call6(kernels[0], (low, plain, n_c, block, n_h, info))
        for j in range(1, c):
            for i in range(j):
                panel[j * (c + r) + i] = 0.0


@compiled
def multiply(outside: Outside, inside: Inside, x: npt.NDArray[Any]) -> None:
    """Turn an ordered load ``x`` (n,) into its solution."""
    kernels, letters, sizes, scalars = outside
    _, first, row_start, rows, panel_start, _, panels, _, _ = inside
    work = np.empty(len(x), dtype=panels.dtype)
    at, n_c, one = letters.ctypes.data, sizes.ctypes.data, scalars.ctypes.data
    plain, turned, n_h, step = at + 1, at + 3, n_c + 8, n_c + 12
    zero, ends = one + 2 * scalars.itemsize, work.ctypes.data
    sizes[3] = 1
    count = len(first) - 1
    for s in range(count):
        f, low = first[s], row_start[s]
        c, r = first[s + 1] - f, row_start[s + 1] - low
        sizes[0], sizes[2] = c, c + r
        own, panel = x[f:].ctypes.data, panels[panel_start[s] :].ctypes.data
        blas.call11(kernels[4], (plain, n_h, n_c, one, panel, n_h, own, step, zero, ends, step))
        for k in range(c):
            x[f + k] = work[k]
        for k in range(r):
            x[place(rows[low + k])] -= work[c + k]
    for s in range(count - 1, -1, -1):
        f, low = first[s], row_start[s]
        c, r = first[s + 1] - f, row_start[s + 1] - low
        sizes[0], sizes[2] = c, c + r
        for k in range(c):
            work[k] = x[f + k]
        for k in range(r):
            work[c + k] = -x[place(rows[low + k])]
        own, panel = x[f:].ctypes.data, panels[panel_start[s] :].ctypes.data
        blas.call11(kernels[4], (turned, n_h, n_c, one, panel, n_h, ends, step, zero, own, step))
