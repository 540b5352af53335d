"""Central differences: frequency, order, the stable step, and what is refused."""

import math

import numpy as np
import pytest
from scipy.linalg import eigh

import nmm
from nmm.errors import FormulationError
from nmm.integrators.central_differences import CentralDifferences
from nmm.stepping.drive.stable_step import longest_step
from nmm.stepping.prepare import prepare
from nmm.testing.integrators import Oscillator

BAR = """
title = "bar"
plane = "stress"
duration = {duration}
[materials.soft]
young_modulus = 1.0
poisson_ratio = 0.0
density = 1.0
[[blocks]]
name = "bar"
material = "soft"
vertices = [[0, 0], [4, 0], [4, 0.5], [0, 0.5]]
[[supports]]
name = "left"
segment = [[0, 0], [0, 0.5]]
fix = ["x", "y"]
[[loads]]
name = "pull"
kind = "edge"
segment = [[4, 0], [4, 0.5]]
traction = [1e-3, 0]
[[monitors]]
name = "end"
point = [4, 0.25]
[inertia]
{more}
[formulation.cover]
type = "quads"
size = 0.5
degree = {degree}
[formulation.integrator]
type = "central_differences"
step = {step}
mass = "{mass}"
[formulation.rotation]
update = "small"
[formulation.supports]
method = "lagrange"
"""


def bar(step, duration=8.0, mass="lumped", degree=0, more=""):
    return BAR.format(step=step, duration=duration, mass=mass, degree=degree, more=more)


@pytest.mark.parametrize("omega", [0.1, 1.0, 1.9])
def test_a_vibration_has_the_closed_frequency(omega):
    one = Oscillator(CentralDifferences(), omega**2)
    state = np.array([1.0, 0.0, 0.0])
    begun = Oscillator(CentralDifferences().beginning, omega**2)
    places, state = [1.0], begun.after(state, 1.0)
    for _ in range(60):
        places.append(state[0])
        state = one.after(state, 1.0)
    # cos(n W) with W = 2 asin(w dt / 2), 1.0471975512 at one.
    expected = np.cos(2 * math.asin(omega / 2) * np.arange(len(places)))
    assert np.array(places) == pytest.approx(expected, abs=1e-9)


def test_beyond_two_a_vibration_grows_and_up_to_two_it_does_not():
    for omega, grows in ((1.999, False), (2.001, True)):
        one, state = Oscillator(CentralDifferences(), omega**2), np.array([1.0, 0.0, 0.0])
        largest = 0.0
        for _ in range(2000):
            state = one.after(state, 1.0)
            largest = max(largest, abs(state[0]))
        assert (largest > 1e6) == grows


@pytest.mark.parametrize(("mass", "degree"), [("lumped", 0), ("lumped", 1), ("consistent", 0)])
def test_the_stable_step_is_two_over_the_highest_frequency(mass, degree):
    scene = nmm.parse_scene(bar(0.01, mass=mass, degree=degree))
    made = prepare(scene, scene.formulation)
    model = made.stepper.model
    highest = eigh(model.stiffness.toarray(), model.mass.toarray(), eigvals_only=True)[-1]
    assert longest_step(made.stepper, made.start) == pytest.approx(2 / math.sqrt(highest), rel=1e-3)


@pytest.mark.parametrize("mass", ["lumped", "consistent"])
def test_a_wave_in_a_bar_doubles_the_displacement_of_its_end(mass):
    run = nmm.run(nmm.parse_scene(bar(0.1, mass=mass)))
    assert run.summary.status == "converged", run.summary.sentence
    # u(L, 2 L / c) = 2 s L / E; eight cells along the bar.
    assert run.history["monitor:end:ux"][-1] == pytest.approx(8e-3, rel=0.06)
    h = run.history
    rest = h["external_work"] - h["kinetic_energy"] - h["strain_energy"] - h["integration_loss"]
    assert np.abs(rest).max() < 1e-9 * h["external_work"].max()


def test_a_step_that_is_too_long_ends_the_run_with_the_stable_one():
    run = nmm.run(nmm.parse_scene(bar(1.0)))
    assert run.summary.status == "failed"
    assert "steps of 1 s grow without bound: expected at most 0." in run.summary.sentence


def test_functions_that_depend_on_one_another_need_a_lumped_mass():
    run = nmm.run(nmm.parse_scene(bar(0.01, mass="consistent", degree=1)))
    assert run.summary.status == "failed"
    assert 'use [integrator] mass = "lumped"' in run.summary.sentence


def test_damping_by_stiffness_shortens_the_stable_step():
    steps = []
    for more in ("", "[damping]\nstiffness = 0.2"):
        scene = nmm.parse_scene(bar(0.01, more=more))
        made = prepare(scene, scene.formulation)
        steps.append(longest_step(made.stepper, made.start))
    omega = 2 / steps[0]
    ratio = 0.2 * omega / 2
    assert steps[1] == pytest.approx(steps[0] * (math.sqrt(1 + ratio**2) - ratio), rel=1e-3)


RIGID = """
plane = "strain"
duration = {duration}
[materials.m]
density = 2000.0
young_modulus = 1e8
poisson_ratio = 0.2
[[blocks]]
name = "b"
material = "m"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[inertia]
[[initial_velocities]]
block = "b"
velocity = [0.0, 1.0]
[formulation.cover]
functions = "rigid"
[formulation.integrator]
type = "central_differences"
step = 1e-4
"""


@pytest.mark.parametrize(
    "damper",
    [
        "[damping]\nmass = 1000.0",
        '[[viscous_boundaries]]\nname = "below"\nsegment = [[0, 0], [1, 0]]\n'
        "density = 2000.0\np_velocity = 1000.0\ns_velocity = 1e-3",
    ],
    ids=["of mass", "below, that turning meets less than lifting does"],
)
def test_a_rigid_block_that_dampers_alone_slow_takes_steps_up_to_two_masses_over_their_rate(damper):
    # m = 2000 kg and c = 2e6 N s/m: a step leaves 1 - c dt / m of the velocity.
    scene = nmm.parse_scene(RIGID.format(duration=0.002) + damper)
    made = prepare(scene, scene.formulation)
    assert longest_step(made.stepper, made.start) == pytest.approx(2e-3, rel=1e-6)
    run = nmm.run(scene)
    assert run.summary.status == "converged", run.summary.sentence
    # exp(-2 t c / m) of 1 kJ, by steps of a tenth of the time of decay.
    left = run.history["kinetic_energy"][-1] / 1000.0
    assert math.log(left) == pytest.approx(-4.0, rel=0.1)


def test_a_rigid_block_in_free_flight_takes_any_step():
    scene = nmm.parse_scene(RIGID.format(duration=0.002))
    made = prepare(scene, scene.formulation)
    assert longest_step(made.stepper, made.start) == math.inf


def test_contact_is_refused_with_what_to_use():
    more = "[contact]\n[interfaces.dry]\nfriction_angle = 0.5"
    with pytest.raises(FormulationError, match=r'"central_differences" with \[contact\]'):
        nmm.run(nmm.parse_scene(bar(0.01, more=more)))


FREE = """
plane = "stress"
duration = {duration}
[materials.stiff]
young_modulus = 1e8
poisson_ratio = 0.0
density = 2000.0
[[blocks]]
name = "block"
material = "stiff"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[monitors]]
name = "middle"
point = [0.5, 0.5]
[inertia]
{more}
[formulation.integrator]
type = "central_differences"
step = 1e-4
mass = "lumped"
[formulation.rotation]
update = "{update}"
[formulation.cover]
type = "quads"
size = 0.5
degree = 0
"""


def middle(more, duration, update, way):
    run = nmm.run(nmm.parse_scene(FREE.format(more=more, duration=duration, update=update)))
    assert run.summary.status == "converged", run.summary.sentence
    return run.history[f"monitor:middle:{way}"][-1]


@pytest.mark.parametrize("update", ["exact", "small", "finite"])
def test_a_block_swings_on_a_spring_whose_force_is_no_line(update):
    spring = """
    [[springs]]
    name = "pulled"
    points = [[0.5, 0.5], [3.5, 0.5]]
    blocks = ["block", "ground"]
    stiffness = 2e6
    force = 1e3
    """
    # F / k (1 - cos w t), with w = (k / m)^0.5 = 31.6 /s and the block rigid to k / E = 0.02.
    expected = 5e-4 * (1 - math.cos(math.sqrt(1000.0) * 0.06))
    assert middle(spring, 0.06, update, "ux") == pytest.approx(expected, rel=0.02)


@pytest.mark.parametrize("update", ["exact", "small", "finite"])
def test_a_block_thrown_off_a_bed_that_only_pushes_falls_free_and_is_caught(update):
    bed = """
    [[foundations]]
    name = "bed"
    segment = [[0, 0], [1, 0]]
    normal_stiffness = 8e5
    carries = "compression"
    [gravity]
    acceleration = [0, -10]
    [[initial_velocities]]
    block = "block"
    velocity = [0, 0.1]
    """
    # Free for 2 v / g = 20 ms; then -v / w sin(w t) - g / w^2 (1 - cos w t) with w = 20 /s.
    assert middle(bed, 0.015, update, "uy") == pytest.approx(0.1 * 0.015 - 5 * 0.015**2, rel=0.01)
    caught = -0.1 / 20 * math.sin(1.0) - 10 / 400 * (1 - math.cos(1.0))
    assert middle(bed, 0.07, update, "uy") == pytest.approx(caught, rel=0.02)


def test_dashpots_whose_force_is_not_known_at_the_start_are_refused_with_what_to_use():
    more = """
    [[dashpots]]
    name = "damper"
    points = [[0.5, 0.5], [3.5, 0.5]]
    blocks = ["block", "ground"]
    viscosity = 1e3
    """
    text = FREE.format(more=more, duration=0.01, update="exact")
    with pytest.raises(FormulationError, match=r'"central_differences" with dashpots.*newmark'):
        nmm.run(nmm.parse_scene(text))
