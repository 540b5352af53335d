"""Singular functions in global axes, their quadrature, and the covers and angles about a point."""

import numpy as np
import pytest
import shapely

from covers.approximation.singular.branches import branches, middles
from covers.approximation.singular.carriers import carriers, touching_covers
from covers.approximation.singular.enrichment import Enrichment, near, polar, singular_fields
from covers.approximation.singular.rules import graded_rule
from covers.cutting.cut import cut
from covers.local_functions.singular_functions import SingularFunctions
from covers.mathematical.quads import Quads
from integration.polygons import Polygons

KAPPA = 1.8
# Modes I and II of a crack tip in the series of Williams: l = 1/2, Q = 1/3 and -1.
TIP = SingularFunctions((0.5, 0.5), (1 / 3, -1.0), (True, False), KAPPA, 1.0)


def about(point=(0.0, 0.0), angle=0.0, radius=0.0):
    return Enrichment(TIP, np.array(point), np.array([np.cos(angle), np.sin(angle)]), radius)


def test_angles_count_from_the_direction_of_the_point():
    item = about((1.0, 2.0), np.pi / 2)  # its x axis points up
    radius, angle = polar(item, np.array([[1.0, 5.0], [-1.0, 2.0], [2.0, 1.0]]))
    np.testing.assert_allclose(radius, [3.0, 2.0, np.sqrt(2)])
    np.testing.assert_allclose(angle, [0.0, np.pi / 2, -3 * np.pi / 4], atol=1e-15)


@pytest.mark.parametrize(("bearing", "found"), [(0.0, -3.0), (np.pi, 2 * np.pi - 3), (-6.0, -3.0)])
def test_an_angle_is_taken_on_the_branch_within_half_a_turn(bearing, found):
    np.testing.assert_allclose(near(np.array([-3.0]), np.array([bearing])), found)


def test_functions_turn_with_their_point():
    points = np.random.default_rng(0).uniform(-1, 1, (20, 2))
    turn = np.array([[np.cos(0.7), -np.sin(0.7)], [np.sin(0.7), np.cos(0.7)]])
    bearing = np.zeros(20)
    value, slope = singular_fields(about(), points, bearing)
    turned, its = singular_fields(about((3.0, -1.0), 0.7), points @ turn.T + [3.0, -1.0], bearing)
    np.testing.assert_allclose(turned, value @ turn.T, atol=1e-14)
    np.testing.assert_allclose(its, turn @ slope @ turn.T, atol=1e-12)


def test_slopes_are_those_of_the_values():
    points = np.random.default_rng(1).uniform(0.2, 1, (20, 2))
    item, bearing, step = about(angle=0.3), np.zeros(20), 1e-6
    _, slope = singular_fields(item, points, bearing)
    for axis in range(2):
        ways = (points + side * step * np.eye(2)[axis] for side in (1, -1))
        ahead, back = (singular_fields(item, way, bearing)[0] for way in ways)
        # Differences of second order: step^2 times third derivatives of order 10.
        np.testing.assert_allclose((ahead - back) / (2 * step), slope[..., axis], atol=1e-8)


@pytest.mark.parametrize(("mode", "axis"), [(0, 1), (1, 0)])
def test_faces_of_a_crack_part_as_the_root_of_the_distance(mode, axis):
    """By 2 (kappa + 1) sqrt(r) in the scale of the functions, across it in mode I, along it in II.

    Of displacements K / (2 mu) sqrt(r / 2 pi) (kappa + 1) on each face (Irwin 1957).
    """
    behind = np.array([[-0.25, 0.0], [-1.0, 0.0]])
    upper, lower = (singular_fields(about(), behind, np.full(2, b))[0] for b in (1.5, -1.5))
    parted = np.abs((upper - lower)[:, mode])
    np.testing.assert_allclose(parted[:, 1 - axis], 0.0, atol=1e-14)
    np.testing.assert_allclose(parted[:, axis], 2 * (KAPPA + 1) * np.sqrt([0.25, 1.0]))


SQUARE = Polygons.from_shapely([shapely.box(0, 0, 1, 1)])


@pytest.mark.parametrize(
    ("power", "exact"),
    [
        (-1, 2 * np.arcsinh(1.0)),
        (1, (np.sqrt(2) + np.arcsinh(1.0)) / 3),
        (0, 1.0),
    ],
)
def test_powers_of_the_distance_from_a_corner_are_integrated_over_a_square(power, exact):
    rule = graded_rule(SQUARE, np.zeros((1, 2)), np.array([[0]]), 1)
    radius = np.hypot(*rule.points.T)
    # The rule along the edges is of Gauss with at least a dozen points: 1e-12 and better.
    np.testing.assert_allclose(rule.weights @ radius**power, exact, rtol=1e-12)


def test_an_element_between_two_points_is_divided_between_them():
    """Of 1/r about both lower corners of a square: each half adds its own singular integral."""
    place = np.array([[0.0, 0.0], [1.0, 0.0]])
    rule = graded_rule(SQUARE, place, np.array([[0, 1]]), 4)
    np.testing.assert_allclose(rule.weights.sum(), 1.0, rtol=1e-13)
    nearest = np.minimum(*(np.hypot(*(rule.points - one).T) for one in place))
    # Over half a square, 1/2 by 1, about its corner: asinh(2) / 2 + asinh(1 / 2), twice.
    exact = 2 * (np.arcsinh(2.0) / 2 + np.arcsinh(0.5))
    np.testing.assert_allclose(rule.weights @ (1 / nearest), exact, rtol=1e-12)


def test_a_far_element_has_a_rule_of_gauss():
    far = Polygons.from_shapely([shapely.box(5, 0, 6, 1)])
    rule = graded_rule(far, np.zeros((1, 2)), np.array([[0]]), 1)
    assert (rule.weights > 0).all()
    np.testing.assert_allclose(rule.weights @ rule.points[:, 0] ** 2, 91 / 3, rtol=1e-14)


def test_middles_of_quadrants_are_their_bisectors():
    boxes = [shapely.box(x, y, x + 1, y + 1) for x in (-1, 0) for y in (-1, 0)]
    found = middles(Polygons.from_shapely(boxes), about())
    np.testing.assert_allclose(found, np.pi * np.array([-0.75, 0.75, -0.25, 0.25]))


CELLS = Quads.regular([[-2, -2], [2, 2]], 1.0)
PLATE = Polygons.from_shapely([shapely.box(-1.9, -1.9, 1.9, 1.9)])


def plate(*cracks):
    return cut(CELLS, PLATE, [np.array(one, dtype=float) for one in cracks])


def test_the_angle_jumps_across_the_crack_and_nowhere_else():
    tip = plate([(-2, 0), (0, 0)])
    element = np.arange(len(tip.elements))
    found = branches(tip, about(), element, np.zeros(len(element), dtype=np.int64))
    assert not found.torn.any()
    # Elements above the crack have angles above zero, those below it angles below.
    upper = tip.elements.centroids[:, 1] > 0
    assert (found.bearing[upper] > 0).all()
    assert (found.bearing[~upper] < 0).all()
    assert (np.abs(found.bearing) < np.pi).all()


def test_no_angle_is_continuous_about_a_point_without_a_crack_to_it():
    whole = plate()
    element = np.arange(len(whole.elements))
    found = branches(whole, about(), element, np.zeros(len(element), dtype=np.int64))
    assert found.torn.all()
    assert not carriers(whole, CELLS.patch_centre, [about()]).carried.any()


def test_covers_of_a_tip_are_those_of_the_elements_about_it():
    tip = plate([(-2, 0), (0, 0)])
    found = touching_covers(tip, np.zeros(2))
    # Four cells about the node: nine nodes, of which the one behind the tip has two covers.
    place = CELLS.patch_centre[tip.cover_patch[found]]
    assert len(found) == 10
    assert (np.abs(place) <= 1).all()
    carrying = carriers(tip, CELLS.patch_centre, [about()])
    assert carrying.carried.all()
    np.testing.assert_array_equal(np.flatnonzero(carrying.counts), found)


def test_covers_of_a_point_inside_an_element_are_those_of_the_element():
    whole = plate()
    found = touching_covers(whole, np.array([0.3, 0.6]))
    place = CELLS.patch_centre[whole.cover_patch[found]]
    assert sorted(map(tuple, place.tolist())) == [(0, 0), (0, 1), (1, 0), (1, 1)]
