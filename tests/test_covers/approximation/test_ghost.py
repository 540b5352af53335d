"""The ghost form on pairs of neighbouring elements."""

import numpy as np
import pytest

from covers.approximation.ghost import ghost, neighbours
from covers.approximation.manifold import Manifold
from covers.approximation.mesh_manifold import mesh_manifold
from covers.cutting.cut import cut
from covers.local_functions.polynomials import Kinds, LocalFunctions, Monomials, RigidStrain
from covers.mathematical.triangles import Triangles
from integration.arrays import Floats, Ints
from integration.polygons import Polygons
from integration.rules import polygon_rule

SQUARE = Polygons.from_vertices([np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])])


def manifold(*functions: LocalFunctions) -> tuple[Manifold, Ints]:
    """Turned net on a square with local functions in turn, and its cut elements."""
    cover = Triangles.regular([[0.0, 0.0], [1.0, 1.0]], 0.3, angle=0.3, shift=(0.1, 0.2))
    pieces = cut(cover, SQUARE)
    which = np.arange(pieces.n_covers) % len(functions)
    made = mesh_manifold(cover, pieces, Kinds(tuple(functions), which))
    return made, np.flatnonzero(~pieces.element_whole)


def energy(made: Manifold, cut: Ints, weight: Floats, unknowns: Floats, order: int) -> float:
    """The form point by point: continue both fields over both elements and square the gap."""
    total = 0.0
    for one, two in zip(*neighbours(made, cut), strict=True):
        for element in (one, two):
            rule = polygon_rule(made.elements.take(np.array([element])), order)
            sides = [
                made.rows(np.full(len(rule.points), e), rule.points).apply(unknowns)
                for e in (one, two)
            ]
            gap = ((sides[0] - sides[1]) ** 2).sum(axis=1)
            total += weight[one] * float(rule.weights @ gap)
    return total


@pytest.mark.parametrize(
    "functions",
    [(Monomials(1),), (Monomials(2),), (Monomials(0), Monomials(2)), (RigidStrain(),)],
    ids=["linear", "quadratic", "two degrees", "rotations"],
)
def test_form_is_the_integral_of_the_squared_gap(functions: tuple[LocalFunctions, ...]) -> None:
    made, cut_ones = manifold(*functions)
    random = np.random.default_rng(0)
    weight, unknowns = random.uniform(1, 2, len(made.elements)), random.normal(size=made.n_unknowns)
    form = ghost(made, cut_ones, weight, 3)
    # Both integrate polynomials of degree 6 exactly; sums of some 1e4 terms round to 1e-12.
    exact = energy(made, cut_ones, weight, unknowns, 6)
    assert exact > 0
    assert unknowns @ form @ unknowns == pytest.approx(exact, rel=1e-10)


def test_form_does_not_see_a_field_that_is_one_polynomial() -> None:
    made, cut_ones = manifold(Monomials(1))
    form = ghost(made, cut_ones, np.ones(len(made.elements)), 2)
    motions = np.hstack([made.rigid_modes.toarray(), made.stretch_modes.toarray()])
    # Rounding of values of size one, against a diagonal of the size of an element's area.
    assert np.abs(form @ motions).max() < 1e-12
    assert form.diagonal().max() > 1e-3
