"""Integrals over polygons beside those of benchmark D1, and what must not change them."""

import numpy as np
import shapely

from integration.moments import moments
from integration.monomials import count, exponents
from integration.polygons import Polygons


def column(a, b):
    return exponents(a + b).tolist().index([a, b])


def test_random_rings_agree_with_rational_arithmetic(rng, random_star, exact):
    rings = [random_star(rng, n) for n in (3, 4, 5, 7, 12)]
    found = moments(Polygons.from_vertices(rings), 5, origin=(0, 0))
    for ring, row in zip(rings, found, strict=True):
        expected = [float(exact(ring, a, b)) for a, b in exponents(5).tolist()]
        # coordinates and moments are of order one; terms cancel within that
        np.testing.assert_allclose(row, expected, rtol=1e-14, atol=1e-15)


def test_central_moments_do_not_feel_a_shift(rng, random_star):
    # a grid of 2^-20 makes the shifted coordinates exact
    rings = [np.round(random_star(rng, n) * 2**20) / 2**20 for n in (3, 5, 8)]
    near = Polygons.from_vertices(rings)
    far = near.with_points(near.points + np.array([2.0**20, -(2.0**19)]))
    # the centroid is rounded to 1e-10 there and moves the third moments by that
    np.testing.assert_allclose(moments(far, 6), moments(near, 6), rtol=0, atol=5e-10)
    origin = far.points[far.first_point]
    anchored = moments(near, 6, origin=near.points[near.first_point])
    np.testing.assert_allclose(moments(far, 6, origin=origin), anchored, rtol=0, atol=1e-8)


def test_sense_of_the_rings_does_not_matter(holed):
    expected = moments(holed, 6, origin=(0, 0))
    first, second = holed.points[:5], holed.points[5:]
    for rings in ([first[::-1], second], [first, second[::-1]], [first[::-1], second[::-1]]):
        found = moments(Polygons.from_rings([rings]), 6, origin=(0, 0))
        np.testing.assert_allclose(found, expected, rtol=1e-14)


def test_first_vertex_does_not_matter(holed):
    expected = moments(holed, 6, origin=(0, 0))
    rings = [np.roll(holed.points[:5], 3, axis=0), np.roll(holed.points[5:], 1, axis=0)]
    found = moments(Polygons.from_rings([rings]), 6, origin=(0, 0))
    np.testing.assert_allclose(found, expected, rtol=1e-14)


def test_collinear_and_duplicate_vertices_do_not_matter():
    plain = Polygons.from_vertices([[(0, 0), (2, 0), (2, 1), (0, 1)]])
    extra = Polygons.from_vertices(
        [[(0, 0), (0, 0), (1, 0), (2, 0), (2, 0), (2, 0.5), (2, 1), (0, 1), (0, 1)]]
    )
    np.testing.assert_allclose(moments(extra, 4), moments(plain, 4), rtol=1e-14, atol=1e-16)


def test_pieces_add_up_to_the_whole(holed, rng):
    whole = moments(holed, 6, origin=(1, 1))[0]
    shape = holed.to_shapely()[0]
    for _ in range(20):
        direction = rng.normal(size=2)
        across = np.array([-direction[1], direction[0]])
        middle = rng.uniform([0.5, 0.5], [3.5, 1.5])
        corners = [middle - 20 * direction, middle + 20 * direction]
        half = shapely.Polygon([*corners, corners[1] + 20 * across, corners[0] + 20 * across])
        parts = np.array([shape.intersection(half), shape.difference(half)])
        pieces = Polygons.from_shapely(shapely.get_parts(parts))
        # GEOS rounds the new vertices to 1e-16
        found = moments(pieces, 6, origin=(1, 1)).sum(axis=0)
        np.testing.assert_allclose(found, whole, rtol=1e-12, atol=1e-12)


def test_scaled_monomials_keep_the_area_physical(assorted):
    plain = moments(assorted, 4, origin=(1, 2))
    scale = np.array([0.5, 2.0, 4.0, 1.0, 3.0])
    found = moments(assorted, 4, origin=(1, 2), scale=scale)
    expected = plain / scale[:, None] ** exponents(4).sum(axis=1)
    np.testing.assert_allclose(found, expected, rtol=1e-14)


def test_default_origin_is_the_centroid(assorted):
    found = moments(assorted, 4)
    np.testing.assert_allclose(
        found, moments(assorted, 4, origin=assorted.centroids), rtol=1e-15, atol=1e-15
    )
    np.testing.assert_allclose(found[:, 1:3], 0.0, atol=1e-14)
    assert np.array_equal(found[:, 0], assorted.areas)


def test_zero_area_gives_zeros():
    flat = Polygons.from_vertices(
        [[(0, 0), (1, 1), (2, 2)], [(0.1, 0.2), (0.2, 0.4), (0.3, 0.6)], [(3, 4)] * 4]
    )
    assert not moments(flat, 4, origin=(7, 8), scale=0.1).any()


def test_no_polygons_give_no_rows(assorted):
    none = assorted.take([])
    assert moments(none, 3).shape == (0, count(3))
    assert moments(none, 3, origin=np.zeros((0, 2)), scale=np.ones(0)).shape == (0, count(3))


def test_tilted_slivers_are_no_worse_than_their_vertices(rng, exact):
    for thickness in (1e-3, 1e-6, 1e-9):
        ring = np.array([(0, 0), (1, 0), (1.1, thickness), (0.1, thickness)])
        angle = rng.uniform(0, 2 * np.pi)
        turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
        ring = ring @ turn.T
        found = moments(Polygons.from_vertices([ring]), 2, origin=(0, 0))[0]
        expected = [float(exact(ring, a, b)) for a, b in exponents(2).tolist()]
        # differences of coordinates of order one carry 1e-16, that is 1e-16/thickness of the area
        np.testing.assert_allclose(found, expected, rtol=1e-15 / thickness)
