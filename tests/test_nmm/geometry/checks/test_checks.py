"""Every geometric fault of the blocks of a scene is told in one report."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import pytest
import shapely

from nmm.errors import GeometryError
from nmm.geometry import regions
from nmm.scene import Scene, build_scene
from nmm.testing.unit_squares import ROCK, SQUARE, scene_of, square_at


def _faults(scene: Scene) -> list[str]:
    with pytest.raises(GeometryError) as caught:
        regions(scene)
    return str(caught.value).splitlines()


def _line(*outlines: Any, **tables: Any) -> str:
    (line,) = _faults(scene_of(*outlines, **tables))
    return line


BOW = [[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]]
TOUCHING = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 0.0], [0.0, 1.0]]
BACK = [[0.0, 0.0], [2.0, 0.0], [1.0, 0.0], [1.0, 1.0]]


@pytest.mark.parametrize(
    ("outline", "parts"),
    [
        (BOW, ("crosses or touches itself at [0.5, 0.5]", "in the order")),
        (TOUCHING, ("crosses or touches itself at [1, 0]",)),
        (BACK, ("crosses or touches itself",)),
        ([[0, 0], [1, 0], [2, 0]], ("area 0 m2",)),
        ([[0, 0], [1, 0], [0.5, 1e-13]], ("area 5e-14 m2",)),
        ([[0, 0], [1, 0], [1, 0], [1, 1]], ("vertices 1 and 2 are both [1, 0]", "remove vertex 2")),
        ([[0, 0], [1, 0], [1, 1], [1e-14, 0]], ("vertices 3 and 0 are both",)),
    ],
)
def test_an_unsound_outline_is_refused(outline: Any, parts: Sequence[str]) -> None:
    line = _line(outline)
    assert [part for part in ("s.toml: blocks.0.vertices", *parts) if part not in line] == [], line


def test_a_thin_strip_a_small_block_and_a_closed_ring_are_sound() -> None:
    strip = [[0.0, -1.0], [1.0, -1.0], [1.0, 1e-4 - 1], [0.0, 1e-4 - 1]]
    whole = regions(scene_of([*SQUARE, SQUARE[0]], square_at(3, 0, 1e-4), strip))
    assert whole.polygons.areas == pytest.approx([1.0, 1e-8, 1e-4], rel=1e-9)


@pytest.mark.parametrize(
    ("holes", "part"),
    [
        ([[[0, 0.2], [0.5, 0.2], [0.5, 0.5]]], "touches or leaves"),
        ([[[0.5, 0.2], [1.5, 0.2], [0.5, 0.5]]], "touches or leaves"),
        ([square_at(0.2, 0.2, 0.4), square_at(0.4, 0.4, 0.4)], "meets another hole"),
        ([square_at(0.2, 0.2, 0.5), square_at(0.3, 0.3, 0.1)], "meets another hole"),
    ],
)
def test_unsound_holes_are_refused(holes: Any, part: str) -> None:
    block = {"material": "rock", "vertices": SQUARE, "holes": holes}
    (line,) = _faults(_with_blocks(block))
    assert part in line
    assert "blocks.0.holes" in line


def _with_blocks(*blocks: Any) -> Scene:
    return build_scene({"plane": "strain", "materials": {"rock": ROCK}, "blocks": blocks}, "s.toml")


def test_the_overlaps_told_are_those_of_every_pair_of_blocks() -> None:
    rng = np.random.default_rng(3)
    # triangles with random and flush places, some sharing an edge, some a corner, some ground
    corner = rng.integers(0, 6, (40, 2)) + 0.3 * rng.integers(0, 2, (40, 2))
    outlines = [[[x, y], [x + 1, y], [x, y + 1]] for x, y in corner.tolist()]
    shapes = [shapely.Polygon(ring) for ring in outlines]
    pairs = [(a, b) for a in range(40) for b in range(a)]
    # areas are 0.5 m2: of what the pairs share nothing lies between rounding and 1e-3 m2
    expected = sum(shapes[a].intersection(shapes[b]).area > 1e-3 for a, b in pairs)
    assert 5 < expected < len(pairs)
    assert len(_faults(scene_of(*outlines))) == expected


def test_overlapping_and_nested_blocks_are_refused() -> None:
    lines = _faults(scene_of(SQUARE, square_at(0.5, 0.5), square_at(5, 5, 3.0), square_at(6, 6)))
    assert '"b1" overlaps "b0" by 0.25 m2' in lines[0]
    assert '"b3" lies inside "b2"' in lines[1]
    assert "blocks.3" in lines[1]


@pytest.mark.parametrize("gap", [0.0, 1e-12, -1e-12, 1e-16, -1e-8])
def test_blocks_that_touch_up_to_rounding_pass(gap: float) -> None:
    assert len(regions(scene_of(SQUARE, square_at(1 + gap, 0), square_at(0, 1 + gap)))) == 3


def test_a_block_in_a_hole_of_its_size_passes() -> None:
    ring = {"material": "rock", "vertices": square_at(-1, -1, 3.0), "holes": [SQUARE]}
    assert len(regions(_with_blocks(ring, {"material": "rock", "vertices": SQUARE}))) == 2


def test_two_identical_blocks_are_refused() -> None:
    assert "lies inside" in _line(SQUARE, SQUARE)


def _support(**place: Any) -> dict[str, Any]:
    return {"supports": [{"name": "s", "fix": ["x"], **place}]}


def _edge_load(segment: Any, **more: Any) -> dict[str, Any]:
    load = {"name": "p", "kind": "edge", "segment": segment, "traction": [0, -1], **more}
    return {"loads": [load]}


@pytest.mark.parametrize(
    ("tables", "parts"),
    [
        (_support(point=[2.5, 0]), ("supports.0", "1.5 m away", '"b0"')),
        (_support(segment=[[0, 2], [1, 2]]), ("lies on no edge",)),
        (_support(segment=[[0, 0.5], [1, 0.5]]), ("lies on no edge",)),
        (_support(segment=[[0, 0], [0, 0]]), ("segment of length 0",)),
        (_edge_load([[0.5, 1], [1.5, 1]]), ("loads.0", "50.000% of the segment")),
        (_edge_load([[0, 1], [1, 2]]), ("lies on no edge",)),
        ({"monitors": [{"name": "m", "point": [1, 3]}]}, ("monitors.0", "2 m away")),
        ({"initial_stresses": [{"block": "b0.7", "stress": [0, 0, 0]}]}, ('"b0.7"', "a piece")),
    ],
)
def test_a_place_that_touches_nothing_is_refused(tables: Any, parts: Sequence[str]) -> None:
    line = _line(SQUARE, **tables)
    assert [part for part in parts if part not in line] == [], line


def test_a_load_on_a_joint_must_say_which_block_it_loads() -> None:
    load = _edge_load([[0, 1], [1, 1]])
    assert "both sides" in _line(SQUARE, square_at(0, 1), **load)
    narrowed = _edge_load([[0, 1], [1, 1]], block="b0")
    assert len(regions(scene_of(SQUARE, square_at(0, 1), **narrowed))) == 2


def test_all_geometric_faults_are_reported_at_once() -> None:
    lines = _faults(scene_of(SQUARE, SQUARE, **_support(point=[9, 9])))
    assert len(lines) == 2
    assert len(_faults(scene_of(BOW, TOUCHING))) == 2


def test_a_far_scene_is_read_like_a_near_one() -> None:
    far = [[x + 1e6, y - 1e6] for x, y in SQUARE]
    beside = [[x + 1e6 + 1, y - 1e6] for x, y in SQUARE]
    scene = scene_of(far, beside, **_support(point=[1e6 + 0.3, -1e6]))
    assert regions(scene).polygons.areas.tolist() == [1.0, 1.0]


def test_a_wall_of_two_thousand_blocks_passes() -> None:
    wall = [square_at(x, y) for x in range(50) for y in range(40)]
    assert len(regions(scene_of(*wall))) == 2000


@pytest.mark.parametrize("tiny", [1e-320, -5e-324])
def test_a_coordinate_that_has_lost_its_digits_is_refused(tiny):
    # GEOS divides by it: points on surfaces overflow. Smaller than any length it is meant as zero.
    faults = _faults(scene_of([[tiny, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]))
    assert len(faults) == 1
    assert "b0" in faults[0] or "blocks.0" in faults[0]
    assert "expected zero" in faults[0]
