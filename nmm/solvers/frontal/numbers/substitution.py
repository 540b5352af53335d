"""Solutions by factors on fronts: substitution forwards and backwards, front by front."""

from typing import Any

import numpy as np
import numpy.typing as npt

from integration.arrays import Floats
from nmm.compiled import compiled, place
from nmm.solvers.frontal.numbers import blas
from nmm.solvers.frontal.numbers.blas import Inside, Outside
from nmm.solvers.frontal.numbers.inverted import multiply


@compiled
def solve(outside: Outside, rhs: Floats, inside: Inside, solution: Floats) -> None:
    """Fill in the solution for one right-hand side: arrays are slow to return.

    It is found in the precision of the panels. The load is scaled to about one, by a power of two
    which changes no digit: single precision has no small numbers.
    """
    order, _, _, _, _, _, panels, _, inverted = inside
    n, top = len(rhs), 0.0
    for k in range(n):
        top = max(top, abs(rhs[k]))
    unit = 2.0 ** np.floor(np.log2(top)) if 0.0 < top < np.inf else 1.0
    x = np.empty(n, dtype=panels.dtype)
    for k in range(n):
        x[k] = rhs[place(order[k])] / unit
    if inverted:
        multiply(outside, inside, x)
    else:
        substitute(outside, inside, x)
    for k in range(n):
        solution[place(order[k])] = unit * x[k]


@compiled
def substitute(outside: Outside, inside: Inside, x: npt.NDArray[Any]) -> None:
    """Turn an ordered load ``x`` (n,) into its solution."""
    work = np.empty(len(x), dtype=x.dtype)
    _forwards(outside, inside, x, work)
    _backwards(outside, inside, x, work)


@compiled
def _forwards(
    outside: Outside, inside: Inside, x: npt.NDArray[Any], work: npt.NDArray[Any]
) -> None:
    kernels, letters, sizes, scalars = outside
    _, first, row_start, rows, panel_start, _, panels, swaps, _ = inside
    at, n_c, one = letters.ctypes.data, sizes.ctypes.data, scalars.ctypes.data
    low, plain, high = at, at + 1, at + 4
    n_r, n_h, step = n_c + 4, n_c + 8, n_c + 12
    minus, zero = one + scalars.itemsize, one + 2 * scalars.itemsize
    symmetric, ends = len(swaps) == 0, work.ctypes.data
    diagonal = plain if symmetric else high  # that of L is ones in LU
    sizes[3] = 1
    for s in range(len(first) - 1):
        c, r = first[s + 1] - first[s], row_start[s + 1] - row_start[s]
        sizes[0], sizes[1], sizes[2] = c, r, c + r
        if not symmetric:
            for k in range(first[s], first[s + 1]):
                other = first[s] + swaps[k] - 1
                x[k], x[other] = x[other], x[k]
        own, block = x[first[s] :].ctypes.data, panels[panel_start[s] :].ctypes.data
        blas.call8(kernels[3], (low, plain, diagonal, n_c, block, n_h, own, step))
        if r > 0:
            left = panels[panel_start[s] + c :].ctypes.data
            blas.call11(
                kernels[4], (plain, n_r, n_c, minus, left, n_h, own, step, zero, ends, step)
            )
            for k in range(r):
                x[place(rows[row_start[s] + k])] += work[k]


@compiled
def _backwards(
    outside: Outside, inside: Inside, x: npt.NDArray[Any], work: npt.NDArray[Any]
) -> None:
    kernels, letters, sizes, scalars = outside
    _, first, row_start, rows, panel_start, beside_start, panels, swaps, _ = inside
    at, n_c, one = letters.ctypes.data, sizes.ctypes.data, scalars.ctypes.data
    low, plain, turned, high = at, at + 1, at + 3, at + 4
    n_r, n_h, step, minus = n_c + 4, n_c + 8, n_c + 12, one + scalars.itemsize
    symmetric, ends = len(swaps) == 0, work.ctypes.data
    sizes[3] = 1
    for s in range(len(first) - 2, -1, -1):
        c, r = first[s + 1] - first[s], row_start[s + 1] - row_start[s]
        sizes[0], sizes[1], sizes[2] = c, r, c + r
        own, block = x[first[s] :].ctypes.data, panels[panel_start[s] :].ctypes.data
        for k in range(r):
            work[k] = x[place(rows[row_start[s] + k])]
        # What stands right of the pivots: the transpose of L, or rows of U kept by columns.
        right = panels[panel_start[s] + c :] if symmetric else panels[beside_start[s] :]
        stride = n_h if symmetric else n_r
        if r > 0:
            blas.call11(
                kernels[4],
                (turned, n_r, n_c, minus, right.ctypes.data, stride, ends, step, one, own, step),
            )
        if symmetric:
            blas.call8(kernels[3], (low, turned, plain, n_c, block, n_h, own, step))
        else:
            blas.call8(kernels[3], (high, plain, plain, n_c, block, n_h, own, step))
