"""The quadrature of a manifold for products of its functions."""

import numpy as np

from covers.approximation.groups.element_group import ElementGroup
from covers.approximation.groups.polynomial_group import PolynomialGroup
from covers.approximation.groups.quadrature_group import QuadratureGroup
from covers.approximation.manifold import Manifold
from integration.rules import PointRule, polygon_rule


def own_rule(manifold: Manifold) -> PointRule:
    """Return the quadrature points of all elements, sorted by element.

    It gives the integrals of the element matrices: exact for polynomials, and the same points for
    other functions.
    """
    parts = [_of_group(manifold, group) for group in manifold.groups]  # a handful of groups
    owner = np.concatenate([part.owner for part in parts])
    order = np.argsort(owner, kind="stable")
    points, weights = (
        np.concatenate([getattr(part, name) for part in parts])[order]
        for name in ("points", "weights")
    )
    return PointRule(points, weights, owner[order])


def _of_group(manifold: Manifold, group: ElementGroup) -> PointRule:
    if isinstance(group, QuadratureGroup):
        rule = group.rule
    else:
        assert isinstance(group, PolynomialGroup)
        rule = polygon_rule(manifold.elements.take(group.elements), 2 * group.degree)
    return PointRule(rule.points, rule.weights, group.elements[rule.owner])
