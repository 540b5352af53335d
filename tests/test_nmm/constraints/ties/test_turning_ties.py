"""Ties between bodies that turn: pins and glue carry what the motion asks for, and no more."""

from math import pi

import numpy as np
import pytest
from scipy.special import ellipk

import nmm
from nmm.scene.read import parse_scene
from nmm.stepping.prepare import prepare
from nmm.verification import text

LENGTH, DEPTH, DENSITY = 1.0, 0.05, 7800.0
MASS = DENSITY * LENGTH * DEPTH
ABOUT_PIN = MASS * ((LENGTH**2 + DEPTH**2) / 12 + LENGTH**2 / 4)

PENDULUM = f"""
plane = "stress"
duration = 0.75
[materials.steel]
density = {DENSITY}
young_modulus = "200 GPa"
poisson_ratio = 0.3
[[blocks]]
name = "bar"
material = "steel"
vertices = [[0, -0.025], [1, -0.025], [1, 0.025], [0, 0.025]]
[[supports]]
name = "pin"
point = [0, 0]
fix = ["x", "y"]
[gravity]
[inertia]
[[monitors]]
name = "end"
point = [1, 0]
"""
PAIR = """
plane = "stress"
duration = 0.3
[materials.rock]
density = 2000
young_modulus = "10 GPa"
poisson_ratio = 0.2
[interfaces.seam]
friction_angle = 0.5
cohesion = "1 GPa"
tensile_strength = "1 GPa"
bonded = true
STIFFNESS
[[blocks]]
name = "left"
material = "rock"
vertices = [[0, 0], [1, 0], [1, 0.5], [0, 0.5]]
[[blocks]]
name = "right"
material = "rock"
vertices = [[1, 0], [2, 0], [2, 0.5], [1, 0.5]]
[[initial_velocities]]
block = "left"
angular_velocity = 5.0
velocity = [0, -2.5]
[[initial_velocities]]
block = "right"
angular_velocity = 5.0
velocity = [0, 2.5]
[inertia]
"""
CORNERED = "[[0, -1], [2, -1], [2, 0], [0, 0]]"
STIFF = 'normal_stiffness = "100 GPa/m"\nshear_stiffness = "100 GPa/m"'


def ran(text, **tables):
    formulation = nmm.Formulation.model_validate(tables)
    return nmm.run(parse_scene(text), formulation)


def test_a_bar_on_a_pin_swings_as_the_pendulum_of_the_elliptic_integral():
    run = ran(PENDULUM, integrator={"step": 1e-3})
    assert run.summary.status == "converged"
    history = run.history
    angle = np.arctan2(history["monitor:end:uy"], LENGTH + history["monitor:end:ux"])
    down = np.interp(pi / 2, -angle[: angle.argmin()], history["time"][: angle.argmin()])
    own = np.sqrt(MASS * 9.81 * LENGTH / 2 / ABOUT_PIN)
    # Let go level: a quarter of the period; a step is off by its square, and shi's rule damps.
    assert down == pytest.approx(ellipk(0.5) / own, rel=1e-3)
    # Below the pin it carries the weight and what turns the middle about it.
    rate = np.sqrt(MASS * 9.81 * LENGTH / ABOUT_PIN)
    lowest = MASS * (9.81 + rate**2 * LENGTH / 2)
    at = np.argmin(np.abs(history["time"] - down))
    # Within half a step of the lowest place, and a bar that shakes by its own stretch.
    assert history["reaction:pin:y"][at] == pytest.approx(lowest, rel=5e-3)


def test_a_rigid_block_on_a_pin_is_held_by_what_keeps_it_on_its_circle():
    """At the bottom of its way by its weight and ``m omega^2 d``; it turns by up to 13 mrad a step.

    Released with its centroid 0.618 m above there. Rigid bodies once had no force to compare what
    a pin misses with: it pulled 1e4 times as hard.
    """
    block = PENDULUM.replace("[[0, -0.025], [1, -0.025], [1, 0.025], [0, 0.025]]", CORNERED)
    block = block.replace("0.75", "1.0").replace("point = [1, 0]", "point = [2, 0]")
    run = ran(block, integrator={"step": 5e-3}, cover={"type": "block", "functions": "rigid"})
    assert run.summary.status == "converged"
    mass, arm = 2 * DENSITY, np.hypot(1.0, 0.5)
    spin = 2 * 9.80665 * (arm - 0.5) / ((2**2 + 1**2) / 12 + arm**2)
    pull = mass * (9.80665 + spin * arm)
    # Of 3.3e-4 and 3.6e-4 in steps of 5 and 2 ms, by what the pin gives way and swings.
    assert run.history["reaction:pin:y"].max() == pytest.approx(pull, rel=1e-3)


@pytest.mark.parametrize("stiffness", ["", STIFF], ids=["glue", "joint"])
@pytest.mark.parametrize("cover", [{}, {"type": "triangles", "size": 0.5}], ids=["dda", "mesh"])
def test_two_tied_blocks_spin_on_with_their_energy_and_angular_momentum(stiffness, cover):
    pair = PAIR.replace("STIFFNESS", stiffness).replace("duration = 0.3", "duration = 0.1")
    run = ran(pair, cover=cover, integrator={"step": 1e-3})
    assert run.summary.status == "converged"
    energy = sum(run.history[f"{kind}_energy"] for kind in ("kinetic", "strain", "support"))
    # Masses of 1000 kg at 0.5 m from the middle and of 104.17 kg m2 each, at 5 rad/s. The rule
    # damps the stretch that the spin begins with.
    assert energy == pytest.approx(2 * (1000 * 0.25 + 1250 / 12) * 12.5, rel=1e-5)


def test_a_held_body_stays_on_one_solution_a_step():
    clamped = PENDULUM.replace("point = [0, 0]", "segment = [[0, -0.025], [0, 0.025]]")
    run = ran(clamped.replace("0.75", "0.01"), integrator={"step": 1e-3})
    assert run.history["passes"].max() == 1


def test_supports_of_bodies_at_rest_are_lines():
    """Steps of supported scenes without anything that bends are linear: they are solved at once."""
    held = text.fixed_block("block")
    tables = [text.material("rock", 1e9, 0.2), text.box("block", (0, 0), (1, 1)), held]
    scene = parse_scene(text.scene('plane = "stress"\n', tables))
    assert not prepare(scene, nmm.Formulation()).stepper.plan.bent
