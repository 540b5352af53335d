"""A block that nothing holds ends a run in words, however small the load that moves it is."""

import pytest

import nmm
from nmm.scene.read import parse_scene


@pytest.mark.parametrize("pressure", [1e-3, 4e4, 4e5])
@pytest.mark.parametrize("unit", [1.0, 1e3])
def test_a_pressed_block_that_nothing_holds_is_no_equilibrium(pressure, unit):
    """Without [contact] an interface with friction alone holds nothing."""

    def places(*points):
        return [[unit * x, unit * y] for x, y in points]

    run = nmm.run(
        parse_scene(f"""
plane = "stress"

[materials.rock]
density = 2000
young_modulus = 2.2e9
poisson_ratio = 0.3

[interfaces.joint]
friction_angle = 0.3

[[blocks]]
name = "low"
material = "rock"
vertices = {places((0, 2.124), (4.039, 3.917), (4.039, 0), (0, 0))}

[[blocks]]
name = "high"
material = "rock"
vertices = {places((4.039, 3.917), (0, 2.124), (0, 4.602), (4.039, 4.602))}

[[supports]]
name = "held"
segment = {places((0, 0), (4.039, 0))}
fix = ["x", "y"]

[[loads]]
name = "side"
kind = "pressure"
segment = {places((4.039, 0), (4.039, 4.602))}
pressure = {pressure}

[[initial_stresses]]
block = "all"
stress = [{pressure / 10}, {-2 * pressure}, {pressure / 4}]
""")
    )
    assert run.summary.status not in ("converged", "unbalanced"), run.summary.sentence
    assert "no equilibrium" in run.summary.sentence
