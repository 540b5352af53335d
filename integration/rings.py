"""Rings of vertices: opened, and integrated over."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from integration.arrays import Floats, Ints
from integration.ragged import sums


def open_ring(ring: npt.ArrayLike, where: str) -> Floats:
    """Return the vertices (n, 2) of a ring, a closing vertex dropped; ``where`` it is, in words.

    Raises
    ------
    ValueError
        Fewer than three vertices, or another shape.
    """
    points = np.array(ring, dtype=float)
    if points.size == 0:
        points = points.reshape(0, 2)
    if points.ndim != 2 or points.shape[1] != 2:
        raise ValueError(f"{where}: shape {points.shape}: (n, 2) expected: give rows of x and y")
    if len(points) > 1 and points[0, 0] == points[-1, 0] and points[0, 1] == points[-1, 1]:
        points = points[:-1]
    if len(points) < 3:
        raise ValueError(
            f"{where}: {len(points)} vertices: at least 3 expected: add vertices or drop the ring"
        )
    return points


def ring_integrals(points: Floats, ring_offsets: Ints, next_point: Ints) -> tuple[Floats, Floats]:
    """Signed area (R,) and first moments (R, 2) of each ring about its first vertex.

    Differences from a vertex of the ring keep the accuracy of rings far from the origin. An area
    below the rounding of its terms is no area.

    Parameters
    ----------
    points, ring_offsets, next_point
        See `integration.polygons.Polygons`.
    """
    start = ring_offsets[:-1]
    x, y = (points - np.repeat(points[start], np.diff(ring_offsets), axis=0)).T
    x1, y1 = x[next_point], y[next_point]
    left, right = x * y1, x1 * y
    twice = left - right
    area = 0.5 * sums(twice, ring_offsets)
    rounding = np.finfo(float).eps * sums(np.abs(left) + np.abs(right), ring_offsets)
    area[np.abs(area) <= rounding] = 0.0
    sx = sums(twice * (x + x1), ring_offsets)
    sy = sums(twice * (y + y1), ring_offsets)
    return area, np.stack([sx, sy], axis=1) / 6.0
