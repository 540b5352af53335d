"""Joints of Goodman and glue between blocks, under block covers and meshes."""

import numpy as np
import pytest

from nmm.formulation import parse_formulation
from nmm.scene import parse_scene
from nmm.stepping.run import Run, run

BARS = """
plane = "stress"
[materials.soft]
young_modulus = 1
poisson_ratio = 0.0
[materials.hard]
young_modulus = 1e4
poisson_ratio = 0.0
[interfaces.joint]
between = ["soft", "hard"]
friction_angle = 0
bonded = true
STIFFNESS
[[blocks]]
name = "one"
material = "soft"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[blocks]]
name = "two"
material = "hard"
vertices = [[1, 0], [2, 0], [2, 1], [1, 1]]
[[supports]]
name = "left"
segment = [[0, 0], [0, 1]]
fix = ["x", "y"]
[[loads]]
name = "pull"
kind = "edge"
segment = [[2, 0], [2, 1]]
traction = [1, 0]
[[monitors]]
name = "end"
point = [2, 0.5]
[[monitors]]
name = "near"
point = [1, 0.5]
block = "one"
"""

MESH = '[cover]\ntype = "triangles"\nsize = 0.4\ndegree = 1\nangle = 0.3\n'


def simulate(scene: str, formulation: str) -> Run:
    found = run(parse_scene(scene, "scene"), parse_formulation(formulation))
    assert found.summary.status == "converged", found.summary.sentence
    return found


@pytest.mark.parametrize("cover", [MESH, '[cover]\ntype = "block"\n'])
def test_a_sprung_joint_opens_by_stress_over_stiffness(cover: str) -> None:
    found = simulate(BARS.replace("STIFFNESS", "normal_stiffness = 4\nshear_stiffness = 2"), cover)
    history = found.history
    near, end = history["monitor:near:ux"][-1], history["monitor:end:ux"][-1]
    # Jump t / k = 1 / 4 whatever the bars; the spring of a block's support gives 1e-3.
    assert end - near == pytest.approx(0.25 + 1e-4, rel=1e-8)
    assert near == pytest.approx(1.0, rel=2e-3)


def test_glued_bars_of_a_stiffness_ratio_of_1e4_carry_one_stress() -> None:
    # As benchmark A9a; glue of 1e6 E / length leaves 1e-6 of the length of a shared edge.
    found = simulate(BARS.replace("STIFFNESS", ""), MESH)
    assert found.history["monitor:end:ux"][-1] == pytest.approx(1.0001, rel=2e-6)
    np.testing.assert_allclose(found.stress[:, 0], 1.0, atol=1e-6)
    # The hard bar moves by 1: its stiffness of 1e4 leaves 1e4 roundings in a balance of 1.
    assert found.summary.equilibrium_residual is not None
    assert found.summary.equilibrium_residual < 1e-8
