"""The stiffness that an interface names holds for contacts that are found later too."""

import numpy as np
import pytest

import nmm

SPRING, MASS, SPEED = 5e4, 1000.0, 0.01

IMPACT = f"""
plane = "strain"
duration = 0.3
[inertia]
[contact]
[materials.rock]
young_modulus = 1e10
poisson_ratio = 0.0
density = {MASS}
[interfaces.any]
friction_angle = "0 deg"
normal_stiffness = {SPRING}
[[blocks]]
name = "left"
material = "rock"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[blocks]]
name = "right"
material = "rock"
vertices = [[1.0001, 0], [2.0001, 0], [2.0001, 1], [1.0001, 1]]
[[initial_velocities]]
block = "left"
velocity = [{SPEED}, 0]
"""

RIGID = {"functions": "rigid"}
QUADS = {"type": "quads", "size": 0.5}
WAYS = [
    (RIGID, {}),
    (RIGID, {"points": "faces"}),
    ({}, {}),
    (QUADS, {}),
    (QUADS, {"enforcement": "cone"}),
    *[(RIGID, {"enforcement": name}) for name in ("cone", "lagrange", "augmented", "barrier")],
]


@pytest.mark.parametrize(("cover", "contact"), WAYS)
def test_blocks_that_start_apart_press_each_other_as_far_as_the_interface_says(cover, contact):
    table = {
        "cover": cover,
        "contact": contact,
        "integrator": {"type": "newmark", "step": 2e-3},
    }
    found = nmm.run(nmm.parse_scene(IMPACT), nmm.Formulation.model_validate(table))
    # Two masses on one spring of k x 1 m x 1 m.
    right = SPEED * np.sqrt(MASS / 2 / SPRING)
    # Newmark's period, 0.1 % long with 157 steps in one, and the top between two steps.
    assert found.summary.largest_penetration == pytest.approx(right, rel=1e-3)
    assert abs(found.summary.energy_balance) < 1e-4


@pytest.mark.parametrize(("cover", "contact"), [(RIGID, {}), ({}, {"enforcement": "cone"})])
@pytest.mark.parametrize("width", [0.5, 1.0])
def test_a_block_put_down_gives_to_weight_and_push_as_the_interface_says(cover, contact, width):
    scene = f"""
plane = "strain"
duration = 0.6
[inertia]
[contact]
[gravity]
acceleration = [0.0, -9.0]
[[loads]]
name = "push"
kind = "body"
block = "b"
density = [2000.0, 0]
history = [[0.2, 0], [0.3, 1]]
[materials.rock]
young_modulus = 1e10
poisson_ratio = 0.0
density = 1000.0
[interfaces.any]
friction_angle = "40 deg"
normal_stiffness = 5e7
shear_stiffness = 2e7
[[blocks]]
name = "floor"
material = "rock"
vertices = [[-2, -1], [3, -1], [3, 0], [-2, 0]]
[[blocks]]
name = "b"
material = "rock"
vertices = [[0, 1e-3], [{width}, 1e-3], [{width}, 0.101], [0, 0.101]]
[[supports]]
name = "held"
block = "floor"
fix = ["x", "y"]
[[monitors]]
name = "m"
point = [{width / 2}, 0.051]
block = "b"
"""
    table = {
        "cover": cover,
        "contact": contact,
        "integrator": {"type": "shi", "step": 4e-3, "kinetic_factor": 0.8},
    }
    found = nmm.run(nmm.parse_scene(scene), nmm.Formulation.model_validate(table))
    down = found.history["monitor:m:uy"][-1] + 1e-3
    along = found.history["monitor:m:ux"][-1]
    # 100 kg on each m2 of foot. The push turns the block about its foot as well,
    # which moves its middle by half the height times the turn.
    assert down == pytest.approx(-100 * 9.0 / 5e7, rel=1e-3)
    turn = found.state.frames.angle[1]
    assert along + turn * 0.05 == pytest.approx(100 * 2.0 / 2e7, rel=0.02)
