"""The reference form of the search, which the compiled one is held to, on squares known by hand."""

import numpy as np
import pytest
import shapely

from integration.polygons import Polygons
from nmm.contact.detection.contacts import VERTEX_EDGE
from nmm.testing.detection.crossings import find_crossings
from nmm.testing.detection.narrow_arrays import find_by_arrays
from nmm.testing.detection.search import near_pairs, near_pairs_by_tree, polygon_surface

FLOOR = shapely.box(0, 0, 4, 1)


def surface_of(*shapes):
    return polygon_surface(Polygons.from_shapely([*shapes]))


def test_rings_are_turned_so_that_the_solid_is_on_their_left():
    clockwise = shapely.Polygon([(0, 0), (0, 1), (1, 1), (1, 0)])
    surface = surface_of(clockwise)
    middle = (surface.start + surface.end) / 2
    # Normals point away from the middle of the square, half a side off.
    np.testing.assert_allclose(surface.normal, 2 * (middle - 0.5), rtol=0, atol=1e-15)
    assert (surface.previous[surface.next] == np.arange(4)).all()


def by_brute_force(surface, distance):
    """Pairs of a vertex and an edge of another body that are no further from each other."""
    lines = shapely.linestrings(np.stack([surface.start, surface.end], axis=1))
    away = shapely.distance(shapely.points(surface.start)[:, None], lines[None, :])
    other = surface.body[:, None] != surface.body[None, :]
    return {(int(v), int(e)) for v, e in np.argwhere((away <= distance) & other)}


@pytest.mark.parametrize("found_by", [near_pairs, near_pairs_by_tree])
def test_near_pairs_hold_all_of_a_brute_force_search(found_by):
    draw = np.random.default_rng(0)
    places = draw.uniform(0, 4, (30, 2))
    surface = surface_of(*(shapely.box(x, y, x + 0.5, y + 0.5) for x, y in places))
    pairs = set(zip(*(one.tolist() for one in found_by(surface, 0.2)), strict=True))
    assert by_brute_force(surface, 0.2) <= pairs
    if found_by is near_pairs_by_tree:  # the grid may find pairs of neighbouring cells besides
        assert by_brute_force(surface, 0.2) == pairs


@pytest.mark.parametrize("gap", [0.01, -0.01])
def test_a_block_above_a_floor_meets_it_at_its_two_corners(gap):
    surface = surface_of(FLOOR, shapely.box(1, 1 + gap, 2, 2 + gap))
    found = find_by_arrays(surface, *near_pairs(surface, 0.05), 0.05)
    place = surface.start[found.vertex]
    order = np.argsort(place[:, 0])
    np.testing.assert_allclose(place[order], [[1, 1 + gap], [2, 1 + gap]])
    np.testing.assert_allclose(found.gap, gap, rtol=0, atol=1e-15)
    np.testing.assert_allclose(found.normal, [[0, 1], [0, 1]], rtol=0, atol=1e-15)
    # The floor's upper edge runs from x = 4 to 0.
    np.testing.assert_allclose(found.parameter[order], [0.75, 0.5])
    assert (found.kind == VERTEX_EDGE).all()


@pytest.mark.parametrize("fall", [0.2, 1.5])
def test_a_block_that_falls_through_a_face_crosses_it_when_it_gets_there(fall):
    # Its lower corners are 0.1 above the floor.
    block = shapely.box(1, 1.1, 2, 2.1)
    before = surface_of(FLOOR, block)
    after = surface_of(FLOOR, shapely.transform(block, lambda at: at - [0, fall]))
    found = find_crossings(before, after)
    crossed = before.start[found.vertex], before.normal[found.edge]
    assert (crossed[0] == [[1, 1.1]]).all(axis=1).any()
    assert (crossed[0] == [[2, 1.1]]).all(axis=1).any()
    np.testing.assert_allclose(found.free_fraction, 0.1 / fall, rtol=1e-12)


def test_a_block_that_stops_above_a_face_crosses_nothing():
    block = shapely.box(1, 1.1, 2, 2.1)
    before = surface_of(FLOOR, block)
    after = surface_of(FLOOR, shapely.transform(block, lambda at: at - [0.5, 0.09]))
    assert not len(find_crossings(before, after))
