"""Gauss points along segments."""

import numpy as np
import pytest

from integration.moments import moments
from integration.monomials import evaluate, exponents
from integration.segments import segment_rule


@pytest.mark.parametrize("order", range(8))
def test_a_unit_segment_has_the_integrals_of_t(order):
    points, weights = segment_rule(np.array([[0.0, 0.0]]), np.array([[3.0, 4.0]]), order)
    found = weights[0] @ evaluate(points[0], order)
    # x = 3 t, y = 4 t, ds = 5 dt
    a, b = exponents(order).T
    np.testing.assert_allclose(found, 5.0 * 3.0**a * 4.0**b / (a + b + 1), rtol=1e-14)


def test_greens_theorem_links_edges_and_area(assorted):
    turned = assorted.oriented()
    start, end = turned.points, turned.points[turned.next_point]
    normal_length = (end - start)[:, ::-1] * [1, -1]
    length = np.hypot(*(end - start).T)
    points, weights = segment_rule(start, end, 5)
    along = np.einsum("sq,sqk->sk", weights, evaluate(points - [1.0, 1.0], 5))
    area = moments(turned, 4, origin=(1, 1))
    for k, (a, b) in enumerate(exponents(4).tolist()):
        source = exponents(5).tolist().index([a + 1, b])
        flux = along[:, source] * normal_length[:, 0] / length
        found = np.bincount(turned.polygon_of_point, flux, minlength=len(turned))
        np.testing.assert_allclose(found, (a + 1) * area[:, k], rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize("order", range(6))
def test_rule_weights_add_up_to_the_length(rng, order):
    start, end = rng.normal(size=(2, 9, 2))
    points, weights = segment_rule(start, end, order)
    assert points.shape == (9, order // 2 + 1, 2)
    np.testing.assert_allclose(weights.sum(axis=1), np.hypot(*(end - start).T), rtol=1e-15)


def test_no_segments_give_no_rows():
    none = np.zeros((0, 2))
    assert segment_rule(none, none, 3)[0].shape == (0, 2, 2)
