"""Ragged polygons: construction, selection, conversion, area and centroid."""

import numpy as np
import pytest
import shapely

from integration.polygons import Polygons, diameters


def same(a: Polygons, b: Polygons) -> bool:
    return all(
        np.array_equal(getattr(a, name), getattr(b, name))
        for name in ("points", "ring_offsets", "polygon_offsets")
    )


def test_a_closing_vertex_is_dropped():
    ring = [(0, 0), (1, 0), (0, 1)]
    assert same(Polygons.from_vertices([ring]), Polygons.from_vertices([[*ring, ring[0]]]))


@pytest.mark.parametrize(
    ("rings", "message"),
    [
        ([[[(0, 0), (1, 0)]]], "polygon 0, exterior: 2 vertices: at least 3 expected: add"),
        (
            [[[(0, 0), (1, 0), (1, 1)]], [[(0, 0), (1, 0), (1, 1)], [(0, 0), (1, 1), (0, 0)]]],
            "polygon 1, hole 1: 2 vertices: at least 3",
        ),
        ([[[]]], "polygon 0, exterior: 0 vertices"),
        ([[]], "polygon 0: no ring"),
        ([[[1, 2, 3]]], r"polygon 0, exterior: shape \(3,\): \(n, 2\) expected"),
        ([[[(0, 0), (1, float("nan")), (1, 1)]]], r"polygon 0: vertex \[1.0, nan\]: finite"),
    ],
)
def test_faulty_rings_are_named(rings, message):
    with pytest.raises(ValueError, match=message):
        Polygons.from_rings(rings)


@pytest.mark.parametrize("shape", [shapely.Point(0, 0), shapely.Polygon()])
def test_a_shape_without_area_is_named(shape):
    with pytest.raises(ValueError, match="polygon 1: .*split collections"):
        Polygons.from_shapely([shapely.box(0, 0, 1, 1), shape])


def test_shapely_and_back_keeps_every_vertex(assorted):
    assert same(assorted, Polygons.from_shapely(assorted.to_shapely()))


def test_area_and_centroid_agree_with_geos(assorted):
    shapes = assorted.to_shapely()[:4]
    chosen = assorted.take(range(4))
    np.testing.assert_allclose(chosen.areas, shapely.area(shapes), rtol=1e-15)
    expected = shapely.get_coordinates(shapely.centroid(shapes))
    np.testing.assert_allclose(chosen.centroids, expected, rtol=1e-14)


def test_diameter_is_the_diagonal_of_the_bounding_box(holed):
    assert diameters(holed) == 5.0


def test_the_extent_is_the_diagonal_of_the_box_around_all_polygons():
    triangle = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
    assert Polygons.from_vertices([triangle, triangle + np.array([2.0, 3.0])]).extent == 5.0


def test_taking_and_joining_are_inverse(assorted):
    parts = [assorted.take([n]) for n in range(len(assorted))]
    assert same(assorted, Polygons.concatenate(parts))
    mask = np.array([True, False, True, False, True])
    assert same(assorted.take(mask), assorted.take([0, 2, 4]))
    assert same(assorted.take([3, -4]), Polygons.concatenate([parts[3], parts[1]]))


def test_topology_of_a_polygon_with_a_hole(holed):
    assert holed.next_point.tolist() == [1, 2, 3, 4, 0, 6, 7, 8, 5]
    assert holed.ring_of_point.tolist() == [0] * 5 + [1] * 4
    assert holed.polygon_of_ring.tolist() == [0, 0]
    assert holed.polygon_of_point.tolist() == [0] * 9


def test_oriented_turns_exteriors_left_and_holes_right(assorted):
    turned = assorted.oriented()
    sense = turned.ring_areas * turned.ring_signs
    assert (sense >= 0).all()
    assert np.array_equal(np.sort(turned.points, axis=0), np.sort(assorted.points, axis=0))
    shapes = zip(turned.to_shapely(), assorted.to_shapely(), strict=True)
    assert all(shapely.equals(a, b) for a, b in shapes)


def test_moved_points_keep_the_topology_and_renew_the_area(holed):
    assert holed.areas[0] == 7.5
    index = holed.next_point
    moved = holed.with_points(2.0 * holed.points)
    assert moved.next_point is index
    assert moved.areas[0] == 30.0
    with pytest.raises(ValueError, match="shape"):
        holed.with_points(holed.points[:-1])


def test_no_polygons_have_empty_properties(assorted):
    none = assorted.take([])
    assert len(none) == len(Polygons.from_rings([])) == len(Polygons.concatenate([])) == 0
    assert none.areas.shape == diameters(none).shape == none.to_shapely().shape == (0,)
    assert none.centroids.shape == (0, 2)
    assert len(Polygons.from_shapely([])) == 0


def test_centroid_of_zero_area_is_the_mean_vertex():
    flat = Polygons.from_vertices(
        [[(0, 0), (1, 1), (2, 2)], [(0.1, 0.1), (0.3, 0.3), (0.7, 0.7)], [(5, 7)] * 2 + [(5, 8)]]
    )
    assert not flat.areas.any()
    expected = [(1, 1), (1.1 / 3, 1.1 / 3), (5, 22 / 3)]
    np.testing.assert_allclose(flat.centroids, expected, rtol=1e-15)


def test_shared_area_and_centroid_cannot_be_overwritten(holed):
    with pytest.raises(ValueError, match="read-only"):
        holed.areas[0] = 1.0
    with pytest.raises(ValueError, match="read-only"):
        holed.centroids[0] = 1.0
