"""What is known to spoil answers of an effect is told before a run."""

import tomllib

import pytest

from nmm.verification.hard.cases.parts import meshes, with_parts
from nmm.verification.hard.generators.cracks.cuts import SIZE, _bar
from nmm.verification.hard.generators.features import FEATURES
from nmm.verification.hard.oracles.motion import prepared


@pytest.mark.parametrize(("size", "told"), [(0.25, True), (0.2, False), (0.125, False)])
def test_cells_larger_than_the_length_of_means_are_told_of_zones(size, told):
    text = FEATURES["cohesive zones"].text
    assert "length = 0.2" in text
    scene = tomllib.loads(text.replace("size = 0.25", f"size = {size}"))
    found = prepared(scene).identity().warnings
    assert any("take cells no larger" in one for one in found) == told


@pytest.mark.parametrize(
    ("cover", "away", "glue", "told"),
    [
        ("mls degree 1", -1e-12, "nitsche", True),
        ("mls degree 1", 1e-6, "nitsche", False),
        ("mls degree 1", -1e-12, "spring", False),
        ("triangles degree 1", -1e-12, "nitsche", False),
    ],
)
def test_glue_on_slivers_of_least_squares_is_told(cover, away, glue, told):
    table = {**meshes(SIZE)[cover], "angle": 0.0}
    parts = {"glue.method": glue, "supports.method": "nitsche"}
    found = prepared(with_parts(_bar(table, away), parts)).identity().warnings
    assert any("slivers" in one for one in found) == told


IMPACT = """
plane = "strain"
duration = 0.01
[materials.a]
young_modulus = 1e9
poisson_ratio = 0.0
density = 1000.0
[interfaces.i]
friction_angle = 0.0
restitution = 0.5
[[blocks]]
material = "a"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[blocks]]
material = "a"
vertices = [[1.01, 0], [2, 0], [2, 1], [1.01, 1]]
[inertia]
[contact]
"""


@pytest.mark.parametrize(
    ("functions", "penalty", "told"),
    [("rigid_strain", 10.0, True), ("rigid", 10.0, False), ("rigid_strain", 0.01, False)],
)
def test_bodies_that_give_way_in_place_of_their_dampers_are_told(functions, penalty, told):
    scene = tomllib.loads(IMPACT)
    scene["formulation"] = {
        "cover": {"functions": functions},
        "contact": {"normal_penalty": penalty},
    }
    found = prepared(scene).identity().warnings
    assert any("give way in place of the damper" in one for one in found) == told


WET = """
plane = "strain"
[materials.m]
young_modulus = 1e9
poisson_ratio = 0.2
density = 2000.0
hydraulic_conductivity = 1e-6
[interfaces.i]
friction_angle = 0.5
[[blocks]]
name = "floor"
material = "m"
vertices = [[0, 0], [3, 0], [3, 1], [0, 1]]
[[blocks]]
name = "block"
material = "m"
vertices = [[1, 1], [2, 1], [2, 2], [1, 2]]
[gravity]
[contact]
[seepage]
[[heads]]
name = "h"
block = "all"
head = 2.0
[[supports]]
name = "s"
segment = [[0, 0], [3, 0]]
fix = ["x", "y"]
"""
PRESSED = '[[water_pressures]]\nname = "w"\nlevel = 2\nsegment = '


@pytest.mark.parametrize(
    ("water", "told"),
    [
        ("", True),
        (PRESSED + "[[2, 1], [2, 2]]", True),  # beside the block alone
        (PRESSED + "[[1, 1], [2, 1]]", False),
    ],
    ids=["none", "beside", "in the joint"],
)
def test_porous_blocks_that_meet_without_water_in_their_joint_are_told(water, told):
    found = prepared(tomllib.loads(WET + water)).identity().warnings
    assert any("those of total stress" in one for one in found) == told


ANCHORED = """
plane = "strain"
duration = 0.1
[materials.m]
young_modulus = 1e9
poisson_ratio = 0.2
density = 2000.0
[[blocks]]
name = "wall"
material = "m"
vertices = [[0, 0], [1, 0], [1, 3], [0, 3]]
[inertia]
[[springs]]
name = "anchor"
points = [[1, 2], [5, 2]]
blocks = ["wall", "ground"]
stiffness = 1e6
[[supports]]
name = "base"
segment = [[0, 0], [1, 0]]
fix = ["x", "y"]
"""
SHAKEN = 'motion = { x = "quake" }\n[records.quake]\nsamples = [[0, 0], [0.05, 1], [0.1, 0]]\n'


@pytest.mark.parametrize(("motion", "told"), [(SHAKEN, True), ("", False)])
def test_anchors_in_ground_that_stays_beside_a_base_that_moves_are_told(motion, told):
    found = prepared(tomllib.loads(ANCHORED + motion)).identity().warnings
    assert any("ground of anchor stays" in one for one in found) == told
