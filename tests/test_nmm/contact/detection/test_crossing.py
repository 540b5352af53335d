"""Crossings: no body passes through another unseen, and ordinary penetration is no crossing."""

from dataclasses import replace

import numpy as np
import pytest

from integration.polygons import Polygons
from nmm.contact.detection.crossing import crossings_in, motion_of, over_seams
from nmm.contact.detection.surface import Surface
from nmm.contact.detection.tolerances import FLUSH
from nmm.testing.detection.crossings import find_crossings
from nmm.testing.detection.search import near_pairs, polygon_surface


def rectangle(x: float, y: float, width: float, height: float) -> np.ndarray:
    return np.array([[x, y], [x + width, y], [x + width, y + height], [x, y + height]])


def scene(*rings: np.ndarray) -> Surface:
    return polygon_surface(Polygons.from_vertices(rings))


def shifted(surface: Surface, body: int, by: tuple[float, float]) -> Surface:
    step = np.where((surface.body == body)[:, None], np.array(by), 0.0)
    return replace(surface, start=surface.start + step, end=surface.end + step)


def test_a_block_thrown_through_a_thin_plate_is_stopped_where_it_touches():
    before = scene(rectangle(-5, 0, 10, 0.01), rectangle(-0.5, 1.01, 1, 1))
    crossings = find_crossings(before, shifted(before, 1, (0.0, -4.0)))
    # The lower corners, and the upper ones too: the whole block is below at the end.
    assert len(crossings) == 4
    np.testing.assert_allclose(crossings.free_fraction, 0.25, rtol=1e-14)  # 1 m of 4
    np.testing.assert_allclose(np.sort(crossings.fraction), [0.25, 0.25, 0.5, 0.5], rtol=1e-14)


def test_a_spike_under_the_block_goes_through_its_edge_too():
    spike = np.array([[0, 1], [-0.1, 0], [0.1, 0]], dtype=float)
    before = scene(spike, rectangle(-1, 2, 2, 1))
    crossings = find_crossings(before, shifted(before, 1, (0.0, -1.5)))
    assert crossings.vertex.tolist() == [int(np.flatnonzero(before.start[:, 1] == 1.0)[0])]
    np.testing.assert_allclose(crossings.fraction, 2.0 / 3.0, rtol=1e-14)


@pytest.mark.parametrize("start", [0.0, 1e-12, -1e-12, 0.3, -0.01])
def test_penetration_that_search_still_finds_is_no_crossing(start):
    before = scene(rectangle(-5, -1, 10, 1), rectangle(0, start, 1, 1))
    shallow = shifted(before, 1, (0.2, -start - 0.04))
    assert find_crossings(before, shallow).free_fraction == 1.0
    # Twice the area over the perimeter is 0.5 for the block: 0.05 is the depth that is followed.
    deep = shifted(before, 1, (0.2, -start - 0.06))
    crossings = find_crossings(before, deep)
    expected = start / (start + 0.06) if start > 0.0 else (start + 0.05) / (start + 0.06)
    assert len(crossings) == 2
    np.testing.assert_allclose(crossings.free_fraction, expected, rtol=1e-9)


def test_sliding_off_an_edge_and_falling_beside_it_is_no_crossing():
    before = scene(rectangle(0, -1, 1, 1), rectangle(0.9, 0.0, 1, 1))
    # At the depth of 0.05 the corner is 0.025 beyond the end, or still over the edge.
    assert find_crossings(before, shifted(before, 1, (0.5, -0.2))).free_fraction == 1.0
    assert find_crossings(before, shifted(before, 1, (0.3, -0.2))).free_fraction < 1.0


def test_sliding_deep_below_one_edge_along_another_is_no_crossing():
    # A corner 1e-4 below the sloping face of a wedge of 30 degrees slides from its tip towards
    # its heel: below the flat face it comes to 0.3, over that face, yet close to the surface.
    slope = np.array([np.cos(np.pi / 6), -np.sin(np.pi / 6)])
    wedge = np.array([[0.0, 0.0], [2.0, -2.0 * np.tan(np.pi / 6)], [2.0, 0.0]])
    inward = np.array([-slope[1], slope[0]])
    tip = 0.05 * slope + 1e-4 * inward
    block = tip + np.array([[0.0, 0.0], [-1.0, -0.1], [0.1, -1.0]])
    before = scene(wedge, block)
    assert find_crossings(before, shifted(before, 1, 0.6 * slope)).free_fraction == 1.0
    # Straight through the same flat face at the same place it is one.
    through = shifted(before, 1, 0.6 * slope + 0.3 * inward)
    assert find_crossings(before, through).free_fraction < 1.0


def test_a_block_that_flies_past_and_one_that_stays_cross_nothing():
    before = scene(rectangle(0, 0, 1, 1), rectangle(-3, 1.001, 1, 1))
    assert len(find_crossings(before, shifted(before, 1, (8.0, 0.0)))) == 0
    assert find_crossings(before, before).free_fraction == 1.0


def test_moving_edges_are_met_where_they_are_at_that_time():
    before = scene(rectangle(0, 0, 1, 1), rectangle(0, 2, 1, 1))
    after = shifted(shifted(before, 0, (0.0, 3.0)), 1, (0.0, -1.0))
    crossings = find_crossings(before, after)
    np.testing.assert_allclose(crossings.free_fraction, 0.25, rtol=1e-14)  # they meet at 1 m / 4


def test_random_throws_agree_with_fine_steps():
    rng = np.random.default_rng(7)
    for _ in range(200):
        turn = rng.uniform(0, 2 * np.pi)
        axes = np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
        block = (rectangle(-0.5, -0.5, 1, 1) @ axes) + [0.0, 1.5]
        before = scene(rectangle(-1, -1, 2, 1), block)
        way = rng.uniform([-3, -3], [3, 1])
        after = shifted(before, 1, tuple(way))
        corner = before.start[before.body == 1]
        times = np.linspace(0.0, 1.0, 3001)[:, None, None]
        path = corner + times * way
        # The depth of a unit square is 0.05; of the floor's 2 x 1 it is larger.
        over = (np.abs(path[..., 0]) <= 1.0) & (path[..., 1] <= -0.05)
        went = over & (path[..., 1] - 1e-3 * way[1] > -0.05)  # just below the line
        found = find_crossings(before, after)
        top = (before.body[found.vertex] == 1) & (before.normal[found.edge][:, 1] == 1.0)
        assert top.any() == went.any()


def test_result_does_not_depend_on_where_the_scene_is():
    before = scene(rectangle(-5, 0, 10, 0.01), rectangle(-0.5, 1.01, 1, 1))
    turn, shift = 0.8, 1e6
    axes = np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])

    def placed(surface: Surface) -> Surface:
        return replace(surface, start=surface.start @ axes + shift, end=surface.end @ axes + shift)

    after = shifted(before, 1, (0.3, -4.0))
    here, there = find_crossings(before, after), find_crossings(placed(before), placed(after))
    np.testing.assert_array_equal(here.vertex, there.vertex)
    np.testing.assert_array_equal(here.edge, there.edge)
    # 1e6 m carries 1.2e-10 m of a way of 4 m.
    np.testing.assert_allclose(here.fraction, there.fraction, rtol=0, atol=1e-9)


@pytest.mark.parametrize("way", [0.002, 0.7, 7.0])
@pytest.mark.parametrize("before", [0.0, 1e-6])
def test_a_corner_above_the_end_of_its_floor_slides_on_over_it_however_far(way, before):
    """Pressed in by a micrometre it comes in through the side of the floor, hidden by another body.

    The floor bears it: the side is no contact, though the corner is a millimetre from the end as
    it comes too deep, where steps no longer count as flush.
    """
    sunk = 1e-6
    floor, lower, block = rectangle(0, -2, 20, 2), rectangle(-4, -2, 4, 2), [before, -sunk]
    start = scene(floor, lower, rectangle(0, 0, 2, 2) + block)
    motion = motion_of(start, shifted(start, 2, (way, 0.0)), near_pairs(start, 8.0), FLUSH)
    found = crossings_in(motion, FLUSH)
    corner = (start.body[found.vertex] == 2) & (start.normal[found.edge][:, 0] == -1.0)
    assert corner.any()
    on_floor = np.isclose(start.normal[:, 1], 1.0) & (start.body == 0)
    at = found.vertex[corner]
    pairs = at, np.repeat(np.flatnonzero(on_floor), len(at))
    assert over_seams(found, motion, pairs)[corner].all()
