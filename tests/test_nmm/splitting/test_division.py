"""Polygons cut through their middles: areas, shared vertices, and the rules of size and number."""

import numpy as np
import pytest
import shapely
from shapely import affinity

from integration.polygons import Polygons
from nmm.splitting.cuts import face_length, pieces
from nmm.splitting.division import SplitRules, allowed, parts_of, replaced, sizes

SQUARE = shapely.box(0, 0, 1, 1)
MIDDLE = np.array([0.5, 0.5])


@pytest.mark.parametrize("angle", [0.0, np.pi / 4, np.pi / 2, 0.3, 2.0, -1.0])
@pytest.mark.parametrize("turn", [0.0, 0.1, 33.0])
def test_two_pieces_share_the_cut_and_leave_nothing(angle, turn):
    block = affinity.rotate(SQUARE, turn, origin=(0.5, 0.5))
    found = pieces(block, MIDDLE, [angle + np.radians(turn)])
    assert len(found) == 2
    np.testing.assert_allclose(shapely.area(found), 0.5, rtol=1e-12)
    one, other = ({tuple(x) for x in shapely.get_coordinates(part)} for part in found)
    assert len(one & other) == 2  # both ends of the cut, bit by bit


def test_a_diagonal_runs_through_corners_without_leaving_small_edges():
    found = pieces(SQUARE, MIDDLE, [np.pi / 4, 3 * np.pi / 4])
    assert len(found) == 4
    assert all(len(shapely.get_coordinates(part)) == 4 for part in found)  # triangles, closed


def test_a_ring_is_cut_into_halves_and_an_l_into_its_parts():
    ring = shapely.Point(0, 0).buffer(2).difference(shapely.Point(0, 0).buffer(1))
    halves = pieces(ring, np.zeros(2), [0.2])
    np.testing.assert_allclose(shapely.area(halves), ring.area / 2, rtol=1e-12)
    angled = shapely.Polygon([(0, 0), (3, 0), (3, 1), (1, 1), (1, 3), (0, 3)])
    parts = pieces(angled, np.array(angled.centroid.coords[0]), [-np.pi / 4])
    assert len(parts) == 3
    assert shapely.area(parts).sum() == pytest.approx(5, rel=1e-12)


def test_of_two_planes_the_one_with_shorter_faces_is_taken_and_both_where_they_are_alike():
    block, rules = shapely.box(0, 0, 4, 1), SplitRules(1e-3, 10)
    planes = np.array([np.pi / 2 - 0.2, 0.3])
    found = parts_of(block, np.array([2, 0.5]), planes, rules)
    assert len(found) == 2
    assert face_length(block, np.array([2, 0.5]), planes[0]) == pytest.approx(1 / np.cos(0.2))
    alike = parts_of(block, np.array([2, 0.5]), np.array([0.7, -0.7]), rules)
    assert len(alike) == 4


@pytest.mark.parametrize("aspect", [1, 100, 1e4])
def test_slivers_are_refused_below_the_smallest_size_and_sound_above_it(aspect):
    block = shapely.box(0, 0, 1, 1 / aspect)
    middle, along = np.array([0.5, 0.5 / aspect]), np.zeros(1)
    width = sizes(np.array([shapely.box(0, 0, 1, 0.5 / aspect)]))[0]
    assert width == pytest.approx(4 * 0.5 / aspect / (2 + 1 / aspect))
    assert len(parts_of(block, middle, along, SplitRules(1.01 * width, 10))) == 1
    found = parts_of(block, middle, along, SplitRules(0.99 * width, 10))
    np.testing.assert_allclose(shapely.area(found), 0.5 / aspect, rtol=1e-12)


def test_the_most_overloaded_come_first_and_those_alike_all_or_none():
    use, more = np.array([1.1, 1.5, 1.3, 1.3 + 1e-12, 1.2]), np.ones(5, dtype=int)
    for order in ([0, 1, 2, 3, 4], [4, 2, 0, 3, 1]):
        chosen = [allowed(use[order], more, room) for room in (0, 1, 2, 3, 5)]
        back = np.argsort(order)
        assert [one[back].tolist() for one in chosen] == [
            [False] * 5,
            [False, True, False, False, False],
            [False, True, False, False, False],
            [False, True, True, True, False],
            [True] * 5,
        ]


def test_pieces_stand_in_the_place_of_their_block():
    blocks = Polygons.from_shapely([shapely.box(n, 0, n + 1, 1) for n in range(3)])
    halves = pieces(shapely.box(1, 0, 2, 1), np.array([1.5, 0.5]), [np.pi / 2])
    found, parent = replaced(blocks, {1: halves})
    assert parent.tolist() == [0, 1, 1, 2]
    np.testing.assert_allclose(found.areas, [1, 0.5, 0.5, 1])
