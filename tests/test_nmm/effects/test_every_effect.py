"""Effects: force, matrix, work and energy of each fit each other, on blocks and on meshes."""

import tomllib

import pytest

import nmm
from nmm.formulation import Formulation
from nmm.scene import build_scene
from nmm.stepping.prepare import prepare
from nmm.testing import check_effect, check_effect_of
from nmm.testing.outputs import TWO_BLOCKS
from nmm.verification.hard.spoilt.mutations import bases, sound_files

LOADS = """
[[loads]]
name = "push"
kind = "edge"
segment = [[1, 2], [2, 2]]
traction = [1e3, -2e3]
[[loads]]
name = "pull"
kind = "body"
density = [1.0, 2.0]
[[initial_stresses]]
block = "top"
stress = [1e3, 2e3, 500.0]
"""
BONDED = TWO_BLOCKS.replace("[contact]", "").replace(
    "friction_angle = 0.5",
    "friction_angle = 0.5\nbonded = true\ncohesion = 1e6\ntensile_strength = 1e6",
)
COVERS = {
    "triangles": "[formulation.cover]\ntype = 'triangles'\nsize = 0.5\n",
    "cubic": "[formulation.cover]\ntype = 'quads'\nsize = 1.0\ndegree = 3\n",
}
HELD = ["gravity", "loads", "body loads", "supports", "initial stress"]


@pytest.mark.parametrize("name", HELD)
def test_an_effect_on_blocks_keeps_what_every_one_promises(name):
    check_effect_of(nmm.parse_scene(TWO_BLOCKS + LOADS), name)


@pytest.mark.parametrize("cover", COVERS)
@pytest.mark.parametrize("name", [*HELD, "bonded interfaces"])
def test_an_effect_on_meshes_keeps_what_every_one_promises(name, cover):
    check_effect_of(nmm.parse_scene(BONDED + LOADS + COVERS[cover]), name)


def test_glue_of_sub_blocks_keeps_what_every_effect_promises():
    text = TWO_BLOCKS + "[formulation.cover]\ntype = 'sub_blocks'\nsize = 0.5\n"
    check_effect_of(nmm.parse_scene(text), "artificial joints")


@pytest.mark.parametrize("scene", bases()[:-1])
def test_effects_of_a_whole_scene_keep_what_every_one_promises(scene):
    made = build_scene(tomllib.loads(sound_files()[scene][1]), scene)
    prepared = prepare(made, made.formulation or Formulation())
    assert prepared.stepper.plan.effects
    for effect in prepared.stepper.plan.effects.values():
        check_effect(effect, prepared.stepper.model, prepared.start)


@pytest.mark.parametrize("name", ["prestressed_joint/joint", "seed_cases/reinforced/crack"])
def test_bars_of_examples_keep_what_every_effect_promises(name):
    made = build_scene(tomllib.loads(sound_files()[name][1]), name)
    check_effect_of(made, "bars", made.formulation)
