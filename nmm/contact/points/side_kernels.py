"""Sides of contacts, compiled: where points stand, and how gap and slip change with unknowns.

`MaterialPoints.place` says the first in whole arrays.
"""

from typing import NamedTuple

import numpy as np

from integration.arrays import Floats, Index, Ints
from nmm.compiled import compiled


class EdgeRows(NamedTuple):
    """Rows at both ends of edges, in the axes of their bodies, as compiled code takes them.

    Attributes
    ----------
    unknowns, start, end
        (n, L), and (n, 2, L) of the starts and the ends.
    body
        (n,) of the edges.
    """

    unknowns: Ints
    start: Floats
    end: Floats
    body: Ints


@compiled
def places(
    body: Ints,
    arm: Floats,
    unknowns: Ints,
    values: Floats,
    centre: Floats,
    rotation: Floats,
    tilt: Floats,
    deformation: Floats,
) -> Floats:
    """Places (m, 2) of points of the material (m).

    Parameters
    ----------
    body, arm, unknowns, values
        Those of `MaterialPoints`, with its rows.
    centre, rotation, tilt
        (B, 2), (B, 2, 2) and (B,) or, where bodies are not tilted, (0,): see `Frames`.
    deformation
        (n,).
    """
    found = np.empty((len(body), 2))
    for k in range(len(body)):
        b = body[k]
        x = arm[k, 0] + _product(values[k, 0], unknowns[k], deformation)
        y = arm[k, 1] + _product(values[k, 1], unknowns[k], deformation)
        if len(tilt) > 0:
            x, y = x - tilt[b] * arm[k, 1], y + tilt[b] * arm[k, 0]
        turn = rotation[b]
        found[k, 0] = centre[b, 0] + (turn[0, 0] * x + turn[0, 1] * y)
        found[k, 1] = centre[b, 1] + (turn[1, 0] * x + turn[1, 1] * y)
    return found


@compiled
def _product(row: Floats, unknowns: Ints, deformation: Floats) -> float:
    """Row times the unknowns that it names, by two sums in turn: so numpy adds short rows up."""
    even, odd = 0.0, 0.0
    for i in range(0, len(row) - 1, 2):
        even += row[i] * deformation[unknowns[i]]
        odd += row[i + 1] * deformation[unknowns[i + 1]]
    if len(row) % 2 == 1:
        even += row[len(row) - 1] * deformation[unknowns[len(row) - 1]]
    return even + odd


@compiled
def side_rows(
    table: EdgeRows,
    rotation: Floats,
    edges: tuple[Ints, Ints],
    parameters: tuple[Floats, Floats],
    normal: Floats,
) -> tuple[Index, Floats, Floats]:
    """Unknowns (m, 2 L) of both sides, normal and tangent rows (m, 2 L).

    Parameters
    ----------
    table
        Rows at the ends of all edges.
    rotation
        (B, 2, 2) from body axes to global axes.
    edges, parameters
        (m,) of side a and of side b.
    normal
        (m, 2) from b to a.
    """
    unknowns, start, end, body = table
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
