"""Corners in kinks of two bodies side by side: both edges bound their way, and no other does."""

from dataclasses import replace
from itertools import permutations

import numpy as np
import pytest

from integration.polygons import Polygons
from nmm.contact.detection.kinks import in_kinks
from nmm.contact.detection.narrow_phase import find_contacts
from nmm.contact.detection.neighbour_list import NeighbourList
from nmm.testing.detection.narrow_arrays import find_by_arrays
from nmm.testing.detection.search import polygon_surface

SLOPE, FLAT = [[-4, 4], [-4, -2], [0, -2], [0, 0]], [[0, 0], [0, -2], [6, -2], [6, 0]]
WEDGE, BLOCK = [[0, 0], [0, 2], [-2, 2]], [[0, 0], [2, 0], [2, 2], [0, 2]]
ENDS = [[np.cos(t), np.sin(t)] for t in np.radians([0, 100, 220, 360])]
SECTORS = [[[0, 0], ENDS[i], ENDS[i + 1]] for i in range(3)]
SQUARES = [[[x, y], [x + 1, y], [x + 1, y + 1], [x, y + 1]] for x in (-1, 0) for y in (-1, 0)]


def placed(rings, turn):
    """Return the turned edges of rings, and the axes that they were turned into."""
    axes = np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    rings = [np.array(ring, dtype=float) @ axes for ring in rings]
    return polygon_surface(Polygons.from_vertices(rings)), axes


def ground_and(blocks, turn, order):
    rings = [SLOPE, FLAT, *blocks]
    return placed([rings[body] for body in order], turn)


def found(rings, turn=0.0, reach=1e-3):
    """Return the body of the corner and the outward normal of the edge, unturned, of each pair."""
    surface, axes = placed(rings, turn)
    vertex, edge = in_kinks(surface, *NeighbourList(2 * reach).update(surface), reach)
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


@pytest.mark.parametrize("find", [find_contacts, find_by_arrays])
@pytest.mark.parametrize("order", list(permutations([0, 1, 2])))
@pytest.mark.parametrize("turn", [0.0, 0.7])
@pytest.mark.parametrize("lean", [0.0, 0.4])
@pytest.mark.parametrize("slid", [0.0, -1e-9, 5e-4, 7e-4, 1e-2])
def test_a_wedge_in_a_kink_meets_slope_and_flat_and_slides_over_their_corners(
    slid, lean, turn, order, find
):
    """Half a mm is flush with the kink, 1 cm past it; a side may lean less than the slope does."""
    wedge = np.add(WEDGE, [[slid, 0.0], [slid + lean, 0.0], [slid, 0.0]])
    surface, axes = ground_and([wedge], turn, order)
    contacts = find(surface, *NeighbourList(4e-3).update(surface), 2e-3)
    of_wedge = contacts.take(surface.body[contacts.vertex] == order.index(2))
    on_wedge = contacts.take(contacts.body == order.index(2))
    normals = (of_wedge.normal @ axes.T).round(9)
    assert (normals == [0, 1]).all(axis=1).sum() == 1
    # What does not lie along the wedge's lower face bounds no way.
    assert (np.abs(on_wedge.normal @ axes.T + 0.5**0.5) < 1e-9).all()


UPPER, LOWER = [[-4, 4], [-4, 0], [0, 0]], [[-4, 0], [-4, -2], [0, -2], [0, 0]]


@pytest.mark.parametrize("find", [find_contacts, find_by_arrays])
@pytest.mark.parametrize("pieces", [[SLOPE], [UPPER, LOWER], [LOWER, UPPER]])
@pytest.mark.parametrize("lean", [0.0, 2.0, 5.0])
@pytest.mark.parametrize("turn", [0.0, 0.7])
def test_of_bodies_that_move_as_one_the_kink_bounds_a_wedge_that_leans_however_far(
    turn, lean, pieces, find
):
    """The slope is inclined as the side that is 2 m off the vertical at its top."""
    surface, axes = placed([np.add(WEDGE, [[0, 0], [lean, 0], [0, 0]]), FLAT, *pieces], turn)
    surface = replace(surface, together=np.minimum(surface.body, 1))
    contacts = find(surface, *NeighbourList(4e-3).update(surface), 2e-3)
    of_wedge = contacts.take(surface.body[contacts.vertex] == 0)
    flat = (np.abs(of_wedge.normal @ axes.T - [0, 1]) < 1e-9).all(axis=1)
    assert flat.sum() == 1
    on_wedge = contacts.take(contacts.body == 0)
    assert (np.abs(on_wedge.normal @ axes.T + 0.5**0.5) < 1e-9).all()


@pytest.mark.parametrize("find", [find_contacts, find_by_arrays])
@pytest.mark.parametrize("order", [[0, 1, 2], [2, 1, 0], [1, 2, 0]])
@pytest.mark.parametrize("turn", [0.0, 3.0])
@pytest.mark.parametrize(("lean", "rise"), [(-1, 2), (0, 2), (2, 2), (5, 2), (0, 6), (2, 6)])
@pytest.mark.parametrize("down", [True, False])
@pytest.mark.parametrize("drive", ["weight", "motion"])
def test_weight_or_motion_says_whether_a_wedge_goes_over_a_loose_flat_or_the_flat_under_it(
    drive, down, lean, rise, turn, order, find
):
    """Down it drives the wedge into the kink, up the flat, which passes a side that leans away."""
    slope, flat = [[-4, 2 * rise], *SLOPE[1:]], FLAT
    rings = [slope, flat, [[0, 0], [lean, rise], [-2, rise]]]
    surface, axes = placed([rings[body] for body in order], turn)
    way = np.tile([0.0, -1e-6 if down else 1e-6] @ axes, (len(surface), 1))
    goes = way * (surface.body == order.index(2 if down else 1))[:, None]
    surface = replace(surface, weight=way if drive == "weight" else None)
    pairs = NeighbourList(4e-3).update(surface)
    contacts = find(surface, *pairs, 2e-3, motion=None if drive == "weight" else goes)
    of_wedge = contacts.take(surface.body[contacts.vertex] == order.index(2))
    on_wedge = contacts.take(contacts.body == order.index(2))
    on_flat = (of_wedge.body == order.index(1)).sum()
    below = (surface.body[on_wedge.vertex] == order.index(1)).sum()
    assert (on_flat, below) == ((1, 0) if down else (0, int(lean > 0)))


@pytest.mark.parametrize("turn", np.linspace(0.0, 3.0, 7))
@pytest.mark.parametrize(("rings", "sides"), [(SQUARES, 4), (SECTORS, 3)])
def test_cells_that_fit_meet_along_their_sides_alone(rings, sides, turn):
    surface, _ = placed(rings, turn)
    contacts = find_contacts(surface, *NeighbourList(2e-3).update(surface), 1e-3)
    pairs = np.sort([surface.body[contacts.vertex], contacts.body], axis=0)
    _, ends = np.unique(pairs, axis=1, return_counts=True)
    assert ends.tolist() == [2] * sides
