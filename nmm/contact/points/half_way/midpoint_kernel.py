"""What rows of contacts half way have beyond those of points that do not turn, compiled."""

import numpy as np

from integration.arrays import Floats, Ints
from nmm.compiled import compiled


@compiled
def add_turns(
    normal: Floats,
    tangent: Floats,
    direction: Floats,
    lever: tuple[Floats, Floats],
    factor: tuple[Floats, Floats],
    turn: tuple[Floats, Floats],
    body: tuple[Ints, Ints],
    bent: tuple[Floats, Floats],
    rotation: tuple[Floats, Floats],
    projection: Floats,
) -> None:
    """Add to normal and tangent rows (m, 2 L), unknowns of side a before those of side b.

    Parameters
    ----------
    direction
        (m, 2) unit normals, from b to a.
    lever
        (m,) how far side a lies from side b along tangent and normal (m).
    factor
        (m,) what the turn of either side's edge adds to that of the line between faces (1/m).
    turn
        (m, 2, L) rows of the ends of these edges less those of their starts, in the bodies' axes.
    body, bent
        (m,) body of each side; (m, 2) its displacement by strain, in the axes of the body.
    rotation
        (B, 2, 2) from body axes to global axes, at the start of the step and half way.
    projection
        (B, 3, L) mean motion of a body from its unknowns.
    """
    count, size = len(direction), turn[0].shape[2]
    mean = np.empty(3)
    for c in range(count):
        nx, ny = direction[c, 0], direction[c, 1]
        for side in range(2):
            b, sign, share = body[side][c], 1.0 - 2.0 * side, factor[side][c]
            start, half = rotation[0][b], rotation[1][b]
            if share != 0.0:
                # The normal in the axes of the body.
                px, py = half[0, 0] * nx + half[1, 0] * ny, half[0, 1] * nx + half[1, 1] * ny
                for k in range(size):
                    along = share * (turn[side][c, 0, k] * px + turn[side][c, 1, k] * py)
                    normal[c, side * size + k] += lever[0][c] * along
                    tangent[c, side * size + k] -= lever[1][c] * along
            ux, uy = bent[side][c, 0], bent[side][c, 1]
            for which in range(2):
                ax, ay = (nx, ny) if which == 0 else (ny, -nx)
                rows = normal if which == 0 else tangent
                hx, hy = half[0, 0] * ax + half[1, 0] * ay, half[0, 1] * ax + half[1, 1] * ay
                mean[0] = start[0, 0] * ax + start[1, 0] * ay - hx
                mean[1] = start[0, 1] * ax + start[1, 1] * ay - hy
                mean[2] = hy * ux - hx * uy
                for k in range(size):
                    more = 0.0
                    for i in range(3):
                        more += mean[i] * projection[b, i, k]
                    rows[c, side * size + k] += sign * more
