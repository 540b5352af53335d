"""Damping of matter against closed forms: Rayleigh, Cundall; and its books."""

import math
import subprocess
import sys

import numpy as np
import pytest

import nmm
from nmm.scene.tables.shaking.damping import rayleigh
from nmm.testing import check_effect_of

# One bilinear cell that can only shear: its top moves as a mass on a spring, w^2 = 3 G / (rho h^2).
SHEAR, DENSITY = 3e6, 1000.0
OMEGA = math.sqrt(3 * SHEAR / DENSITY)
PERIOD = 2 * math.pi / OMEGA
CELL = """
title = "one cell in shear"
plane = "strain"
duration = {duration}
[materials.soil]
young_modulus = {young}
poisson_ratio = 0.25
density = {density}
[[blocks]]
name = "cell"
material = "soil"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[supports]]
name = "base"
segment = [[0, 0], [1, 0]]
fix = ["x"]
[[supports]]
name = "level"
block = "cell"
fix = ["y"]
[[loads]]
name = "shear"
kind = "edge"
segment = [[0, 1], [1, 1]]
traction = [1e3, 0]
[[monitors]]
name = "top"
point = [0.5, 1]
[inertia]
{damping}
[formulation.cover]
type = "quads"
size = 1.0
degree = 0
[formulation.integrator]
type = "{rule}"
step = {step}
[formulation.rotation]
update = "small"
[formulation.supports]
method = "lagrange"
"""


def cell(damping, periods, steps_a_period=200, rule="newmark"):
    return CELL.format(
        damping=damping,
        duration=periods * PERIOD,
        step=PERIOD / steps_a_period,
        young=2.5 * SHEAR,
        density=DENSITY,
        rule=rule,
    )


def swing(damping, periods, **more):
    """Displacement of the top over the static one, less one, at each step; with the run."""
    found = nmm.run(nmm.parse_scene(cell(damping, periods, **more)))
    assert found.summary.status == "converged"
    static = 1e3 / SHEAR
    return found.history["monitor:top:ux"] / static - 1, found


def extremes(values):
    """Amplitudes where the motion turns."""
    turning = (values[1:-1] - values[:-2]) * (values[2:] - values[1:-1]) < 0
    return np.abs(values[1:-1][turning])


def balance(run):
    """What is missing of the work, over the work that was done."""
    h = run.history
    lost = sum(column for name, column in h.items() if name.startswith("damping_loss"))
    stored = h["kinetic_energy"] + h["strain_energy"] + h["support_energy"]
    missing = h["external_work"] - stored - lost - h["integration_loss"]
    return np.abs(missing).max() / np.abs(h["external_work"]).max()


def test_rayleigh_through_two_ratios_has_the_closed_coefficients():
    mass, stiffness = rayleigh((0.05, 0.05), (2.0, 10.0))
    assert mass == pytest.approx(1.0471975512, rel=1e-10)
    assert stiffness == pytest.approx(1.326291192e-3, rel=1e-9)
    omega = 2 * math.pi * 4.472136  # where the ratio is least
    assert mass / (2 * omega) + stiffness * omega / 2 == pytest.approx(0.03726780, rel=1e-6)


@pytest.mark.parametrize(
    ("damping", "rule"),
    [
        (f"[damping]\nmass = {2 * 0.05 * OMEGA}", "generalized_alpha"),
        (f"[damping]\nstiffness = {2 * 0.05 / OMEGA}", "generalized_alpha"),
        (
            f"[damping]\nratios = [0.05, 0.02]\nfrequencies = [{1 / PERIOD}, {3 / PERIOD}]",
            "newmark",
        ),
    ],
)
def test_free_vibration_at_five_per_cent_falls_by_the_closed_ratio_a_cycle(damping, rule):
    values, run = swing(damping, 3.2, steps_a_period=100, rule=rule)
    peaks = extremes(values)
    # 0.7301153802 a cycle; extremes between steps are missed by (pi / 100)^2 / 2 at most.
    assert peaks[2] / peaks[0] == pytest.approx(0.7301153802, rel=2e-3)
    assert balance(run) < 1e-10


@pytest.mark.parametrize(
    ("share", "ratio", "half"),
    [(0.1, 0.9045340337, 3.1534602439), (0.7, 0.4200840252, 4.0726143920)],
)
def test_local_damping_of_one_mass_has_the_closed_ratio_and_period(share, ratio, half):
    values, run = swing(f"[damping]\nlocal = {share}", 1.6 * half / math.pi, steps_a_period=250)
    peaks = extremes(values)
    # The sign is that of the start of a step: an error of order one in the step.
    assert peaks[1] / peaks[0] == pytest.approx(ratio, rel=1e-2)
    turns = np.flatnonzero(np.diff(np.sign(np.diff(values))))
    between = (run.history["time"][turns[1] + 1] - run.history["time"][turns[0] + 1]) * OMEGA
    assert between == pytest.approx(half, abs=2.1 * 2 * math.pi / 250)  # two steps
    assert balance(run) < 1e-10
    lost = run.history["damping_loss:local damping"]
    assert np.diff(lost).min() > -5e-3 * lost[-1]  # but for steps in which a sign changes


FALL = """
title = "fall"
plane = "strain"
duration = "1 s"
[materials.rock]
young_modulus = "1 GPa"
poisson_ratio = 0.2
density = 2000
[[blocks]]
name = "stone"
material = "rock"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[monitors]]
name = "stone"
point = [0.5, 0.5]
[gravity]
[inertia]
[damping]
local = 0.7
[formulation.integrator]
type = "newmark"
step = 0.001
"""


def test_a_block_in_free_fall_gains_speed_by_three_tenths_of_its_weight_as_documented():
    run = nmm.run(nmm.parse_scene(FALL))
    # The first step knows no acceleration yet and falls freely: 7 g dt t in 3 g t^2 / 2.
    expected = -0.3 * 9.81 / 2
    assert run.history["monitor:stone:uy"][-1] == pytest.approx(expected, rel=6e-3)


HEAVY = '[[masses]]\nname = "load"\npoint = [0.5, 0.8]\nblock = "stone"\nmass = 2e5\n'


def test_masses_at_points_fall_under_local_damping_as_their_block_does():
    """A hundred times as heavy as its block, a load fell by all of its weight."""
    run = nmm.run(nmm.parse_scene(FALL + HEAVY))
    assert run.history["monitor:stone:uy"][-1] == pytest.approx(-0.3 * 9.81 / 2, rel=6e-3)


@pytest.mark.parametrize("load", ["", HEAVY])
def test_ground_that_moves_drags_masses_at_points_along(load):
    """``u = v (t - (1 - e^(-a t)) / a)``, and the work is that of force on mass and its losses."""
    ridden = (
        '[records.steady]\nsamples = [[0, 2.0], [10, 2.0]]\nquantity = "velocity"\n'
        '[[blocks]]\nname = "base"\nmaterial = "rock"\n'
        "vertices = [[5, 0], [6, 0], [6, 1], [5, 1]]\n"
        '[[supports]]\nname = "rock"\nblock = "base"\nfix = ["x", "y"]\n'
        'motion = { x = "steady" }\n'
    )
    text = FALL.replace("local = 0.7", 'mass = 5.0\nground = "rock"').replace("[gravity]\n", "")
    run = nmm.run(nmm.parse_scene(text + ridden + load))
    expected = 2.0 * (1 - (1 - np.exp(-5.0)) / 5.0)
    assert run.history["monitor:stone:ux"][-1] == pytest.approx(expected, rel=2e-3)
    assert run.summary.status == "converged"


@pytest.fixture(scope="module")
def plain():
    """The swing without damping."""
    return swing("", 0.5)[0]


@pytest.mark.parametrize("damping", ["mass = 0", "stiffness = 0", "local = 0"])
def test_damping_of_nothing_changes_nothing(damping, plain):
    damped, _ = swing(f"[damping]\n{damping}", 0.5)
    assert np.abs(damped - plain).max() < 1e-12


def test_shi_books_what_dampers_took_apart_from_its_own_damping():
    _, run = swing(f"[damping]\nstiffness = {0.1 / OMEGA}\nlocal = 0.2", 2.2, rule="shi")
    assert balance(run) < 1e-10


@pytest.mark.parametrize("cover", ["block", "triangles"])
def test_dampers_are_symmetric_and_take_energy(cover):
    text = cell("[damping]\nmass = 1.0\nstiffness = 0.01\nlocal = 0.5", 1)
    text = text.replace(
        '"quads"\nsize = 1.0\ndegree = 0',
        '"block"' if cover == "block" else '"triangles"\nsize = 0.5',
    )
    text = text.replace('method = "lagrange"', "") if cover == "block" else text
    check_effect_of(nmm.parse_scene(text), "viscous damping")
    check_effect_of(nmm.parse_scene(text), "local damping")


UNNAMED = [
    "nmm.effects.damping.",
    "nmm.effects.loading.fields",
    "nmm.effects.loading.field_loads",
    "nmm.effects.loading.moving_loads",
    "nmm.effects.loading.pressures",
    "nmm.effects.loading.surface_pressure",
    "nmm.effects.motion.record",
    "nmm.effects.motion.viscous_boundaries",
    "nmm.effects.motion.free_fields",
]


def test_what_no_scene_names_is_not_imported():
    code = (
        "import sys, nmm; nmm.run(nmm.parse_scene(sys.stdin.read()));"
        f"print([m for m in sys.modules if m.startswith(tuple({UNNAMED}))])"
    )
    asked = [sys.executable, "-c", code]
    told = subprocess.run(asked, input=cell("", 0.02), capture_output=True, text=True, check=True)
    assert told.stdout.strip() == "[]"
