"""Numbers of a multifrontal Cholesky factorisation (Duff, Reid 1983) on a plan of fronts."""

import numba as nb
import numpy as np
import numpy.typing as npt

from integration.arrays import Floats, Ints
from nmm.solvers.frontal.blas import Index, call5, call8, call10, call11

CHOLESKY_KERNELS = "dpotrf", "dtrsm", "dsyrk", "dtrsv", "dgemv"


@nb.njit(cache=True)
def factorise(
    kernels: Ints,
    letters: npt.NDArray[np.uint8],
    sizes: Index,
    scalars: Floats,
    data: Floats,
    source: Ints,
    target: Ints,
    n_children: Ints,
    first: Ints,
    row_start: Ints,
    rows: Ints,
    panel_start: Ints,
    panels: Floats,
    stack: Floats,
) -> int:
    """Fill the panels of the factor; the first place whose pivot is not positive (-1: none)."""
    panels[: panel_start[-1]] = 0.0
    for k in range(len(source)):
        panels[target[k]] += data[source[k]]
    count = len(first) - 1
    held = np.empty(count, dtype=np.int64)  # supernodes whose updates are on the stack
    base = np.empty(count + 1, dtype=np.int64)
    base[0] = 0
    n_held = 0
    local = np.empty(first[-1], dtype=np.int64)
    start, shift = np.empty_like(local), np.empty_like(local)
    at = letters.ctypes.data
    lower, plain, right, turned = at, at + 1, at + 2, at + 3
    n_c = sizes.ctypes.data
    n_r, n_h, info = n_c + 4, n_c + 8, n_c + 12
    one = scalars.ctypes.data
    minus = one + 8
    for s in range(count):
        c, r = first[s + 1] - first[s], row_start[s + 1] - row_start[s]
        h = c + r
        panel = panels[panel_start[s] : panel_start[s + 1]]
        update = stack[base[n_held] : base[n_held] + r * r]
        update[:] = 0.0
        for k in range(c):
            local[first[s] + k] = k
        for k in range(r):
            local[rows[row_start[s] + k]] = c + k
        for _ in range(n_children[s]):
            child = held[n_held - 1]
            n_held -= 1
            size = row_start[child + 1] - row_start[child]
            n_runs = runs(rows[row_start[child] : row_start[child + 1]], local, c, start, shift)
            part = stack[base[n_held] : base[n_held + 1]]
            _collect(panel, update, part, c, h, size, start, shift, n_runs)
        sizes[0], sizes[1], sizes[2] = c, r, h
        block = panel.ctypes.data
        call5(kernels[0], (lower, n_c, block, n_h, info))
        if sizes[3] != 0:
            return int(first[s] + sizes[3] - 1)
        if r > 0:
            below, new = panel[c:].ctypes.data, update.ctypes.data
            call11(kernels[1], (right, lower, turned, plain, n_r, n_c, one, block, n_h, below, n_h))
            call10(kernels[2], (lower, plain, n_r, n_c, minus, below, n_h, one, new, n_r))
            place = base[n_held]
            if n_children[s] > 0:
                for k in range(r * r):  # down to where the children's updates were
                    stack[place + k] = update[k]
            held[n_held] = s
            n_held += 1
            base[n_held] = place + r * r
    return -1


@nb.njit(cache=True)
def runs(rows: Ints, local: Ints, c: int, start: Ints, shift: Ints) -> int:
    """Stretches of rows that stay neighbours in a front, none across its pivot block's end.

    Row ``i`` of a stretch goes to ``i + shift``. Returns their number; one more start ends them.
    """
    count = 0
    for i in range(len(rows)):
        at = local[rows[i]]
        if i == 0 or at == c or at - i != shift[count - 1]:
            start[count], shift[count] = i, at - i
            count += 1
    start[count] = len(rows)
    return count


@nb.njit(cache=True)
def _collect(
    panel: Floats,
    update: Floats,
    child: Floats,
    c: int,
    h: int,
    size: int,
    start: Ints,
    shift: Ints,
    n_runs: int,
) -> None:
    for q in range(n_runs):
        for j in range(start[q], start[q + 1]):
            column = j + shift[q]
            if column < c:
                add(panel[column * h :], 0, child[j * size :], j, q, start, shift, n_runs)
            else:
                into = update[(column - c) * (h - c) :]
                add(into, c, child[j * size :], j, q, start, shift, n_runs)


@nb.njit(cache=True, inline="always")
def add(
    into: Floats,
    above: int,
    column: Floats,
    begin: int,
    run: int,
    start: Ints,
    shift: Ints,
    n_runs: int,
) -> None:
    """Add a column from row ``begin`` on to one that leaves out ``above`` rows."""
    for p in range(run, n_runs):
        a, b, off = max(begin, start[p]), start[p + 1], shift[p] - above
        given, taken = column[a:b], into[a + off : b + off]
        for i in range(len(given)):  # slices: plain enough for vector instructions
            taken[i] += given[i]


@nb.njit(cache=True)
def solve(
    kernels: Ints,
    letters: npt.NDArray[np.uint8],
    sizes: Index,
    scalars: Floats,
    rhs: Floats,
    order: Ints,
    first: Ints,
    row_start: Ints,
    rows: Ints,
    panel_start: Ints,
    panels: Floats,
    solution: Floats,
) -> None:
    """Fill in the solution for one right-hand side: arrays are slow to return."""
    n, count = len(rhs), len(first) - 1
    x = np.empty(n)
    for k in range(n):
        x[k] = rhs[order[k]]
    work = np.empty(n)
    at = letters.ctypes.data
    lower, plain, turned = at, at + 1, at + 3
    n_c = sizes.ctypes.data
    n_r, n_h, step = n_c + 4, n_c + 8, n_c + 12
    sizes[3] = 1
    one = scalars.ctypes.data
    minus, zero = one + 8, one + 16
    ends = work.ctypes.data
    for s in range(count):
        c, r = first[s + 1] - first[s], row_start[s + 1] - row_start[s]
        sizes[0], sizes[1], sizes[2] = c, r, c + r
        own = x[first[s] :].ctypes.data
        block = panels[panel_start[s] :].ctypes.data
        call8(kernels[3], (lower, plain, plain, n_c, block, n_h, own, step))
        if r > 0:
            below = panels[panel_start[s] + c :].ctypes.data
            call11(kernels[4], (plain, n_r, n_c, minus, below, n_h, own, step, zero, ends, step))
            for k in range(r):
                x[rows[row_start[s] + k]] += work[k]
    for s in range(count - 1, -1, -1):
        c, r = first[s + 1] - first[s], row_start[s + 1] - row_start[s]
        sizes[0], sizes[1], sizes[2] = c, r, c + r
        own = x[first[s] :].ctypes.data
        block = panels[panel_start[s] :].ctypes.data
        if r > 0:
            below = panels[panel_start[s] + c :].ctypes.data
            for k in range(r):
                work[k] = x[rows[row_start[s] + k]]
            call11(kernels[4], (turned, n_r, n_c, minus, below, n_h, ends, step, one, own, step))
        call8(kernels[3], (lower, turned, plain, n_c, block, n_h, own, step))
    for k in range(n):
        solution[order[k]] = x[k]
