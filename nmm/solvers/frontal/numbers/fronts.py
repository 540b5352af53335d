"""Numbers of multifrontal factorisations on a plan of fronts: Cholesky and LU (Duff, Reid 1983/84).

Panels hold the factor of the pivot block with ``L`` below. For LU, rows are exchanged within the
pivot block of a front alone, so the plan of a symmetric pattern stands whatever the numbers are;
the transpose of ``U`` beside the pivot block is kept behind all panels. What differs depends on
whether there is room for exchanges, ``swaps``; the two share all that runs over fronts.
"""

import numpy as np

from integration.arrays import Floats, Index, Ints
from nmm.compiled import compiled, place
from nmm.solvers.frontal.numbers import blas
from nmm.solvers.frontal.numbers.blas import Outside
from nmm.solvers.frontal.numbers.extend_add import collect_lower, collect_whole, runs


@compiled
def factorise(
    outside: Outside,
    data: Floats,
    source: Ints,
    target: Ints,
    n_children: Ints,
    first: Ints,
    row_start: Ints,
    rows: Ints,
    panel_start: Ints,
    beside_start: Ints,
    panels: Floats,
    swaps: Index,
    stack: Floats,
) -> int:
    """Fill panels and exchanges of rows; the first place whose pivot will not do (-1: none)."""
    symmetric = len(swaps) == 0
    panels[: panel_start[-1] if symmetric else beside_start[-1]] = 0.0
    for k in range(len(source)):
        panels[place(target[k])] += data[place(source[k])]
    count = len(first) - 1
    held = np.empty(count, dtype=np.int64)  # supernodes whose updates are on the stack
    base = np.empty(count + 1, dtype=np.int64)
    base[0] = 0
    n_held = 0
    local = np.empty(first[-1], dtype=np.int64)
    start = np.empty(first[-1], dtype=np.int64)
    shift = np.empty(first[-1], dtype=np.int64)
    for s in range(count):
        c, r = first[s + 1] - first[s], row_start[s + 1] - row_start[s]
        panel = panels[panel_start[s] : panel_start[s + 1]]
        beside = panel[:0] if symmetric else panels[beside_start[s] : beside_start[s + 1]]
        update = stack[base[n_held] : base[n_held] + r * r]
        update[:] = 0.0
        for k in range(c):
            local[first[s] + k] = k
        for k in range(r):
            local[rows[row_start[s] + k]] = c + k
        for _ in range(n_children[s]):
            child = held[n_held - 1]
            n_held -= 1
            joining = rows[row_start[child] : row_start[child + 1]]
            starts, moves = runs(joining, local, c, start, shift)
            part = stack[base[n_held] : base[n_held + 1]]
            if symmetric:
                collect_lower(panel, update, part, c, r, starts, moves)
            else:
                collect_whole(panel, beside, update, part, c, r, starts, moves)
        if symmetric:
            bad = _cholesky(outside, c, r, panel, update)
        else:
            bad = _lu(outside, c, r, panel, beside, swaps[first[s] : first[s + 1]], update)
        if bad != 0:
            return int(first[s] + bad - 1)
        if r > 0:
            bottom = base[n_held]
            if n_children[s] > 0:
                for k in range(r * r):  # down to where the children's updates were
                    stack[bottom + k] = update[k]
            held[n_held] = s
            n_held += 1
            base[n_held] = bottom + r * r
    return -1


@compiled
def _cholesky(outside: Outside, c: int, r: int, panel: Floats, update: Floats) -> int:
    """Factorise a front of ``c`` pivots over ``r`` rows; its pivot that will not do, else 0."""
    kernels, letters, sizes, scalars = outside
    at, n_c, one = letters.ctypes.data, sizes.ctypes.data, scalars.ctypes.data
    low, plain, right, turned = at, at + 1, at + 2, at + 3
    n_r, n_h, info, minus = n_c + 4, n_c + 8, n_c + 12, one + scalars.itemsize
    sizes[0], sizes[1], sizes[2] = c, r, c + r
    block = panel.ctypes.data
    blas.call5(kernels[0], (low, n_c, block, n_h, info))
    if sizes[3] == 0 and r > 0:
        left, new = panel[c:].ctypes.data, update.ctypes.data
        blas.call11(kernels[1], (right, low, turned, plain, n_r, n_c, one, block, n_h, left, n_h))
        blas.call10(kernels[2], (low, plain, n_r, n_c, minus, left, n_h, one, new, n_r))
    return int(sizes[3])


@compiled
def _lu(
    outside: Outside, c: int, r: int, panel: Floats, beside: Floats, swap: Index, update: Floats
) -> int:
    """Do the same for ``L U``, with rows exchanged among the pivots."""
    kernels, letters, sizes, scalars = outside
    at, n_c, one = letters.ctypes.data, sizes.ctypes.data, scalars.ctypes.data
    low, plain, right, turned, high = at, at + 1, at + 2, at + 3, at + 4
    n_r, n_h, info, minus = n_c + 4, n_c + 8, n_c + 12, one + scalars.itemsize
    sizes[0], sizes[1], sizes[2] = c, r, c + r
    block = panel.ctypes.data
    blas.call6(kernels[0], (n_c, n_c, block, n_h, swap.ctypes.data, info))
    if sizes[3] == 0 and r > 0:
        _exchange(beside, swap, r)
        left, top, new = panel[c:].ctypes.data, beside.ctypes.data, update.ctypes.data
        blas.call11(kernels[1], (right, high, plain, plain, n_r, n_c, one, block, n_h, left, n_h))
        blas.call11(kernels[1], (right, low, turned, high, n_r, n_c, one, block, n_h, top, n_r))
        blas.call13(
            kernels[2], (plain, turned, n_r, n_r, n_c, minus, left, n_h, top, n_r, one, new, n_r)
        )
    return int(sizes[3])


@compiled
def _exchange(beside: Floats, swap: Index, r: int) -> None:
    for k in range(len(swap)):
        other = swap[k] - 1  # LAPACK counts from one
        if other != k:
            for i in range(r):
                a, b = beside[k * r + i], beside[other * r + i]
                beside[k * r + i], beside[other * r + i] = b, a
