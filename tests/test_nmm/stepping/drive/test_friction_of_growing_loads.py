"""Work of friction under loads that grow in statics: exact however many increments they take."""

import pytest

import nmm

MU, WEIGHT, PUSH, SPRING = 0.5, 8e3, 7e3, 1e6
SLIDE = f"""
plane = "stress"
[materials.m]
young_modulus = "50 GPa"
poisson_ratio = 0.0
[interfaces.i]
friction_angle = {0.4636476090008061}
[[blocks]]
name = "floor"
material = "m"
vertices = [[-2, -1], [3, -1], [3, 0], [-2, 0]]
[[blocks]]
name = "b"
material = "m"
vertices = [[0, 0], [1, 0], [1, 0.5], [0, 0.5]]
[contact]
[[supports]]
name = "ground"
block = "floor"
fix = ["x", "y"]
[[loads]]
name = "down"
kind = "body"
block = "b"
density = [0, {-WEIGHT / 0.5}]
[[loads]]
name = "along"
kind = "body"
block = "b"
density = [{PUSH / 0.5}, 0]
[[springs]]
name = "k"
points = [[1, 0.25], [2.5, 0.25]]
blocks = ["b", "ground"]
stiffness = {SPRING}
[formulation.contact]
enforcement = "ENFORCED"
[formulation.loading]
increment = STEP
"""


@pytest.mark.parametrize("step", [1.0, 0.25])
@pytest.mark.parametrize("enforced", ["penalty", "augmented", "lagrange"])
def test_a_block_that_slides_from_the_first_load_on_rubs_half_its_last_force_by_its_way(
    step: float, enforced: str
) -> None:
    text = SLIDE.replace("STEP", str(step)).replace("ENFORCED", enforced)
    run = nmm.run(nmm.parse_scene(text))
    way = (PUSH - MU * WEIGHT) / SPRING
    # Pressure, force and way grow together. Springs of contact stretch by 1e-3 of the way first.
    loss = run.history["friction_loss"][-1]
    assert loss == pytest.approx(MU * WEIGHT * way / 2, rel=2e-3)
    assert abs(run.summary.energy_balance) < 1e-5
