"""Moments of contact forces about bodies, compiled: one pass over the contacts."""

import numpy as np

from integration.arrays import Floats, Ints
from nmm.compiled import compiled


@compiled
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
