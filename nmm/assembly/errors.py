"""Errors of displacement fields against a reference, in energy and in the mean square."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats
from integration.rules import PointRule, polygon_rule
from nmm.assembly.model import Model
from nmm.materials.tensors import ISOTROPIC

Field = Callable[[Floats], Floats]


@dataclass(frozen=True)
class FieldErrors:
    """Norms of errors, and of the reference, by integrals over the elements.

    Attributes
    ----------
    energy, displacement
        ``sqrt(int e : D : e)`` and ``sqrt(int |u|^2)`` of the error over those of the reference.
    """

    energy: float
    displacement: float


def field_errors(
    model: Model,
    unknowns: Floats,
    displacement: Field,
    strain: Field,
    order: int,
    rule: PointRule | None = None,
) -> FieldErrors:
    """Compare with exact displacements (m, 2) and strains (m, 3) at points (m, 2)."""
    manifold = model.manifold
    points = polygon_rule(manifold.elements, order) if rule is None else rule
    found = manifold.rows(points.owner, points.points).apply(unknowns)
    exact = displacement(points.points)
    of_error = strains(model, unknowns, points) - strain(points.points)
    return FieldErrors(
        np.sqrt(_energy(model, points, of_error) / _energy(model, points, strain(points.points))),
        np.sqrt(points.weights @ ((found - exact) ** 2).sum(axis=1))
        / np.sqrt(points.weights @ (exact**2).sum(axis=1)),
    )


def strains(model: Model, unknowns: Floats, rule: PointRule) -> Floats:
    """Strains (Q, 3) at the points of a rule."""
    index, rows = model.manifold.gradient_rows(rule.owner, rule.points)
    g = np.einsum("mcjl,ml->mcj", rows, unknowns[index])
    return np.stack([g[:, 0, 0], g[:, 1, 1], g[:, 0, 1] + g[:, 1, 0]], axis=1)


def stresses(
    model: Model, unknowns: Floats, rule: PointRule, pressure: Floats | None = None
) -> Floats:
    """Stresses (Q, 3) at the points of a rule (Pa).

    ``pressure`` (k,) are those on the patches, beside supports above all; without them they are
    those of the unknowns alone (`Model.pressure`).
    """
    strain = strains(model, unknowns, rule)
    known = model.pressure(unknowns) if pressure is None else pressure
    if known is None:
        return np.asarray(np.einsum("mij,mj->mi", model.elasticity[rule.owner], strain))
    assert model.pressures is not None
    mean = model.pressures.rows(model.manifold, rule.owner, rule.points) @ known
    drained = np.einsum("mij,mj->mi", model.drained[rule.owner], strain)
    return np.asarray(drained + mean[:, None] * ISOTROPIC)


def _energy(model: Model, rule: PointRule, strain: Floats) -> float:
    density = np.einsum("mi,mij,mj->m", strain, model.elasticity[rule.owner], strain)
    return float(rule.weights @ density)
