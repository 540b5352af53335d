"""Joints: which stretches of boundary two bodies share, and the points that stand for them."""

from dataclasses import replace

import numpy as np
import pytest
import shapely

from integration.polygons import Polygons
from nmm.contact.detection.joints import find_joints, joint_ends, joint_points
from nmm.contact.detection.surface import Surface
from nmm.errors import FormulationError
from nmm.testing.detection.search import polygon_surface


def rectangle(x: float, y: float, width: float, height: float) -> np.ndarray:
    return np.array([[x, y], [x + width, y], [x + width, y + height], [x, y + height]])


def scene(*rings: np.ndarray) -> Surface:
    return polygon_surface(Polygons.from_vertices(rings))


def brick_wall(courses: int, bricks: int) -> Surface:
    rings = [
        rectangle(i + 0.5 * (j % 2), 0.5 * j, 1.0, 0.5)
        for j in range(courses)
        for i in range(bricks)
    ]
    return scene(*rings)


def voronoi(cells: int, seed: int) -> tuple[Surface, np.ndarray]:
    box = shapely.box(0.0, 0.0, 1.0, 1.0)
    points = shapely.multipoints(np.random.default_rng(seed).random((cells, 2)))
    polygons = shapely.intersection(shapely.get_parts(shapely.voronoi_polygons(points)), box)
    return polygon_surface(Polygons.from_shapely(polygons)), polygons


def test_a_block_on_a_longer_edge_shares_only_the_interval_it_covers():
    joints = find_joints(scene(rectangle(0, 0, 10, 1), rectangle(3, 1, 2, 1)))
    assert len(joints) == 1
    np.testing.assert_array_equal(joints.start, [[5.0, 1.0]])  # along edge a, the floor's top
    np.testing.assert_array_equal(joints.end, [[3.0, 1.0]])
    np.testing.assert_allclose(joints.parameter_a, [[0.5, 0.7]], rtol=0, atol=1e-15)
    np.testing.assert_array_equal(joints.parameter_b, [[1.0, 0.0]])
    np.testing.assert_array_equal(joints.normal, [[0.0, -1.0]])  # out of b, the upper block


def test_brick_wall_has_the_joints_that_are_counted_by_hand():
    # 3 courses of 4: three head joints a course; between courses 4 + 3 half-brick bed joints.
    joints = find_joints(brick_wall(3, 4))
    horizontal = joints.normal[:, 0] == 0.0
    assert (horizontal.sum(), (~horizontal).sum()) == (14, 9)
    np.testing.assert_allclose(joints.length, 0.5, rtol=1e-15)


def test_voronoi_joints_have_the_length_of_the_inner_boundary():
    surface, polygons = voronoi(300, seed=3)
    joints = find_joints(surface)
    inner = 0.5 * (shapely.length(polygons).sum() - 4.0)
    # Intervals shorter than the tolerance, 1e-6 of an edge, may be left out.
    np.testing.assert_allclose(joints.length.sum(), inner, rtol=1e-8)
    assert len(np.unique(np.stack([joints.edge_a, joints.edge_b]), axis=1).T) == len(joints)


@pytest.mark.parametrize(("angle", "shift"), [(0.0, 1e6), (0.7, 0.0), (2.1, 1e6)])
def test_joints_do_not_depend_on_where_the_scene_is(angle, shift):
    still = brick_wall(4, 5)
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    moved = replace(still, start=still.start @ turn.T + shift, end=still.end @ turn.T + shift)
    here, there = find_joints(still), find_joints(moved)
    np.testing.assert_array_equal(here.edge_a, there.edge_a)
    np.testing.assert_array_equal(here.edge_b, there.edge_b)
    # Coordinates of 1e6 carry 1.2e-10 each.
    np.testing.assert_allclose(here.parameter_a, there.parameter_a, rtol=0, atol=1e-9)


@pytest.mark.parametrize(
    ("gap", "expected"), [(0.0, 1), (1e-12, 1), (-1e-12, 1), (1e-9, 1), (1e-3, 0), (-1e-3, 0)]
)
def test_a_joint_is_what_lies_within_the_tolerance(gap, expected):
    surface = scene(rectangle(0, 0, 1, 1), rectangle(0, 1 + gap, 1, 1))
    assert len(find_joints(surface)) == expected


def test_blocks_that_touch_at_a_corner_or_run_the_same_way_have_no_joint():
    corner = scene(rectangle(0, 0, 1, 1), rectangle(1, 1, 1, 1))
    same_way = scene(rectangle(0, 0, 1, 1), rectangle(0, 0, 1, 2))  # one inside the other
    assert len(find_joints(corner)) == 0
    assert len(find_joints(same_way)) == 0


def test_faces_of_a_crack_in_one_body_are_paired_only_on_request():
    slit = np.array([[0, 0], [2, 0], [2, 1], [1, 1], [2, 1], [2, 2], [0, 2]], dtype=float)
    surface = scene(slit)
    assert len(find_joints(surface)) == 0
    joints = find_joints(surface, within_bodies=True)
    assert len(joints) == 1
    assert joints.length[0] == 1.0


def test_gauss_points_integrate_a_linear_stress_exactly_and_corners_carry_half_each():
    surface = scene(rectangle(0, 0, 2, 1), rectangle(0, 1, 2, 1))
    joints = find_joints(surface)
    for joint_rule in ("corners", "gauss"):
        points = joint_points(surface, joints, joint_rule)
        np.testing.assert_array_equal(points.length, [1.0, 1.0])
        np.testing.assert_allclose(points.gap, 0.0, atol=1e-15)
        np.testing.assert_allclose(points.position[:, 0].sum(), 2.0, rtol=1e-15)
    moment = (points.length * (points.position[:, 0] - 1.0) ** 2).sum()
    np.testing.assert_allclose(moment, 2.0 / 3.0, rtol=1e-15)  # int x^2 over (-1, 1)


def test_more_gauss_points_integrate_products_of_higher_degree():
    surface = scene(rectangle(0, 0, 2, 1), rectangle(0, 1, 2, 1))
    points = joint_points(surface, find_joints(surface), "gauss", 3)
    assert len(points) == 3
    # int x^2 and x^4 over (-1, 1): of linear and of quadratic jumps
    for power, expected in ((2, 2 / 3), (4, 2 / 5)):
        total = (points.length * (points.position[:, 0] - 1.0) ** power).sum()
        np.testing.assert_allclose(total, expected, rtol=1e-14)


def test_joint_points_follow_the_surface_and_measure_its_opening():
    surface = scene(rectangle(0, 0, 1, 1), rectangle(0, 1, 1, 1))
    joints = find_joints(surface)
    upper = (surface.body == 1)[:, None]
    lift = np.array([0.0, 1e-3])
    moved = replace(surface, start=surface.start + upper * lift, end=surface.end + upper * lift)
    points = joint_points(moved, joints, "gauss")
    # Side a is the lower block, b the upper: the distance along the outward normal of b opens.
    np.testing.assert_allclose(points.gap, 1e-3, rtol=1e-12)


def test_unknown_joint_rules_are_refused_by_name():
    surface = brick_wall(1, 2)
    with pytest.raises(FormulationError, match="simpson"):
        joint_points(surface, find_joints(surface), "simpson")


def test_ends_of_joints_name_the_vertices_that_search_would_report_too():
    surface = scene(rectangle(0, 0, 10, 1), rectangle(3, 1, 2, 1))
    joints = find_joints(surface)
    vertex, edge, joint = joint_ends(surface, joints)
    assert sorted(map(tuple, surface.start[vertex])) == [(3.0, 1.0), (5.0, 1.0)]
    assert (edge == joints.edge_a[0]).all()
    assert (joint == 0).all()


def test_no_edges_have_no_joints():
    none = np.empty((0, 2))
    index = np.empty(0, dtype=np.int64)
    surface = Surface(none, none, index, index, index)
    assert len(find_joints(surface)) == 0
    assert len(joint_points(surface, find_joints(surface))) == 0
