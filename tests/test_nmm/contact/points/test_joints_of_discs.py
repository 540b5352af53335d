"""Joints between covers of discs, whose functions at a joint are fewer than at other edges."""

import pytest

from nmm.scene import parse_scene
from nmm.stepping.run import run

WEDGE = """
plane = "strain"
[materials.m]
young_modulus = 5e8
poisson_ratio = 0.3
density = 2000.0
[[blocks]]
name = "b0"
material = "m"
vertices = [[0.7544, 0.2924], [0.2757, 0.7368], [0.7544, 0.7368]]
[[blocks]]
name = "b1"
material = "m"
vertices = [[0.2757, 0.7368], [0.7544, 0.2924], [0.7544, 0], [0, 0], [0, 0.7368]]
[[supports]]
name = "held"
segment = [[0, 0], [0.7544, 0]]
fix = ["x", "y"]
[[loads]]
name = "l"
kind = "body"
block = "b0"
density = [4e4, -5e5]
[contact]
[interfaces.i]
friction_angle = 0.6
bonded = true
cohesion = 1e9
tensile_strength = 1e9
[formulation.cover]
type = "mls"
size = 0.436
degree = 1
[formulation.rotation]
update = "finite"
[formulation.loading]
increment = 1.0
"""


def test_the_foot_carries_the_load_of_a_wedge_that_is_bonded_to_it():
    history = run(parse_scene(WEDGE)).history
    area = 0.5 * (0.7544 - 0.2757) * (0.7368 - 0.2924)
    for axis, density in (("x", 4e4), ("y", -5e5)):
        # Corrections stop at 1e-6 of the load.
        assert history[f"reaction:held:{axis}"][-1] == pytest.approx(-density * area, rel=1e-4)
