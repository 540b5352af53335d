"""Rows of contact points, compiled: how gap and slip change with the unknowns of both sides."""

import numpy as np

from integration.arrays import Floats, Index, Ints
from nmm.compiled import compiled


@compiled
def side_rows(
    unknowns: Ints,
    start: Floats,
    end: Floats,
    rotation: Floats,
    body: Ints,
    edges: tuple[Ints, Ints],
    parameters: tuple[Floats, Floats],
    normal: Floats,
) -> tuple[Index, Floats, Floats]:
    """Unknowns (m, 2 L) of both sides, normal and tangent rows (m, 2 L).

    Parameters
    ----------
    unknowns, start, end
        (n, L), (n, 2, L) rows at both ends of the edges in the bodies' axes.
    rotation
        (B, 2, 2) from body axes to global axes.
    body
        (n,) of the edges.
    edges, parameters
        (m,) of side a and of side b.
    normal
        (m, 2) from b to a.
    """
    m, size = len(normal), unknowns.shape[1]
    columns = np.empty((m, 2 * size), dtype=np.int32)
    along_n = np.empty((m, 2 * size))
    along_t = np.empty((m, 2 * size))
    for c in range(m):
        nx, ny = normal[c]
        for side in range(2):
            edge, s = edges[side][c], parameters[side][c]
            r = rotation[body[edge]]
            sign = 1.0 - 2.0 * side
            # Normal and tangent (ny, -nx) in the axes of the body.
            px, py = sign * (r[0, 0] * nx + r[1, 0] * ny), sign * (r[0, 1] * nx + r[1, 1] * ny)
            qx, qy = sign * (r[0, 0] * ny - r[1, 0] * nx), sign * (r[0, 1] * ny - r[1, 1] * nx)
            for k in range(size):
                u = start[edge, 0, k] + s * (end[edge, 0, k] - start[edge, 0, k])
                v = start[edge, 1, k] + s * (end[edge, 1, k] - start[edge, 1, k])
                at = side * size + k
                columns[c, at] = unknowns[edge, k]
                along_n[c, at] = px * u + py * v
                along_t[c, at] = qx * u + qy * v
    return columns, along_n, along_t
