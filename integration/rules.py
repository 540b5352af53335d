"""Point rules on polygons."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from integration import gauss
from integration.arrays import Floats, Ints
from integration.polygons import Polygons
from integration.triangulation import triangle_areas, triangulate, triangulate_alike


@dataclass(frozen=True, eq=False)
class PointRule:
    """Points that integrate over polygons: the sum of ``weights * f(points)`` of each owner.

    Attributes
    ----------
    points : (Q, 2)
    weights : (Q,)
        in units of area.
    owner : (Q,)
        polygon of each point, sorted.
    """

    points: Floats
    weights: Floats
    owner: Ints

    def integrate(self, values: Floats, number: int) -> Floats:
        """Integrals (number, ...) of values (Q, ...) given at the points, by polygon."""
        columns = values.reshape(len(values), math.prod(values.shape[1:])).T * self.weights
        out = np.empty((number, len(columns)))
        for k, column in enumerate(columns):
            out[:, k] = np.bincount(self.owner, column, minlength=number)
        return out.reshape(number, *values.shape[1:])


def polygon_rule(polygons: Polygons, order: int, alike: bool = False) -> PointRule:
    """Points inside the polygons and positive weights, exact to degree ``order``.

    Triangles of each polygon carry symmetric Gauss rules. A polygon of zero area has no points.
    Where they are ``alike`` a polygon, turned or mirrored, has its points turned or mirrored, for
    twice as many of them on a quadrilateral: what no rule integrates exactly is then the same.

    Raises
    ------
    ValueError
        A polygon that crosses itself or its holes.
    """
    triangles, owner = (triangulate_alike if alike else triangulate)(polygons)
    barycentric, weights = gauss.triangle(max(order, 0))
    q = len(weights)
    return PointRule(
        np.matmul(barycentric, triangles).reshape(-1, 2),
        np.outer(triangle_areas(triangles), weights).ravel(),
        np.repeat(owner, q),
    )
