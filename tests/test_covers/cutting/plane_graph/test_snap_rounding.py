"""Lines meet in common points and nowhere else, and faces satisfy Euler's formula."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from covers.cutting.components import components
from covers.cutting.plane_graph.half_edges import half_edges
from covers.cutting.plane_graph.snap_rounding import NEAR, lines_between, node, undirected
from covers.cutting.resolution import clusters, resolution_of

BOX = np.array([[-1.0, -1.0], [1.0, 1.0]])


def noded(start, end):
    resolution = resolution_of(BOX)
    count = np.arange(len(start))
    points = np.concatenate([start, end])
    lines = lines_between(points, resolution, count, count + len(start))
    return node(lines, np.ones(len(start), dtype=bool), resolution)


def assert_plane(lines):
    """No point within NEAR steps of an edge that does not end in it, no crossing."""
    edges = undirected(lines.start, lines.end)[0]
    a, b = lines.steps[edges[:, :1]], lines.steps[edges[:, 1:]]
    along, away = b - a, lines.steps[None] - a
    square = (along**2).sum(axis=2)
    share = (along * away).sum(axis=2) / square
    distance = np.abs(along[..., 0] * away[..., 1] - along[..., 1] * away[..., 0]) / np.sqrt(square)
    own = (edges[:, :1] == np.arange(len(lines.steps))) | (
        edges[:, 1:] == np.arange(len(lines.steps))
    )
    used = np.unique(edges)  # a line without length leaves a point of its own
    met = (distance <= NEAR) & (share > 0) & (share < 1) & ~own
    assert not met[:, used].any()
    loops = half_edges(lines.steps, edges).n_loops
    parts = len(np.unique(components(len(lines.steps), *edges.T)[used]))
    assert len(used) - len(edges) + loops == 2 * parts


def test_a_cross_has_one_new_point_at_its_middle():
    lines = noded(np.array([[-1.0, -1], [-1, 1]]), np.array([[1.0, 1], [1, -1]]))
    assert len(lines.steps) == 5
    assert len(lines.start) == 4
    np.testing.assert_allclose(lines.points[4], [0, 0], atol=1e-16)


def test_lines_on_one_another_share_their_pieces_and_keep_their_sense():
    lines = noded(np.array([[0.0, 0], [0.7, 0.21]]), np.array([[1.0, 0.3], [0.3, 0.09]]))
    assert len(undirected(lines.start, lines.end)[0]) == 3
    first = lines.source == 0
    assert first.sum() == 3
    assert (lines.points[lines.end[first], 0] > lines.points[lines.start[first], 0]).all()
    assert lines.points[lines.end[~first], 0] < lines.points[lines.start[~first], 0]


@given(st.integers(0, 10**9), st.sampled_from([0.0, 1e-16, 1e-15, 3e-14, 1e-13, 1e-10]))
def test_random_lines_through_few_points_and_nearly_so_make_a_plane_graph(seed, away):
    random = np.random.default_rng(seed)
    grid = random.integers(-3, 4, (40, 2)) / random.choice([3.0, 4.0, 7.0])
    ends = grid.clip(-1, 1) + random.uniform(-away, away, grid.shape)
    assert_plane(noded(ends[:20], ends[20:]))


def test_a_bundle_of_nearly_parallel_lines_makes_a_plane_graph():
    slope = np.linspace(-1e-12, 1e-12, 21)
    start = np.stack([np.full(21, -0.9), -slope], axis=1)
    assert_plane(noded(start, -start))


def test_points_within_a_step_are_one_and_the_first_is_kept():
    first, cluster = clusters(np.array([[0.0, 0], [5, 5], [0.5, 0.5], [5, 5], [6.5, 5]]))
    assert first.tolist() == [0, 1, 4]
    assert cluster.tolist() == [0, 1, 0, 1, 2]


@pytest.mark.parametrize(("extent", "away"), [(1.0, 0.0), (1e-3, 0.0), (1e4, 0.0), (1.0, 1e6)])
def test_the_resolution_is_fine_and_never_finer_than_the_coordinates(extent, away):
    step = resolution_of(BOX * extent + away).step
    assert step >= 16 * np.spacing(extent + away)
    assert step <= max(6e-14 * extent, 64 * np.spacing(extent + away))
