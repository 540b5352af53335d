"""A joint of meshes that supports press and shear, after a load has bent it."""

import pytest

import nmm

PRESSED = """
plane = "stress"
[contact]
[materials.m]
young_modulus = 1e10
poisson_ratio = 0.2
[interfaces.joint]
law = "linear_softening"
bonded = true
friction_angle = 0.5
cohesion = 1e6
tensile_strength = 5e5
fracture_energy = 100.0
shear_fracture_energy = 500.0
[[blocks]]
name = "low"
material = "m"
vertices = [[0, 0], [1, 0], [1, 0.5], [0, 0.5]]
[[blocks]]
name = "up"
material = "m"
vertices = [[0, 0.5], [1, 0.5], [1, 1], [0, 1]]
[[supports]]
name = "base"
segment = [[0, 0], [1, 0]]
fix = ["x", "y"]
[[loads]]
name = "bend"
kind = "edge"
segment = [[0, 1], [1, 1]]
field = ["0", "6e5*(1-2*x)"]
[[supports]]
name = "top"
segment = [[0, 1], [1, 1]]
fix = ["x", "y"]
displacement = [1e-3, -5e-5]
history = [[0, 0], [1, 0], [2, 1]]
[[stages]]
name = "bend"
supports = ["base"]
loads = ["bend"]
[[stages]]
name = "press"
supports = ["base", "top"]
loads = []
[formulation.cover]
type = "triangles"
size = 0.5
degree = 1
[formulation.loading]
increment = 0.05
"""


@pytest.mark.slow  # 9 and 20 s
@pytest.mark.parametrize("size", [0.5, 0.25])
def test_a_joint_of_meshes_is_pressed_and_sheared_by_supports_through_its_peak(size: float) -> None:
    """Springs of 1e4 penalties beside soft ones kept friction from its balance: `failed`."""
    run = nmm.run(nmm.parse_scene(PRESSED.replace("size = 0.5", f"size = {size}")))
    assert run.summary.status == "converged"
    # Held by springs in place of terms the joint carries 1.060 MN.
    assert abs(run.history["reaction:base:x"]).max() == pytest.approx(1.060e6, rel=2e-2)
