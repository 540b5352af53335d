"""Cracks settle on what they nearly touch, and stay exactly where they are otherwise."""

import numpy as np
import pytest
import shapely

from covers.cutting.cracks import clipped, crack_segments, settled
from covers.cutting.cut import cut
from covers.cutting.domain import Segments
from covers.mathematical.quads import Quads
from integration.polygons import Polygons

CELLS = Quads.regular([[0, 0], [3, 3]], 1.0)
BLOCK = Polygons.from_shapely([shapely.box(0, 0, 3, 3)])
RIM = Segments(
    np.array([[0.0, 0], [3, 0], [3, 3], [0, 3]]),
    np.array([[3.0, 0], [3, 3], [0, 3], [0, 0]]),
    np.zeros(4, dtype=np.int64),
)
EDGES = Segments(CELLS.vertices[CELLS.edges.start], CELLS.vertices[CELLS.edges.end], np.arange(24))


def settle(*cracks):
    return settled(crack_segments(cracks), RIM, CELLS.vertices, EDGES, 1e-8)


def test_points_far_from_everything_keep_their_bits():
    crack = np.array([[0.123456789, 0.3], [0.7, 1.7], [2.2, 1.1 + 1e-7]])
    moved = settle(crack)
    assert (moved.start == crack[:-1]).all()
    assert (moved.end == crack[1:]).all()


def test_points_near_a_vertex_become_it_and_near_a_line_go_to_its_nearest_place():
    moved = settle([[1 + 5e-9, 1 - 3e-9], [1.5, 2 + 5e-9], [3 + 6e-9, 2.5]])
    np.testing.assert_array_equal(moved.start, [[1, 1], [1.5, 2]])
    np.testing.assert_array_equal(moved.end, [[1.5, 2], [3, 2.5]])


def test_a_segment_that_passes_vertices_within_the_tolerance_is_bent_through_them():
    moved = settle([[0, 1e-9], [3, 3]])
    np.testing.assert_array_equal(moved.start, [[0, 0], [1, 1], [2, 2]])
    np.testing.assert_array_equal(moved.end, [[1, 1], [2, 2], [3, 3]])


@pytest.mark.parametrize(("off", "vertex"), [(5e-9, [1, 1]), (5e-8, [1 + 5e-8, 1])])
def test_cuts_move_cracks_by_a_hundred_millionth_of_the_smallest_cell(off, vertex):
    found = cut(CELLS, BLOCK, [[[0.3, 1.0], [1 + off, 1.0]]])
    ends = found.elements.points[found.elements.points[:, 1] == 1.0]
    assert (ends == vertex).all(axis=1).any()
    assert not ((ends[:, 0] > 1) & (ends[:, 0] < vertex[0])).any()


def test_ends_near_another_crack_meet_it_and_ends_near_one_another_are_one():
    moved = settle(
        [[0.2, 0.2], [0.8, 0.2]], [[0.5, 0.2 + 5e-9], [0.5, 0.7]], [[0.5, 0.7 + 2e-9], [0.6, 0.9]]
    )
    crossing = np.array([0.5, 0.2 + 5e-9])
    assert (moved.end[0] == crossing).all()
    assert (moved.start[1] == crossing).all()
    assert (moved.start[3] == moved.end[2]).all()
    assert moved.owner.tolist() == [0, 0, 1, 2]


def test_a_crack_shorter_than_the_tolerance_vanishes():
    assert len(settle([[1, 1], [1 + 3e-9, 1]])) == 0


def test_clipping_keeps_inner_points_and_drops_what_is_outside():
    segments = crack_segments(
        [[[-5, 0.5], [0.5, 0.5], [0.5, 9]], [[-3, 4], [4, 4]], [[2, 2], [2, 3]]]
    )
    inside = clipped(segments, np.zeros(2), np.ones(2))
    np.testing.assert_allclose(inside.start, [[0, 0.5], [0.5, 0.5]], atol=1e-15)
    np.testing.assert_allclose(inside.end, [[0.5, 0.5], [0.5, 1]], atol=1e-15)


def test_cracks_far_beyond_the_block_cut_it_as_their_part_inside_does():
    long = cut(CELLS, BLOCK, [[[-1e9, 1.5], [1e9, 1.5]]])
    assert (long.n_bodies, long.n_covers) == (2, 24)
    assert abs(long.elements.areas.sum() - 9) < 1e-12


@pytest.mark.parametrize("overshoot", [-1e-9, -1e-13, 0.0, 1e-13, 1e-9])
def test_a_crack_that_ends_at_the_rim_up_to_rounding_reaches_it(overshoot):
    result = cut(CELLS, BLOCK, [[[-overshoot, 1.5], [3 + overshoot, 1.6]]])
    assert (result.n_bodies, len(result.tips)) == (2, 0)


def test_a_ligament_wider_than_the_tolerance_holds():
    result = cut(CELLS, BLOCK, [[[0, 1.5], [3 - 1e-6, 1.6]]])
    assert (result.n_bodies, len(result.tips)) == (1, 1)
    # Nodes at x = 0 and 1 are parted, those at 2 and 3 hang together by the ligament.
    assert result.n_covers == 16 + 4


@pytest.mark.parametrize(
    ("crack", "cell", "direction"),
    [
        ([[0, 0.5], [0.5, 0.5]], 0, (1, 0)),
        ([[0, 0.5], [1, 0.5]], 1, (1, 0)),  # on an edge: the cell ahead
        ([[0, 0], [1, 1]], 4, (np.sqrt(0.5), np.sqrt(0.5))),  # on a node: the cell ahead
        ([[2.5, 3], [2.5, 1.2]], 5, (0, -1)),
    ],
)
def test_tips_name_the_element_ahead_and_the_direction(crack, cell, direction):
    tips = cut(CELLS, BLOCK, [crack]).tips
    assert len(tips) == 1
    np.testing.assert_allclose(tips.direction[0], direction, atol=1e-14)
    np.testing.assert_array_equal(tips.point[0], crack[1])
    assert cut(CELLS, BLOCK, [crack]).element_cell[tips.element[0]] == cell


def test_crack_faces_lie_on_both_sides_of_every_crack_edge_with_their_cracks_number():
    result = cut(CELLS, BLOCK, [[[0, 0.4], [3, 0.7]], [[1.2, 1.3], [2.2, 2.4]]])
    edges = result.boundary
    for number, length in enumerate((np.hypot(3, 0.3), np.hypot(1, 1.1))):
        faces = np.flatnonzero(edges.crack == number)
        assert np.hypot(*(edges.end - edges.start)[faces].T).sum() == pytest.approx(2 * length)
        assert (edges.crack[edges.opposite[faces]] == number).all()
    # The material lies on the left: the lower body's face of crack 0 runs against x.
    below = (edges.crack == 0) & (edges.body == edges.body[np.argmin(edges.start[:, 1])])
    assert ((edges.end - edges.start)[below, 0] < 0).all()
