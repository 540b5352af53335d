"""Corners in kinks of two bodies side by side: both edges bound their way, and no other does."""

import numpy as np
import pytest

from integration.polygons import Polygons
from nmm.contact.detection.kinks import in_kinks, standing
from nmm.contact.detection.neighbour_list import NeighbourList
from nmm.testing.detection.search import polygon_surface

SLOPE, FLAT = [[-4, 4], [-4, -2], [0, -2], [0, 0]], [[0, 0], [0, -2], [6, -2], [6, 0]]
WEDGE, BLOCK = [[0, 0], [0, 2], [-2, 2]], [[0, 0], [2, 0], [2, 2], [0, 2]]
ENDS = [[np.cos(t), np.sin(t)] for t in np.radians([0, 100, 220, 360])]
SECTORS = [[[0, 0], ENDS[i], ENDS[i + 1]] for i in range(3)]
SQUARES = [[[x, y], [x + 1, y], [x + 1, y + 1], [x, y + 1]] for x in (-1, 0) for y in (-1, 0)]


def found(rings, turn=0.0, reach=1e-3, alone=False):
    """Return the body of the corner and the outward normal of the edge, unturned, of each pair."""
    axes = np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    rings = [np.array(ring, dtype=float) @ axes for ring in rings]
    surface = polygon_surface(Polygons.from_vertices(rings))
    near = NeighbourList(2 * reach).update(surface)
    vertex, edge = standing(surface, *near) if alone else in_kinks(surface, *near, reach)
    return surface.body[vertex], surface.normal[edge] @ axes.T


@pytest.mark.parametrize("up", [0.0, 1e-12, 1e-4])
@pytest.mark.parametrize("turn", [0.0, 0.7, 3.0])
def test_a_toe_in_a_kink_of_two_bodies_meets_both(up, turn):
    wedge = np.add(WEDGE, [-up, up])
    body, normal = found([SLOPE, FLAT, wedge, BLOCK], turn)
    slope, flat, block = [0.5**0.5, 0.5**0.5], [0, 1], [-1, 0]
    np.testing.assert_allclose(normal[body == 2], [slope, flat, block], rtol=0, atol=1e-12)


@pytest.mark.parametrize("turn", np.linspace(0.0, 3.0, 7))
def test_corners_on_a_seam_of_the_floor_meet_no_sides_of_it(turn):
    """Of four squares about a point each meets the two beside it: the upper ones may slide off."""
    body, normal = found(SQUARES, turn)
    beside = [[0, -1], [-1, 0]], [[0, 1], [-1, 0]], [[0, -1], [1, 0]], [[0, 1], [1, 0]]
    for of in range(4):
        mine = sorted(normal[body == of].round(9).tolist())
        assert mine == sorted(beside[of])


@pytest.mark.parametrize("up", [0.0, 1e-12, 1e-4])
@pytest.mark.parametrize("turn", [0.0, 0.7, 3.0])
def test_a_toe_stands_on_the_edge_below_its_flush_neighbour_alone(up, turn):
    """By its sides it lies on the slope and on the block; the block so stands before the slope."""
    wedge = np.add(WEDGE, [-up, up])
    body, normal = found([SLOPE, FLAT, wedge, BLOCK], turn, alone=True)
    np.testing.assert_allclose(normal[body == 2], [[0, 1]], rtol=0, atol=1e-12)
    np.testing.assert_allclose(normal[body == 3], [[0.5**0.5, 0.5**0.5]], rtol=0, atol=1e-12)


@pytest.mark.parametrize("turn", np.linspace(0.0, 3.0, 7))
@pytest.mark.parametrize("rings", [SQUARES, SECTORS])
def test_cells_that_fit_stand_on_nothing_beside_their_sides(rings, turn):
    assert not len(found(rings, turn, alone=True)[0])
