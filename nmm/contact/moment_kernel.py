"""What contact forces do to unknowns and bodies, compiled: one pass over the contacts."""

from typing import Any

import numba as nb
import numpy as np
import numpy.typing as npt

from integration.arrays import Floats, Ints

Index = npt.NDArray[Any]


@nb.njit(cache=True)
def pushed(
    normal_pointers: Index,
    normal_columns: Index,
    normal_entries: Floats,
    tangent_pointers: Index,
    tangent_columns: Index,
    tangent_entries: Floats,
    normal: Floats,
    shear: Floats,
    n: int,
) -> Floats:
    """Forces (n,) on the unknowns: ``normal_rows.T @ normal + tangent_rows.T @ shear``."""
    found = np.zeros(n)
    for c in range(len(normal)):
        for k in range(normal_pointers[c], normal_pointers[c + 1]):
            found[normal_columns[k]] += normal_entries[k] * normal[c]
        for k in range(tangent_pointers[c], tangent_pointers[c + 1]):
            found[tangent_columns[k]] += tangent_entries[k] * shear[c]
    return found


@nb.njit(cache=True)
def moments(
    start: Floats,
    end: Floats,
    body: Ints,
    centre: Floats,
    edge_a: Ints,
    parameter_a: Floats,
    edge_b: Ints,
    direction: Floats,
    normal: Floats,
    shear: Floats,
) -> Floats:
    """Moments (B,) about ``centre`` (B, 2) of the contact forces, each at its point on side a.

    ``start``, ``end`` (n, 2) and ``body`` (n,) are of the edges, ``direction`` (m, 2) from b to a.
    """
    found = np.zeros(len(centre))
    for c in range(len(normal)):
        a, s = edge_a[c], parameter_a[c]
        x = start[a, 0] + s * (end[a, 0] - start[a, 0])
        y = start[a, 1] + s * (end[a, 1] - start[a, 1])
        # The tangent is the normal turned clockwise.
        fx = normal[c] * direction[c, 0] + shear[c] * direction[c, 1]
        fy = normal[c] * direction[c, 1] - shear[c] * direction[c, 0]
        one, other = body[a], body[edge_b[c]]
        found[one] += (x - centre[one, 0]) * fy - (y - centre[one, 1]) * fx
        found[other] -= (x - centre[other, 0]) * fy - (y - centre[other, 1]) * fx
    return found
