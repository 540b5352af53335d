"""Numbers of a multifrontal Cholesky factorisation (Duff, Reid 1983) on a plan of fronts."""

import numba as nb
import numpy as np
import numpy.typing as npt

from integration.arrays import Floats, Ints
from nmm.solvers.blas import call5, call10, call11


@nb.njit(cache=True)
def factorise(
    kernels: Ints,
    data: Floats,
    source: Ints,
    target: Ints,
    first: Ints,
    row_start: Ints,
    rows: Ints,
    panel_start: Ints,
    n_children: Ints,
    stack: Floats,
    letters: npt.NDArray[np.uint8],
    sizes: npt.NDArray[np.int32],
    scalars: Floats,
) -> tuple[Floats, int]:
    """Panels of the factor, and the first place whose pivot is not positive (-1: none).

    ``letters``, ``sizes`` and ``scalars`` hold the arguments "LNRT", room for four integers, and
    (1, -1): LAPACK takes addresses, so somebody outside has to own them.
    """
    panels = np.zeros(panel_start[-1])
    for k in range(len(source)):
        panels[target[k]] += data[source[k]]
    count = len(first) - 1
    held = np.empty(count, dtype=np.int64)  # supernodes whose updates are on the stack
    base = np.empty(count + 1, dtype=np.int64)
    base[0] = 0
    n_held = 0
    local = np.empty(first[-1], dtype=np.int64)
    at = letters.ctypes.data
    lower, plain, right, turned = at, at + 1, at + 2, at + 3
    n_c = sizes.ctypes.data
    n_r, n_h, info = n_c + 4, n_c + 8, n_c + 12
    one, minus = scalars.ctypes.data, scalars[1:].ctypes.data
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
            _collect(
                panel,
                update,
                stack[base[n_held] : base[n_held + 1]],
                local,
                rows[row_start[child] : row_start[child + 1]],
                c,
                h,
            )
        sizes[0], sizes[1], sizes[2] = c, r, h
        call5(kernels[0], (lower, n_c, panel.ctypes.data, n_h, info))
        if sizes[3] != 0:
            return panels, first[s] + sizes[3] - 1
        if r > 0:
            below = panel[c:].ctypes.data
            call11(
                kernels[1],
                (right, lower, turned, plain, n_r, n_c, one, panel.ctypes.data, n_h, below, n_h),
            )
            call10(
                kernels[2],
                (lower, plain, n_r, n_c, minus, below, n_h, one, update.ctypes.data, n_r),
            )
            place = base[n_held]
            for k in range(r * r):  # down to where the children's updates were
                stack[place + k] = update[k]
            held[n_held] = s
            n_held += 1
            base[n_held] = place + r * r
    return panels, -1


@nb.njit(cache=True)
def _collect(
    panel: Floats, update: Floats, child: Floats, local: Ints, rows: Ints, c: int, h: int
) -> None:
    r, size = h - c, len(rows)
    for j in range(size):
        column = local[rows[j]]
        if column < c:
            for i in range(j, size):
                panel[column * h + local[rows[i]]] += child[j * size + i]
        else:
            for i in range(j, size):
                update[(column - c) * r + local[rows[i]] - c] += child[j * size + i]


@nb.njit(cache=True, fastmath=True)
def solve(
    rhs: Floats,
    order: npt.NDArray[np.int64],
    panels: Floats,
    first: Ints,
    row_start: Ints,
    rows: Ints,
    panel_start: Ints,
) -> Floats:
    """Solution for one right-hand side."""
    n, count = len(rhs), len(first) - 1
    x = np.empty(n)
    for k in range(n):
        x[k] = rhs[order[k]]
    work = np.empty(n)
    for s in range(count):
        c, r = first[s + 1] - first[s], row_start[s + 1] - row_start[s]
        h = c + r
        part = work[:h]
        part[:c] = x[first[s] : first[s + 1]]
        part[c:] = 0.0
        for j in range(0, c - 1, 2):  # columns in pairs: half the traffic of the sums
            a = panels[panel_start[s] + j * h : panel_start[s] + (j + 1) * h]
            b = panels[panel_start[s] + (j + 1) * h : panel_start[s] + (j + 2) * h]
            u = part[j] / a[j]
            v = (part[j + 1] - a[j + 1] * u) / b[j + 1]
            part[j], part[j + 1] = u, v
            for i in range(j + 2, h):
                part[i] -= a[i] * u + b[i] * v
        if c % 2:
            a = panels[panel_start[s] + (c - 1) * h : panel_start[s] + c * h]
            u = part[c - 1] / a[c - 1]
            part[c - 1] = u
            for i in range(c, h):
                part[i] -= a[i] * u
        x[first[s] : first[s + 1]] = part[:c]
        for k in range(r):
            x[rows[row_start[s] + k]] += part[c + k]
    for s in range(count - 1, -1, -1):
        c, r = first[s + 1] - first[s], row_start[s + 1] - row_start[s]
        h = c + r
        part = work[:h]
        part[:c] = x[first[s] : first[s + 1]]
        for k in range(r):
            part[c + k] = x[rows[row_start[s] + k]]
        if c % 2:
            a = panels[panel_start[s] + (c - 1) * h : panel_start[s] + c * h]
            total = 0.0
            for i in range(c, h):
                total += a[i] * part[i]
            part[c - 1] = (part[c - 1] - total) / a[c - 1]
        for j in range(c - c % 2 - 2, -1, -2):
            a = panels[panel_start[s] + j * h : panel_start[s] + (j + 1) * h]
            b = panels[panel_start[s] + (j + 1) * h : panel_start[s] + (j + 2) * h]
            of_a, of_b = 0.0, 0.0
            for i in range(j + 2, h):
                of_a += a[i] * part[i]
                of_b += b[i] * part[i]
            v = (part[j + 1] - of_b) / b[j + 1]
            part[j + 1] = v
            part[j] = (part[j] - of_a - a[j + 1] * v) / a[j]
        x[first[s] : first[s + 1]] = part[:c]
    result = np.empty(n)
    for k in range(n):
        result[order[k]] = x[k]
    return result
