"""Integrals along segments."""

import numpy as np
import pytest

from integration.moments import moments
from integration.monomials import count, evaluate, exponents
from integration.segments import segment_moments, segment_rule


def test_a_unit_segment_has_the_integrals_of_t():
    found = segment_moments(
        np.array([[0.0, 0.0]]), np.array([[3.0, 4.0]]), 3, np.zeros((1, 2)), np.ones(1)
    )
    # x = 3 t, y = 4 t, ds = 5 dt
    a, b = exponents(3).T
    np.testing.assert_allclose(found[0], 5.0 * 3.0**a * 4.0**b / (a + b + 1), rtol=1e-15)


@pytest.mark.parametrize("degree", range(7))
def test_moments_agree_with_points_of_a_higher_rule(rng, degree):
    start, end = rng.normal(size=(2, 20, 2))
    origin, scale = rng.normal(size=(20, 2)), rng.uniform(0.5, 2, 20)
    points, weights = segment_rule(start, end, degree + 6)
    values = evaluate((points - origin[:, None]) / scale[:, None, None], degree)
    expected = np.einsum("sq,sqk->sk", weights, values)
    found = segment_moments(start, end, degree, origin, scale)
    size = np.einsum("sq,sqk->sk", weights, np.abs(values))
    assert (np.abs(found - expected) <= 1e-14 * size).all()


def test_greens_theorem_links_edges_and_area(assorted):
    turned = assorted.oriented()
    start, end = turned.points, turned.points[turned.next_point]
    normal_length = (end - start)[:, ::-1] * [1, -1]
    length = np.hypot(*(end - start).T)
    origin = np.broadcast_to([1.0, 1.0], start.shape)
    along = segment_moments(start, end, 5, origin, np.ones(len(start)))
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


def test_a_segment_without_length_has_zero_moments():
    point = np.ones((1, 2))
    assert not segment_moments(point, point, 2, np.zeros((1, 2)), np.ones(1)).any()


def test_no_segments_give_no_rows():
    none = np.zeros((0, 2))
    assert segment_moments(none, none, 3, none, np.ones(0)).shape == (0, count(3))
    assert segment_rule(none, none, 3)[0].shape == (0, 2, 2)
