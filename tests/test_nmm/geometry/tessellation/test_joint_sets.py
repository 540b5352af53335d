"""Joint sets: statistics of the joints, blocks cut, cracks left."""

import math

import numpy as np
import pytest

from integration.arrays import Floats
from integration.polygons import Polygons
from nmm.errors import GeometryError
from nmm.geometry import JointSetGeometry, cut

UNIT = Polygons.from_vertices([[[0, 0], [1, 0], [1, 1], [0, 1]]])
LOW, HIGH = np.array([0.0, 0.0]), np.array([100.0, 100.0])


def _lengths(segments: Floats) -> Floats:
    return np.asarray(np.hypot(*(segments[:, 1] - segments[:, 0]).T))


def test_two_through_going_sets_cut_a_grid() -> None:
    flat = JointSetGeometry(0.0, 0.25, origin=(0.0, 0.125)).segments(UNIT.points[0], UNIT.points[2])
    steep = JointSetGeometry(math.pi / 2, 0.5, origin=(0.25, 0.0)).segments(
        UNIT.points[0], UNIT.points[2]
    )
    answer = cut(UNIT, np.concatenate([flat, steep]))
    assert len(answer.polygons) == 5 * 3
    assert sorted(answer.polygons.areas)[-1] == pytest.approx(0.125, rel=1e-12)
    assert answer.polygons.areas.sum() == pytest.approx(1.0, rel=1e-14)
    assert len(answer.cracks) == 0


def test_neighbours_share_vertices_at_crossings_bit_by_bit() -> None:
    joints = [
        JointSetGeometry(0.3, 0.1, 0.1, 0.02, seed=1),
        JointSetGeometry(1.9, 0.15, 0.1, 0.02, seed=2),
    ]
    lines = np.concatenate([set_.segments(UNIT.points[0], UNIT.points[2]) for set_ in joints])
    cells = cut(UNIT, lines).polygons
    edges = np.concatenate([cells.points, cells.points[cells.next_point]], axis=1)
    known = {edge.tobytes() for edge in edges}
    outer = np.array([e for e in edges if np.roll(e, 2).tobytes() not in known])
    assert len(cells) > 30
    assert np.hypot(*(outer[:, 2:] - outer[:, :2]).T).sum() == pytest.approx(4.0, rel=1e-12)


def test_a_persistence_of_next_to_nothing_leaves_no_joint() -> None:
    joints = JointSetGeometry(0.3, 0.5, persistence=1e-320, trace=2.0, origin=(0.0, 0.0))
    assert joints.segments(LOW, HIGH).shape == (0, 2, 2)


def test_spacing_dip_and_persistence_are_those_asked_for() -> None:
    joints = JointSetGeometry(
        math.radians(30),
        spacing=0.5,
        dip_scatter=0.02,
        spacing_scatter=0.05,
        persistence=0.7,
        trace=4.0,
        trace_scatter=0.5,
        seed=7,
    )
    segments = joints.segments(LOW, HIGH)
    step = segments[:, 1] - segments[:, 0]
    angle = np.arctan2(step[:, 1], step[:, 0])
    # 280 lines of some 50 traces: means within three standard errors.
    assert angle.mean() == pytest.approx(math.radians(30), abs=3 * 0.02 / math.sqrt(280))
    lines, where = np.unique(np.round(angle, 12), return_index=True)
    # And so a standard deviation, whose own error is 1 / sqrt(2 n) of it.
    assert lines.std() == pytest.approx(0.02, rel=3 / math.sqrt(2 * 280))
    diagonal = math.hypot(100, 100)
    assert len(where) == pytest.approx(diagonal / 0.5, rel=0.03)
    lengths = _lengths(segments)
    assert lengths.mean() == pytest.approx(4.0, rel=0.01)
    assert lengths.std() == pytest.approx(0.5, rel=0.05)
    assert lengths.sum() / (len(where) * 2 * diagonal) == pytest.approx(0.7, rel=0.03)


def test_the_same_seed_gives_the_same_joints() -> None:
    first, second, third = (
        JointSetGeometry(0.3, 0.1, 0.1, 0.02, 0.5, 0.4, seed=seed).segments(LOW, HIGH / 50)
        for seed in (3, 3, 4)
    )
    assert first.tobytes() == second.tobytes() != third.tobytes()


def test_a_joint_that_ends_inside_is_returned_as_crack() -> None:
    answer = cut(UNIT, np.array([[[0.5, -1.0], [0.5, 0.5]]]))
    assert len(answer.polygons) == 1
    assert answer.polygons.areas[0] == pytest.approx(1.0, rel=1e-15)
    # Ends are drawn out by 1e-6 of the extent to meet edges they were meant to meet.
    assert answer.cracks == pytest.approx(np.array([[[0.5, 0.0], [0.5, 0.5]]]), abs=2e-6)


def test_joints_that_stop_at_other_joints_leave_no_crack() -> None:
    lines = np.array([[[0.0, 0.5], [1.0, 0.5]], [[0.5, 0.0], [0.5, 0.5 - 1e-8]]])
    answer = cut(UNIT, lines)
    assert sorted(answer.polygons.areas) == pytest.approx([0.25, 0.25, 0.5], abs=1e-7)
    assert len(answer.cracks) == 0


@pytest.mark.parametrize("miss", [0.0, 1e-14, 1e-12, 1e-9, 1e-7])
def test_joints_through_corners_and_crossings_leave_no_slivers(miss: float) -> None:
    lines = np.array(
        [
            [[0.0, miss], [1.0, 1.0 + miss]],
            [[0.0, 1.0 - miss], [1.0, miss]],
            [[0.5 + miss, -1.0], [0.5 + miss, 2.0]],
        ]
    )
    areas = cut(UNIT, lines).polygons.areas
    assert sorted(areas) == pytest.approx([0.125] * 4 + [0.25] * 2, abs=1e-6)
    assert areas.sum() == pytest.approx(1.0, rel=1e-12)


def test_every_region_is_cut_on_its_own_and_keeps_its_area() -> None:
    ring = [[[0, 0], [4, 0], [4, 4], [0, 4]], [[1, 1], [3, 1], [3, 3], [1, 3]]]
    both = Polygons.from_rings([ring, [[[4, 0], [6, 0], [6, 4], [4, 4]]]])
    lines = JointSetGeometry(0.0, 0.5, origin=(0.0, 0.25)).segments(LOW, HIGH / 10)
    answer = cut(both, lines)
    assert np.bincount(answer.region, answer.polygons.areas) == pytest.approx([12.0, 8.0])
    assert np.count_nonzero(answer.region == 1) == 9  # eight lines from y = 0.25 to 3.75


def test_a_spacing_far_below_the_region_is_refused() -> None:
    with pytest.raises(GeometryError, match="increase the spacing"):
        JointSetGeometry(0.0, 1e-4).segments(LOW, HIGH, "bedding")


def test_joints_that_almost_coincide_leave_neither_slivers_nor_short_edges() -> None:
    sets = [JointSetGeometry(angle, 0.2, spacing_scatter=0.02, seed=3) for angle in (0.1, 1.3)]
    lines = np.concatenate([item.segments(UNIT.points[0], UNIT.points[2]) for item in sets])
    single = cut(UNIT, lines).polygons
    for shift in (1e-15, 1e-12, 1e-9, 1e-7):
        double = cut(UNIT, np.concatenate([lines, lines + shift])).polygons
        assert len(double) == len(single)
        assert double.areas.sum() == pytest.approx(1.0, rel=1e-12)
        edges = double.points[double.next_point] - double.points
        assert np.hypot(*edges.T).min() > 1e-6


def test_neighbouring_regions_share_the_joints_that_cross_their_border() -> None:
    pair = Polygons.from_vertices([UNIT.points, UNIT.points + np.array([1.0, 0.0])])
    lines = JointSetGeometry(0.3, 0.15, 0.05, 0.02, seed=5).segments(LOW, np.array([2.0, 1.0]))
    answer = cut(pair, lines)
    assert np.bincount(answer.region, answer.polygons.areas) == pytest.approx([1.0, 1.0], rel=1e-12)
    points = answer.polygons.points
    owner = answer.region[answer.polygons.polygon_of_point]
    left, right = (
        {point.tobytes() for point in points[(owner == k) & (points[:, 0] == 1.0)]} for k in (0, 1)
    )
    assert left == right
    assert len(left) > 5


def test_a_set_without_a_joint_in_the_region_cuts_nothing() -> None:
    far = JointSetGeometry(0.0, 50.0, persistence=0.5, trace=1.0, origin=(0.0, 20.0))
    assert len(cut(UNIT, far.segments(UNIT.points[0], UNIT.points[2])).polygons) == 1
