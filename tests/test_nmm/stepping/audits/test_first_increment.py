"""Friction that slides as initial stress begins to act is told."""

import pytest

import nmm

SCENE = """plane = "strain"
[materials.m]
young_modulus = 1e9
poisson_ratio = 0.2
density = 2000
[[blocks]]
name = "a"
material = "m"
vertices = [[0, 0], [2, 0], [2, 1.6], [0, 0.4]]
[[blocks]]
name = "b"
material = "m"
vertices = [[0, 0.4], [2, 1.6], [2, 2], [0, 2]]
[[supports]]
name = "held"
block = "a"
segment = [[0, 0], [2, 0]]
fix = ["x", "y"]
[[supports]]
name = "top"
block = "b"
segment = [[0, 2], [2, 2]]
fix = ["x"]
[contact]
[interfaces.i]
friction_angle = %s
[[initial_stresses]]
block = "all"
stress = [-1e5, -1e6, 0]
[[loads]]
name = "push"
kind = "edge"
block = "b"
segment = [[0, 2], [2, 2]]
traction = [0, -1e6]
"""


@pytest.mark.parametrize(("friction", "told"), [(0.3, True), (0.8, False)])
def test_friction_that_slides_as_initial_stress_begins_to_act_is_told(friction, told):
    # Across the joint, which dips at 31 degrees, the stress leans by up to arctan 0.52 = 0.48 rad.
    found = nmm.run(nmm.parse_scene(SCENE % friction)).summary
    assert found.status == "converged"
    warned = [line for line in found.warnings if "audit first_increment" in line]
    assert bool(warned) is told
