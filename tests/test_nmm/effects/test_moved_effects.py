"""Effects give the same answers in a scene that is shifted and turned as a whole."""

import json
import tomllib
from functools import cache

import numpy as np
import pytest

from nmm.formulation import Formulation
from nmm.scene import build_scene, canonical_text, parse_scene
from nmm.stepping.prepare import prepare
from nmm.testing import check_moved_effect
from nmm.testing.outputs import TWO_BLOCKS
from nmm.verification.hard.cases.transforms import shifted, turned
from nmm.verification.hard.spoilt.mutations import bases, sound_files

FAR, ANGLE = (1e3, 2e3), 0.7

# Scenes that are not the same elsewhere: a load is given as a function of position.
PLACED = {"loaded"}
# Effects that are not the same when turned: supports and water that follow the axes, and springs
# of supports and glue on a mesh, as stiff as cells are cut by it.
UPRIGHT = {
    "jointed": {"supports"},
    "cracked": {"supports"},
    "nets": {"bonded interfaces"},
    "heated": {"supports", "bonded interfaces"},
    "seeping": {"seepage", "supports"},
    "joints under water": {"joint flow"},
    "filling": {"transient joint flow"},
    "consolidating": {"consolidation", "supports"},
    "yielding": {"supports", "bonded interfaces"},
    "rolled over": {"supports"},
    "graded": {"supports"},
    "splines": {"supports"},
}
# Scenes that cannot be turned: free fields are vertical, fields and heads follow the axes, growing
# cracks have angles in degrees, cuts of sub-blocks and stages by a mesh follow the axes.
NOT_TURNED = {"shaken", "growing", "sub-blocks", "staged", *PLACED}


@cache
def document(name):
    """A scene of the suite in SI units, with its formulation."""
    raw = tomllib.loads(sound_files()[name][1])
    formulation = {key: raw[key] for key in raw if key == "formulation"}
    return json.loads(canonical_text(build_scene(raw, name))) | formulation


def names(scene):
    return prepare(scene, scene.formulation or Formulation()).stepper.plan.effects


@pytest.mark.parametrize("name", sorted(set(bases()[:-1]) - PLACED))
def test_effects_are_the_same_a_thousand_sizes_away(name):
    scene = build_scene(document(name), name)
    moved = build_scene(shifted(document(name), FAR), name)
    for effect in names(scene):
        check_moved_effect(scene, moved, effect)


@pytest.mark.parametrize("name", sorted(set(bases()[:-1]) - NOT_TURNED))
def test_effects_are_the_same_in_a_turned_scene(name):
    scene = build_scene(document(name), name)
    moved = build_scene(turned(document(name), ANGLE), name)
    for effect in set(names(scene)) - UPRIGHT.get(name, set()):
        check_moved_effect(scene, moved, effect, ANGLE)


def test_gravity_that_does_not_turn_with_its_scene_is_found():
    scene = parse_scene(TWO_BLOCKS)
    corners = np.array([[0.0, -1.0], [1.0, 0.0]])
    raw = json.loads(canonical_text(scene))
    for block in raw["blocks"]:
        block["vertices"] = (np.array(block["vertices"]) @ corners).tolist()
    moved = build_scene(raw, "turned")
    with pytest.raises(AssertionError, match="gravity: force at the start"):
        check_moved_effect(scene, moved, "gravity", -np.pi / 2)
