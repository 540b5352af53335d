"""Increments that are cut are told where a field takes its steps with them."""

import pytest

import nmm
from nmm.scene import parse_scene

COLUMNS = """
plane = "strain"
[contact]
[heat]
transient = true
duration = 1e6
[materials.m]
young_modulus = 1e9
poisson_ratio = 0.2
density = 2000.0
conductivity = 2.0
heat_capacity = 800.0
thermal_expansion = 1e-5
[interfaces.i]
friction_angle = 0.5
conductance = "perfect"
bonded = true
cohesion = 1e8
tensile_strength = {strength}
[[blocks]]
name = "left"
material = "m"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[blocks]]
name = "right"
material = "m"
vertices = [[1, 0], [2, 0], [2, 1], [1, 1]]
[[supports]]
name = "foot"
segment = [[0, 0], [2, 0]]
fix = ["x", "y"]
[[temperatures]]
name = "warm"
segment = [[0, 0], [2, 0]]
temperature = 1.0
[[loads]]
name = "pull"
kind = "edge"
segment = [[2, 0], [2, 1]]
traction = [1e6, 0]
[formulation.cover]
type = "quads"
size = 0.5
[formulation.contact]
bonds = "spring"
[formulation.loading]
increment = 0.25
"""


@pytest.mark.parametrize(("strength", "breaks"), [(3e5, True), (1e8, False)])
def test_increments_that_a_bond_cuts_are_told_beside_a_transient_field(strength, breaks):
    found = nmm.run(parse_scene(COLUMNS.format(strength=strength)))
    assert found.summary.status == "converged"
    assert (found.history["broken"][-1] > 0) == breaks
    assert (len(found.history["time"]) > 4) == breaks  # four increments of a quarter
    told = "increments of it cut, and the steps of its fields with them" in found.summary.sentence
    assert told == breaks
