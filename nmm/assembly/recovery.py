"""Stress at points, recovered from the elements about them.

Stresses of polynomials of degree p + 1 are one degree poorer, jump between elements where weights
have kinks, and are worst at boundaries, where peaks are. A polynomial of degree p + 1 fitted to the
stresses of the elements about a point is of the order of the displacements there (Zienkiewicz and
Zhu 1992, who fit about nodes).
"""

import numpy as np

from integration.arrays import Floats, Ints
from integration.monomials import count, evaluate
from integration.rules import polygon_rule
from nmm.assembly.errors import stresses
from nmm.assembly.model import Model
from nmm.assembly.places import at_point
from nmm.errors import GeometryError

# Degree to which the sums of squares of the fit are integrated.
ORDER = 4


def recovered_stress(
    model: Model, unknowns: Floats, points: Floats, radius: float, degree: int
) -> Floats:
    """Stress (m, 3) in body axes at reference points (m, 2), Pa.

    Parameters
    ----------
    model, unknowns
        A model and its displacements.
    points
        In the material or on its boundary.
    radius
        Elements whose centroids are nearer (m) are fitted: two sizes of a cell.
    degree
        Of the polynomial: that of the local functions and one.

    Raises
    ------
    GeometryError
        A point outside the material.

    Notes
    -----
    Only elements of the material of the point take part that share covers with those at the point,
    or share covers with such: the fit does not look across cracks. With covers of degree 1 and
    cells of a quarter of its radius the threefold stress beside a hole comes out 1.6 % wrong at
    most over five positions of the net; evaluated at the point it is up to 5.8 % wrong.
    """
    found = [_at(model, unknowns, point, radius, degree) for point in points]  # a fit for each
    return np.array(found).reshape(-1, 3)


def _at(model: Model, unknowns: Floats, point: Floats, radius: float, degree: int) -> Floats:
    place = at_point(model.manifold, point)
    if not len(place):
        raise GeometryError(
            f"stress at {point.tolist()}: outside the material: expected a point in an element or "
            "on the boundary: move it"
        )
    chosen = _about(model, int(place.elements[0]), point, radius)
    rule = polygon_rule(model.manifold.elements.take(chosen), ORDER)
    rule = type(rule)(rule.points, rule.weights, chosen[rule.owner])
    stress = stresses(model, unknowns, rule)
    # Near the rim of the body there may be too few elements for the degree.
    fitted = degree
    while fitted and len(chosen) < count(fitted):
        fitted -= 1
    weight = np.sqrt(rule.weights)[:, None]
    terms = evaluate((rule.points - point) / radius, fitted)
    return np.asarray(np.linalg.lstsq(terms * weight, stress * weight, rcond=1e-12)[0][0])


def _about(model: Model, element: int, point: Floats, radius: float) -> Ints:
    """Elements within the radius that hang together with ``element`` by covers."""
    if model.cut is None:
        return np.array([element])
    covers = model.cut.covers
    taken = np.array([element])
    for _ in range(2):  # elements that share covers, and those that share covers with them
        held = np.zeros(model.cut.n_covers + 1, dtype=bool)
        held[covers[taken]] = True
        held[-1] = False
        taken = np.flatnonzero(held[covers].any(axis=1))
    away = np.hypot(*(model.manifold.elements.centroids[taken] - point).T)
    same = (model.elasticity[taken] == model.elasticity[element]).all(axis=(1, 2))
    near = taken[(away < radius) & same]
    return near if len(near) else np.array([element])
