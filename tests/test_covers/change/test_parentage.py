"""What became of what when the cells of a body change."""

import numpy as np
import pytest
import shapely

from covers.approximation.mesh_manifold import mesh_manifold
from covers.change.parentage import Parentage
from covers.cutting.cut import cut
from covers.local_functions.polynomials import Monomials
from covers.mathematical.quads import Quads
from covers.mathematical.triangles import Triangles
from integration.polygons import Polygons

SQUARES = Polygons.from_vertices(
    [[(0, 0), (1, 0), (1, 1), (0, 1)], [(1, 0), (2, 0), (2, 1), (1, 1)]]
)
BOUNDS = np.array([[0.0, 0.0], [2.0, 1.0]])


def manifold(kind, size):
    laid = kind.regular(BOUNDS, size)
    return mesh_manifold(laid, cut(laid, SQUARES), Monomials(1))


@pytest.fixture(scope="module")
def kin():
    return Parentage(manifold(Triangles, 0.41), manifold(Quads, 0.27))


def test_common_areas_fill_old_and_new_elements(kin):
    found = kin.elements.matrix
    # Overlays add up to areas but for rounding of coordinates.
    np.testing.assert_allclose(found.sum(axis=1), kin.old.elements.areas, rtol=1e-9)
    np.testing.assert_allclose(found.sum(axis=0), kin.new.elements.areas, rtol=1e-9)


def test_each_pair_of_elements_has_its_intersection_in_common(kin):
    old, new = kin.old.elements.to_shapely(), kin.new.elements.to_shapely()
    expected = shapely.area(shapely.intersection(old[:, None], new))
    same = kin.old.element_region[:, None] == kin.new.element_region
    np.testing.assert_allclose(kin.elements.matrix.toarray(), expected * same, atol=1e-12)


def test_bodies_keep_their_parents(kin):
    assert kin.bodies.main.tolist() == [0, 1]
    np.testing.assert_allclose(kin.bodies.common, 1.0, rtol=1e-12)


def test_edges_share_the_whole_boundary_with_those_they_come_from(kin):
    found, old, new = kin.edges.matrix, kin.old.boundary, kin.new.boundary
    for total, edges in ((found.sum(axis=1), old), (found.sum(axis=0), new)):
        np.testing.assert_allclose(total, np.hypot(*(edges.end - edges.start).T), rtol=1e-8)
    bodies = old.body[kin.edges.parent], new.body[kin.edges.child]
    np.testing.assert_array_equal(*bodies)


def test_covers_have_their_common_support_in_common(kin):
    # Every point of the old triangles lies in three covers, every one of the new quads in four.
    assert kin.covers.common.sum() == pytest.approx(3 * 4 * 2.0, rel=1e-9)


def test_means_over_parents_keep_the_integral(kin):
    values = np.random.default_rng(3).normal(size=(len(kin.old.elements), 3))
    found = kin.elements.mean(values, np.zeros((len(kin.new.elements), 3)))
    expected = kin.old.elements.areas @ values
    np.testing.assert_allclose(kin.new.elements.areas @ found, expected, rtol=1e-9)


def test_a_body_that_is_new_has_no_parent_and_takes_what_is_declared():
    laid = Quads.regular(BOUNDS, 0.5)
    one = cut(laid, SQUARES.take([0]))
    kin = Parentage(mesh_manifold(laid, one, Monomials(1)), manifold(Quads, 0.5))
    assert kin.new_bodies.tolist() == [False, True]
    declared = np.full(len(kin.new.elements), 7.0)
    found = kin.elements.mean(np.ones(len(kin.old.elements)), declared)
    assert found.tolist() == np.where(kin.new.element_region == 0, 1.0, 7.0).tolist()
