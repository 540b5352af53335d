"""Exact integrals of monomials over polygons (simplex integration)."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from integration import gauss
from integration.arrays import Floats
from integration.monomials import count, exponents, powers, shift_moments
from integration.polygons import Polygons


def moments(
    polygons: Polygons,
    degree: int,
    origin: npt.ArrayLike | None = None,
    scale: npt.ArrayLike | None = None,
) -> Floats:
    r"""Integrals of :math:`((x - o_x)/s)^a ((y - o_y)/s)^b` over each polygon.

    A monomial of degree g is homogeneous, so that the divergence theorem gives
    :math:`(g + 2) \int x^a y^b dA = \sum_i J_i \int_0^1 x(t)^a y(t)^b dt` with
    :math:`J_i = x_i y_{i+1} - x_{i+1} y_i` over the edges (Shi 1988, simplex integration); Gauss
    points on the edges make the right hand exact. The sum is taken about the centroid and moved
    to the origin afterwards, since sums about a far point lose their figures.

    Parameters
    ----------
    degree : int
        largest total degree a + b.
    origin : (N, 2) or (2,), optional
        point that the monomials are centred on; the centroids by default.
    scale : (N,) or float, optional
        length that divides the coordinates, 1 by default. The area element is not scaled.

    Returns
    -------
    (N, K)
        in the order of `integration.monomials.exponents`; zeros for a polygon of zero area.
    """
    size = np.broadcast_to(np.asarray(1.0 if scale is None else scale, dtype=float), len(polygons))
    columns = _central(polygons, degree, size)
    if origin is not None:
        dx, dy = ((polygons.centroids - np.asarray(origin, dtype=float)) / size[:, None]).T
        shift_moments(columns, degree, dx, dy)
    return np.ascontiguousarray(columns.T)


def _central(polygons: Polygons, degree: int, size: Floats) -> Floats:
    """Moments (K, N) about the centroids, coordinates divided by ``size``."""
    out = np.zeros((count(degree), len(polygons)))
    out[0] = polygons.areas
    if degree == 0 or not len(polygons):
        return out
    owner = polygons.polygon_of_point
    x, y = (polygons.points - polygons.centroids[owner]).T
    x1, y1 = x[polygons.next_point], y[polygons.next_point]
    sign = np.sign(polygons.ring_areas) * polygons.ring_signs
    weight = (x * y1 - x1 * y) * sign[polygons.ring_of_point]
    x, y, x1, y1 = (c / size[owner] for c in (x, y, x1, y1))
    total = np.zeros((count(degree), len(x)))
    for t, w in zip(*gauss.interval(degree // 2 + 1), strict=True):
        total += w * powers(x + t * (x1 - x), y + t * (y1 - y), degree)
    total *= weight
    sums = np.add.reduceat(total, polygons.first_point, axis=1)
    factor = exponents(degree).sum(axis=1) + 2.0
    out[1:] = (sums / factor[:, None])[1:]
    out[:, polygons.areas == 0.0] = 0.0
    return out
