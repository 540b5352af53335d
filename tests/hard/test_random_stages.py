"""Stages of random scenes: not the same acts in all of them, and each names what is there."""

from functools import cache

import pytest

from nmm.verification.hard.generators.scenes.places import has_place
from nmm.verification.hard.generators.scenes.scenes import Scenes

SEEDS = range(250)
NAMED = {
    "loads": ("loads",),
    "supports": ("supports",),
    "members": ("springs", "bars", "masses", "foundations"),
}


@cache
def staged_scenes():
    cases = [case for seed in SEEDS for case in Scenes().cases(seed)]
    return [case.scene for case in cases if case.parts["kind"] == "stages"]


def test_each_of_loads_supports_and_members_changes_with_a_stage_of_some_scene():
    later = [stage for scene in staged_scenes() for stage in scene["stages"][1:]]
    assert set(NAMED) <= {key for stage in later for key in stage}
    assert any(stage.get("loads") for stage in later)


def test_stages_name_nothing_that_the_scene_does_not_hold():
    for scene in staged_scenes():
        for key, tables in NAMED.items():
            there = {one["name"] for table in tables for one in scene.get(table, [])}
            assert all(set(stage.get(key, [])) <= there for stage in scene["stages"])


SQUARES = [
    {"name": "low", "vertices": [[0, 0], [1, 0], [1, 1], [0, 1]]},
    {"name": "high", "vertices": [[0, 1], [1, 1], [1, 2], [0, 2]]},
]


@pytest.mark.parametrize(
    ("acts", "low", "high"),
    [
        ({"segment": [[0, 0], [1, 0]]}, True, False),
        ({"segment": [[0, 0], [0, 2]]}, True, True),
        ({"point": [1, 2]}, False, True),
        ({"block": "low"}, True, False),
        ({"points": [[0.5, 0.5], [0.5, 1.5]]}, False, False),
        ({"points": [[1, 2], [9, 9]], "blocks": ["high", "ground"]}, False, True),
    ],
)
def test_what_acts_has_a_place_where_its_edge_point_or_block_is_there(acts, low, high):
    scene = {"blocks": SQUARES}
    assert has_place(acts, scene, ("low",)) == low
    assert has_place(acts, scene, ("high",)) == high
    assert has_place(acts, scene, ("low", "high"))


def test_no_stage_of_a_random_scene_is_held_where_no_block_is():
    for scene in staged_scenes():
        there = {one["name"] for one in scene["blocks"]}
        for stage in scene["stages"]:
            there = set(stage.get("blocks", there)) | set(stage.get("add", []))
            there -= set(stage.get("remove", []))
            assert has_place(scene["supports"][0], scene, tuple(there))
