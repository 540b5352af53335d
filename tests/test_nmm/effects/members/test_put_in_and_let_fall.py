"""Members in scenes with closed forms: an anchor that is locked off, a weight on a dashpot."""

import numpy as np
import pytest

import nmm
from nmm.formulation import Formulation
from nmm.scene.read import parse_scene

HEAD = """
title = "block"
plane = "stress"
{duration}
[materials.rock]
young_modulus = 1e12
poisson_ratio = 0.0
density = 1000
[[blocks]]
name = "block"
material = "rock"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[monitors]]
name = "middle"
point = [0.5, 0.5]
"""
ANCHORED = """
[[foundations]]
name = "bed"
segment = [[0, 0], [1, 0]]
normal_stiffness = {bed}
shear_stiffness = 1e7
[[springs]]
name = "anchor"
points = [[0.5, 1], [0.5, -4]]
blocks = ["block", "ground"]
stiffness = {anchor}
force = 3e5
[[stages]]
name = "alone"
members = ["bed"]
[[stages]]
name = "anchored"
members = ["bed", "anchor"]
"""
FALLING = """
[inertia]
[gravity]
[[dashpots]]
name = "damper"
points = [[0.5, 0.5], [0.5, -4]]
blocks = ["block", "ground"]
viscosity = {viscosity}
[[supports]]
name = "guide"
segment = [[0, 0], [0, 1]]
fix = ["x"]
"""


def run(text, **table):
    return nmm.run(parse_scene(text, "scene"), Formulation.model_validate(table))


@pytest.mark.parametrize(("bed", "anchor"), [(2e7, 5e6), (5e6, 2e7)])
def test_an_anchor_loses_as_much_of_its_force_as_the_bed_gives_way(bed, anchor):
    found = run(HEAD.format(duration="") + ANCHORED.format(bed=bed, anchor=anchor))
    locked, settled = 3e5 * bed / (bed + anchor), 3e5 / (bed + anchor)
    # The block itself gives way by 3e5 / 1e12 of a metre.
    assert found.history["springs:anchor:force"][-1] == pytest.approx(locked, rel=1e-4)
    assert found.history["monitor:middle:uy"][-1] == pytest.approx(-settled, rel=1e-4)


@pytest.mark.parametrize("viscosity", [1000.0, 4000.0])
def test_a_weight_on_a_dashpot_nears_its_last_speed_to_the_order_of_the_steps(viscosity):
    rate, end = viscosity / 1000, 1.0
    exact = -9.81 / rate * (end - (1 - np.exp(-rate * end)) / rate)
    text = HEAD.format(duration='duration = "1 s"') + FALLING.format(viscosity=viscosity)
    errors = []
    for step in (0.02, 0.01):
        found = run(text, integrator={"type": "newmark", "step": step})
        errors.append(abs(found.history["monitor:middle:uy"][-1] / exact - 1))
        assert abs(found.summary.energy_balance) < 1e-10
    assert errors[1] < 1e-4
    assert np.log2(errors[0] / errors[1]) == pytest.approx(2.0, abs=0.1)
