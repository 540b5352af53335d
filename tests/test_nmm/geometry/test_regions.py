"""All blocks of a scene: corners, names and materials, whatever they are made by."""

from typing import Any

import numpy as np
import pytest

from nmm.geometry import regions
from nmm.scene import parse_scene
from nmm.testing.unit_squares import SQUARE, scene_of, square_at


def test_blocks_keep_their_corners_and_come_counter_clockwise() -> None:
    whole = regions(scene_of(SQUARE[::-1], square_at(1, 0)))
    assert whole.polygons.areas.tolist() == [1.0, 1.0]
    assert (whole.polygons.ring_areas > 0).all()
    assert sorted(whole.polygons.points[:4].tolist()) == sorted(SQUARE)
    assert whole.name == ("b0", "b1")


def test_names_materials_and_selection_over_all_sources() -> None:
    scene = parse_scene(
        """
        plane = "stress"
        materials.steel = {young_modulus = 2e11, poisson_ratio = 0.3}
        materials.rock = {young_modulus = 1e9, poisson_ratio = 0.2}
        [[blocks]]
        material = "steel"
        vertices = [[0, -1], [4, -1], [4, 0], [0, 0]]
        [[blocks]]
        name = "slab"
        material = "rock"
        vertices = [[0, 1], [4, 1], [4, 2], [0, 2]]
        [[tessellations]]
        name = "core"
        material = "rock"
        region = [[0, 0], [4, 0], [4, 1], [0, 1]]
        blocks = 12
        [[joint_sets]]
        name = "cracks"
        block = "slab"
        dip = "90 deg"
        spacing = 1.0
        origin = [0.5, 0]
        """
    )
    whole = regions(scene)
    assert whole.name[:2] == ("#0", "slab.0")
    assert len(whole.select("slab")) == 5
    assert len(whole.select("core")) == 12
    assert whole.select("core.3").tolist() == [6 + 3]
    assert len(whole.select("cor")) == 0
    assert len(whole.select("all")) == len(whole) == 18
    assert whole.material.tolist() == [0] + 17 * [1]
    assert np.bincount(whole.source, whole.polygons.areas) == pytest.approx([4.0, 4.0, 4.0])


def test_load_and_support_points_become_vertices_of_tessellated_blocks() -> None:
    tables: dict[str, Any] = {
        "tessellations": [{"name": "beam", "material": "rock", "region": SQUARE, "blocks": 30}],
        "supports": [{"name": "left", "point": [0.123, 0], "fix": ["y"]}],
        "loads": [
            {"name": "p", "kind": "edge", "segment": [[0.4, 1], [0.45, 1]], "traction": [0, -1]}
        ],
    }
    points = {tuple(p) for p in regions(scene_of(**tables)).polygons.points.tolist()}
    assert {(0.123, 0.0), (0.4, 1.0), (0.45, 1.0)} <= points


def test_tessellations_without_a_seed_follow_the_scene_and_differ_from_each_other() -> None:
    two = [
        {"name": name, "material": "rock", "region": region, "blocks": 9}
        for name, region in (("a", SQUARE), ("b", square_at(2, 0)))
    ]
    first, again, other = (
        regions(scene_of(tessellations=two, seed=seed)).polygons for seed in (1, 1, 2)
    )
    assert first.points.tobytes() == again.points.tobytes() != other.points.tobytes()
    assert abs(np.diff(first.areas.reshape(2, 9), axis=0)).max() > 1e-3


def test_joints_that_end_inside_blocks_are_handed_on_as_cracks() -> None:
    sets = [
        {"name": "j", "dip": 0.0, "spacing": 0.4, "persistence": 0.5, "trace": 0.3, "seed": 1},
        {"name": "k", "dip": 1.2, "spacing": 0.4, "seed": 2},
    ]
    whole = regions(scene_of(SQUARE, joint_sets=sets))
    assert whole.polygons.areas.sum() == pytest.approx(1.0, rel=1e-12)
    assert len(whole.cracks) > 0
    assert len(whole.cracks) == len(whole.crack_region)
    assert whole.crack_region.min() >= 0
