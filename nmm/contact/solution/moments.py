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
    edges: tuple[Ints, Ints],
    parameters: tuple[Floats, Floats],
    share: Floats,
    direction: Floats,
    normal: Floats,
    shear: Floats,
) -> Floats:
    """Moments (B,) about ``centre`` (B, 2) of the contact forces.

    Each acts by ``share`` (m,) of the way from its point on side a to that on side b. ``start``,
    ``end`` (n, 2) and ``body`` (n,) are of the edges, ``direction`` (m, 2) from b to a.
    """
    found = np.zeros(len(centre))
    for c in range(len(normal)):
        x = y = 0.0
        for side in range(2):
            at, s = edges[side][c], parameters[side][c]
            part = share[c] if side else 1.0 - share[c]
            x += part * (start[at, 0] + s * (end[at, 0] - start[at, 0]))
            y += part * (start[at, 1] + s * (end[at, 1] - start[at, 1]))
        # The tangent is the normal turned clockwise.
        fx = normal[c] * direction[c, 0] + shear[c] * direction[c, 1]
        fy = normal[c] * direction[c, 1] - shear[c] * direction[c, 0]
        one, other = body[edges[0][c]], body[edges[1][c]]
        found[one] += (x - centre[one, 0]) * fy - (y - centre[one, 1]) * fx
        found[other] -= (x - centre[other, 0]) * fy - (y - centre[other, 1]) * fx
    return found
