"""Point rules of elements with singular functions."""

from collections.abc import Sequence

import numpy as np

from covers.approximation.enrichment import Enrichment
from integration.arrays import Ints
from integration.polygons import Polygons, diameters
from integration.rules import PointRule, polygon_rule
from integration.singular import tip_rule

# Elements nearer to a singular point than this many of their diameters are integrated about it.
NEAR_TIP = 1.25
# Degree beyond that of the polynomials to which functions that are none are integrated.
SINGULAR, FRACTIONAL = 8, 8


def singular_rule(
    polygons: Polygons, enrichments: Sequence[Enrichment], which: Ints, degree: int
) -> PointRule:
    """About the singular point where it is near, by Gauss points elsewhere.

    Parameters
    ----------
    polygons
        The elements (N,).
    enrichments, which
        Singular points, and (N,) the one whose functions each element carries.
    degree
        Degree of the polynomials, weights included.
    """
    tips = np.array([item.point for item in enrichments])[which]
    size = diameters(polygons)
    near = np.hypot(*(polygons.centroids - tips).T) < NEAR_TIP * size
    powers = np.array([item.functions.exponent for item in enrichments])
    # Half powers are integrated exactly, others need more points along the radius.
    more = 0 if np.array_equal(2 * powers, np.round(2 * powers)) else FRACTIONAL
    its, others = np.flatnonzero(near), np.flatnonzero(~near)
    about = tip_rule(polygons.take(its), tips[near], 2 * degree + 2 + more)
    return _joined(about, its, polygon_rule(polygons.take(others), 2 * degree + SINGULAR), others)


def _joined(first: PointRule, its: Ints, second: PointRule, others: Ints) -> PointRule:
    owner = np.concatenate([its[first.owner], others[second.owner]])
    order = np.argsort(owner, kind="stable")
    points = np.concatenate([first.points, second.points])[order]
    return PointRule(points, np.concatenate([first.weights, second.weights])[order], owner[order])
