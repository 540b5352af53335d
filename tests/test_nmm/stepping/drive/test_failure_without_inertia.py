"""What a step in time without inertia says where it finds no equilibrium."""

import numpy as np
import pytest

import nmm

SCENE = """plane = "strain"
duration = 1.0
[materials.m]
young_modulus = 1e9
poisson_ratio = 0.2
density = 2000
[[blocks]]
name = "wedge"
material = "m"
vertices = [[0, 0], [4, 0], [0, 4]]
[[blocks]]
name = "slider"
material = "m"
vertices = [[1.5, 2.5], [2.5, 1.5], [2.5, 2.5]]
[[supports]]
name = "ground"
block = "wedge"
segment = [[0, 0], [4, 0]]
fix = ["x", "y"]
[[loads]]
name = "push"
kind = "body"
block = "slider"
density = [2e4, -2e4]
history = [[0, 0], [1, {push}]]
[gravity]
[contact]
[interfaces.i]
friction_angle = 0.9
[formulation.integrator]
step = 0.1
"""


@pytest.mark.parametrize(("push", "status"), [(0.1, "converged"), (1.0, "failed")])
def test_a_block_that_is_pushed_down_without_inertia_is_told_what_to_do(push, status):
    # Along a face at 45 degrees push and weight are 40 kN/m3 times the factor, and 19.62 kN/m3.
    last = (np.tan(0.9) - 1) * 19.62 / 40
    run = nmm.run(nmm.parse_scene(SCENE.format(push=push)))
    found = run.summary
    assert found.status == status, found.sentence
    assert ("longer steps, or add [inertia]" in found.sentence) is (status == "failed")
    if status == "failed":  # steps are cut to 1e-4 s, in which the factor grows by as much
        assert run.history["time"][-1] == pytest.approx(last, abs=2e-4)
