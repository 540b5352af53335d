"""Quadrature of elements with singular functions."""

from collections.abc import Sequence

import numpy as np
import shapely
from shapely.geometry.base import BaseGeometry

from covers.approximation.singular.enrichment import Enrichment
from integration.arrays import Bools, Floats, Ints
from integration.polygons import Polygons, diameters
from integration.rules import PointRule, polygon_rule
from integration.singular import tip_rule

# Elements nearer to a singular point than this multiple of their diameter get a graded rule.
NEAR_TIP = 1.25
# Degree of the quadrature beyond that of the polynomials: far from the point, and for exponents
# that are no multiples of one half.
SINGULAR, FRACTIONAL = 8, 8


def singular_rule(
    polygons: Polygons, enrichments: Sequence[Enrichment], which: Ints, degree: int
) -> PointRule:
    """Return the quadrature of elements with singular functions, see `graded_rule`.

    Parameters
    ----------
    polygons
        The elements (N,).
    enrichments, which
        Singular points, and (N, p) those whose functions each element carries.
    degree
        Degree of the polynomials, weights included.
    """
    place = np.array([item.point for item in enrichments])
    powers = np.array([item.functions.exponent for item in enrichments])
    # Multiples of one half are integrated exactly, other powers need more points along the radius.
    more = 0 if np.array_equal(2 * powers, np.round(2 * powers)) else FRACTIONAL
    return graded_rule(polygons, place, which, degree, more)


def graded_rule(
    polygons: Polygons, place: Floats, which: Ints, degree: int, more: int = 0
) -> PointRule:
    """Return a quadrature that is graded about near singular points, and Gaussian elsewhere.

    A polygon near several points is divided into the parts nearest to each.

    Parameters
    ----------
    polygons
        N polygons.
    place, which
        (P, 2) singular points (m), and (N, p) those of each polygon.
    degree, more
        Degree of the polynomials, weights included, and of what is integrated beside them along
        the radius.
    """
    if not len(place):
        return polygon_rule(polygons, 2 * degree)
    away = np.hypot(*np.moveaxis(polygons.centroids[:, None] - place[which], -1, 0))
    near = away < NEAR_TIP * diameters(polygons)[:, None]
    others = np.flatnonzero(~near.any(axis=1))
    parts, owner, point = _parted(polygons, which, near, away, place)
    about = tip_rule(parts, place[point], 2 * degree + 2 + more)
    far = polygon_rule(polygons.take(others), 2 * degree + SINGULAR)
    return _joined(about, owner, far, others)


def _parted(
    polygons: Polygons, which: Ints, near: Bools, away: Floats, place: Floats
) -> tuple[Polygons, Ints, Ints]:
    """Parts of elements near singular points, and the element and the point of each part."""
    nearby = np.where(near, which, -1)
    closest = np.take_along_axis(
        which, np.argmin(np.where(near, away, np.inf), axis=1)[:, None], axis=1
    )[:, 0]
    several = ((nearby != closest[:, None]) & near).any(axis=1)
    alone = np.flatnonzero(near.any(axis=1) & ~several)
    parts, owners, points = [polygons.take(alone)], [alone], [closest[alone]]
    for element in np.flatnonzero(several):  # the few elements between two tips
        shape = polygons.take([element]).to_shapely()[0]
        about = np.unique(nearby[element][near[element]])
        for point in about:
            part = _nearest(shape, place[point], place[about[about != point]])
            found = [one for one in shapely.get_parts(part) if one.geom_type == "Polygon"]
            found = [one for one in found if one.area > 0]
            if found:
                parts.append(Polygons.from_shapely(found))
                owners.append(np.full(len(found), element))
                points.append(np.full(len(found), point))
    return Polygons.concatenate(parts), np.concatenate(owners), np.concatenate(points)


def _nearest(whole: shapely.Polygon, one: Floats, others: Floats) -> BaseGeometry:
    """Return the part of a polygon that is nearer to one point than to the others (k, 2)."""
    shape: BaseGeometry = whole
    reach = 4 * (whole.length + np.hypot(*(np.array(whole.exterior.coords[0]) - one)))
    for other in others:
        middle, away = (one + other) / 2, (one - other) / np.hypot(*(one - other))
        side = reach * np.array([-away[1], away[0]])
        half = [middle - side, middle + side, middle + side + reach * away]
        shape = shapely.intersection(shape, shapely.Polygon([*half, middle - side + reach * away]))
    return shape


def _joined(first: PointRule, its: Ints, second: PointRule, others: Ints) -> PointRule:
    """Merge two rules; ``its`` and ``others`` are the elements of their polygons."""
    owner = np.concatenate([its[first.owner], others[second.owner]])
    order = np.argsort(owner, kind="stable")
    points = np.concatenate([first.points, second.points])[order]
    return PointRule(points, np.concatenate([first.weights, second.weights])[order], owner[order])
