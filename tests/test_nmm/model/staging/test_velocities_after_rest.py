"""Blocks that came to rest set out with the velocities of the scene, once, as time first passes."""

import pytest

import nmm

SPEED, SPIN, MASS = 1.0, 2.0, 2000.0
SCENE = """
plane = "strain"
[materials.m]
young_modulus = 1e9
poisson_ratio = 0.0
density = 2000
[[blocks]]
name = "body"
material = "m"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[blocks]]
name = "other"
material = "m"
vertices = [[5, 0], [6, 0], [6, 1], [5, 1]]
[inertia]
[[supports]]
name = "held"
block = "all"
fix = ["x", "y"]
[[monitors]]
name = "middle"
point = [0.5, 0.5]
[[initial_velocities]]
block = "body"
velocity = [1.0, 0.0]
angular_velocity = 2.0
[formulation.integrator]
type = "newmark"
[formulation.supports]
method = "penalty"
[[stages]]
name = "rest"
"""
MOVES = '[[stages]]\nname = "{}"\nduration = "20 ms"\nsupports = []\n'
STOPS = '[[stages]]\nname = "stop"\nsupports = ["held"]\n'


@pytest.mark.parametrize("cover", ["", '[formulation.cover]\ntype = "quads"\nsize = 0.5\n'])
def test_a_block_at_rest_sets_out_with_its_velocity(cover):
    # It stayed where it was: velocities were those of the start, where the clock does not run.
    found = nmm.run(nmm.parse_scene(SCENE + MOVES.format("one") + MOVES.format("two") + cover))
    energy = MASS * SPEED**2 / 2 + MASS / 6 * SPIN**2 / 2
    # It is drawn out by rho omega^2 a^2 / (12 E), 1e-8 of its size.
    assert found.history["kinetic_energy"][-1] == pytest.approx(energy, rel=1e-6)
    assert found.history["monitor:middle:ux"][-1] == pytest.approx(SPEED * 0.04, rel=1e-6)
    assert found.history["monitor:middle:uy"][-1] == pytest.approx(0.0, abs=1e-9)


def test_a_block_that_was_stopped_does_not_set_out_again():
    # Where nothing held it before, supports put it back where it was drawn: by 5.6 GJ.
    stages = MOVES.format("one") + STOPS + MOVES.format("two")
    found = nmm.run(nmm.parse_scene(SCENE + stages))
    # What it was drawn out by as it spun is held, and let go of.
    assert found.history["kinetic_energy"][-1] == pytest.approx(0.0, abs=1e-3)
    assert found.history["monitor:middle:ux"][-1] == pytest.approx(SPEED * 0.02, rel=1e-6)
    assert found.history["support_energy"][-1] == pytest.approx(0.0, abs=1e-3)
