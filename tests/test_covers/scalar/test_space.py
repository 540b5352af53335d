"""Scalar functions of a manifold: those that displacements have for each component."""

import numpy as np
import pytest

from covers.approximation.own_rule import own_rule
from covers.scalar.space import ScalarSpace
from nmm.formulation import CoverTable
from nmm.materials.elastic import Elastic
from nmm.model.from_polygons import solid
from nmm.verification.continuum import polygon

RING = np.array([[0.03, 0.0], [2.0, 0.1], [1.8, 1.3], [0.2, 1.1]])
COVERS = {
    "block": ({"type": "block"}, 1),
    "rigid block": ({"type": "block", "functions": "rigid"}, 1),
    "cubic block": ({"type": "block", "functions": "monomials", "degree": 3}, 3),
    "triangles": ({"type": "triangles", "size": 0.4, "functions": "monomials", "degree": 1}, 2),
    "quads": ({"type": "quads", "size": 0.4, "functions": "monomials", "degree": 0}, 1),
    "splines": ({"type": "bspline", "size": 0.4, "functions": "monomials", "degree": 0}, 1),
    "meshless": ({"type": "mls", "size": 0.4, "functions": "monomials", "degree": 0}, 1),
}


def space(name, cracks=()):
    model = solid(
        polygon(RING), CoverTable(**COVERS[name][0]), [Elastic(1.0, 0.2)], "stress", cracks=cracks
    )
    return ScalarSpace.of(model.manifold)


@pytest.mark.parametrize("name", COVERS)
def test_fields_hold_polynomials_of_the_degree_of_the_displacements(name):
    found, degree = space(name), COVERS[name][1]
    rule = own_rule(found.manifold)
    x, y = rule.points.T
    rows, root = found.values(rule.owner, rule.points), np.sqrt(rule.weights)
    wanted = (0.3 + x - 2 * y) ** degree
    unknowns = np.linalg.lstsq(root[:, None] * rows.toarray(), root * wanted, rcond=1e-13)[0]
    assert rows @ unknowns == pytest.approx(wanted, abs=1e-9)
    along = np.tile([0.6, -0.8], (len(x), 1))
    slope = degree * (0.3 + x - 2 * y) ** (degree - 1) * (0.6 + 1.6)
    gradients = found.gradients(rule.owner, rule.points, along)
    assert gradients @ unknowns == pytest.approx(slope, abs=1e-7)
    # Weights sum to one.
    assert rows @ found.one == pytest.approx(np.ones(len(x)), abs=1e-12)


def test_there_is_one_function_where_displacements_have_two_unknowns():
    found = space("triangles")
    assert 2 * found.n == found.manifold.n_unknowns
    assert found.body.tolist() == [0] * found.n


def test_cracks_cut_fields_and_their_tips_carry_the_components_of_singular_functions():
    crack = np.array([[-0.5, 0.5], [1.1, 0.62]])
    plain, cut = space("triangles"), space("triangles", [crack])
    assert cut.manifold.enriched > 0
    # Two vector functions a cover give displacements two unknowns, and fields four functions.
    monomials = (cut.manifold.n_unknowns - 2 * cut.manifold.enriched) // 2
    assert cut.n == monomials + 4 * cut.manifold.enriched
    assert cut.n > plain.n


def test_fields_hold_the_root_of_the_distance_on_both_sides_of_a_crack():
    """``sqrt(r) sin(t / 2)`` jumps across the crack; in the element about the tip."""
    tip = np.array([1.1, 0.62])
    found = space("triangles", [np.array([[-0.5, 0.62], tip])])
    rule = own_rule(found.manifold)
    z = (rule.points - tip) @ np.array([1, 1j])
    near = rule.owner == rule.owner[np.argmin(abs(z))]
    rows = found.values(rule.owner[near], rule.points[near]).toarray()
    for wanted in (np.sqrt(z[near]).imag, np.sqrt(z[near]).real):
        unknowns = np.linalg.lstsq(rows, wanted, rcond=1e-13)[0]
        assert rows @ unknowns == pytest.approx(wanted, abs=1e-9)
