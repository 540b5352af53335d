"""Springs and dashpots between points against closed forms, and what they keep."""

import subprocess
import sys

import numpy as np
import pytest

import nmm
from nmm.scene import parse_scene
from nmm.testing import check_effect_of

FLYING = """
plane = "strain"
duration = "{duration} s"
[materials.stone]
young_modulus = "50 GPa"
poisson_ratio = 0.2
density = 1000
[[blocks]]
name = "a"
material = "stone"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[blocks]]
name = "b"
material = "stone"
vertices = [[3, 0], [5, 0], [5, 1], [3, 1]]
[[initial_velocities]]
block = "a"
velocity = {velocity}
angular_velocity = {spin}
[inertia]
{between}
[formulation.integrator]
type = "{rule}"
step = "{step} s"
"""


def flying(between, *, duration=0.1, velocity=(0.2, 0.0), spin=0.0, rule="newmark", step=1e-3):
    return FLYING.format(
        between=between,
        duration=duration,
        velocity=list(velocity),
        spin=spin,
        rule=rule,
        step=step,
    )


def spring(stiffness="1 MN/m", points="[[1, 0.5], [3, 0.5]]", more=""):
    return f'[[springs]]\nname = "s"\npoints = {points}\nstiffness = "{stiffness}"\n{more}\n'


def dashpot(viscosity="20 kN s/m", points="[[1, 0.5], [3, 0.5]]"):
    return f'[[dashpots]]\nname = "d"\npoints = {points}\nviscosity = "{viscosity}"\n'


HUNG = """
plane = "strain"
[materials.m]
young_modulus = 1e11
poisson_ratio = 0.2
density = 2000.0
[[blocks]]
name = "b"
material = "m"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[supports]]
name = "left"
segment = [[0, 0], [0, 1]]
fix = ["x"]
[[springs]]
name = "rope"
points = [[0.5, 1], [0.5, 9]]
blocks = ["b", "ground"]
stiffness = 1e7
[gravity]
[[monitors]]
name = "o"
point = [0.5, 1]
"""
MASSES = 1000.0, 2000.0
REDUCED = MASSES[0] * MASSES[1] / sum(MASSES)
OMEGA = np.sqrt(1e6 / REDUCED)
OBLIQUE = "[[1, 0.2], [3, 0.9]]"
COVER = '[formulation.cover]\ntype = "triangles"\nsize = 0.7\n'


@pytest.mark.parametrize("cover", ["", COVER])
def test_two_masses_on_a_spring_swing_with_the_root_of_stiffness_over_reduced_mass(cover):
    found = nmm.run(nmm.parse_scene(flying(spring(), duration=0.05) + cover))
    force, time = found.history["springs:s:force"], found.history["time"]
    exact = -0.2 / OMEGA * 1e6 * np.sin(OMEGA * time)
    # Newmark: a share (w dt)^2 / 12 of the phase, 1.2e-4, over 8 rad; blocks of 50 GPa give 1e-4
    # of the spring; the first step, without acceleration, w dt / 4 once.
    assert np.abs(force - exact).max() / np.abs(exact).max() < 5e-3


def test_a_dashpot_slows_two_masses_exponentially():
    found = nmm.run(nmm.parse_scene(flying(dashpot(), duration=0.1)))
    rate = 20e3 / REDUCED
    time = found.history["time"] - 0.5e-3  # the force is that of the middle of the step
    exact = 20e3 * -0.2 * np.exp(-rate * time)
    assert np.abs(found.history["dashpots:d:force"] - exact).max() / np.abs(exact).max() < 1e-3
    kinetic = REDUCED * 0.2**2 / 2 * (1 - np.exp(-2 * rate * 0.1))
    assert found.history["loss:dashpots"][-1] == pytest.approx(kinetic, rel=1e-3)
    assert abs(found.summary.energy_balance) < 1e-3


@pytest.mark.parametrize("rule", ["shi", "generalized_alpha"])
@pytest.mark.parametrize("cover", ["", COVER])
def test_what_a_dashpot_takes_is_no_loss_of_the_integrator(rule, cover):
    """That is what is missing beside what is stored and what the dashpot takes."""
    row = nmm.run(nmm.parse_scene(flying(dashpot(), duration=0.1, rule=rule) + cover)).history
    stored = row["kinetic_energy"] + row["strain_energy"]
    begun = MASSES[0] * 0.2**2 / 2
    missing = begun - stored[-1] - row["loss:dashpots"][-1]
    # To the rounding of sums; of what the dashpot takes it was the half, or a tenth.
    assert row["integration_loss"][-1] == pytest.approx(missing, abs=1e-8 * begun)


@pytest.mark.parametrize("rule", ["newmark", "shi"])
@pytest.mark.parametrize("cover", ["", COVER])
def test_a_flying_pair_keeps_momentum_and_angular_momentum(rule, cover):
    between = spring(points=OBLIQUE) + dashpot(points="[[1, 0.8], [3, 0.3]]")
    text = flying(between, duration=0.04, velocity=(1, 5), spin=3, rule=rule, step=2e-3) + cover
    found = nmm.run(nmm.parse_scene(text))
    assert found.summary.status == "converged"
    # Rows keep both; what is left is the tolerance of the iteration, 1e-10 of the force.
    assert found.summary.audits.get("momentum", 0.0) < 1e-10
    assert found.summary.audits.get("angular_momentum", 0.0) < 1e-10


def test_the_energy_of_a_flying_pair_is_kept_by_the_midpoint():
    text = flying(spring(points=OBLIQUE), duration=0.04, velocity=(1, 5), spin=3, step=5e-4)
    found = nmm.run(nmm.parse_scene(text))
    row = found.history
    energy = row["kinetic_energy"] + row["strain_energy"] + row["energy:springs"]
    # A turn of 0.5 mrad a step: work of the moment is off by its square.
    assert np.abs(energy / energy[0] - 1).max() < 1e-5


@pytest.mark.parametrize(
    "between",
    [
        spring("1e-30 N/m"),
        dashpot("1e-30 N s/m"),
        spring("1e-30 N/m", more='carries = "tension"'),
    ],
)
def test_what_has_no_stiffness_changes_nothing(between):
    runs = [
        nmm.run(nmm.parse_scene(flying(one, duration=0.02, velocity=(1, 5), spin=3)))
        for one in (between, "")
    ]
    ways = [run.displacement for run in runs]
    assert np.abs(ways[0] - ways[1]).max() <= 1e-12 * np.abs(ways[1]).max()


def test_effects_that_no_scene_names_are_not_imported():
    code = (
        f"import sys, nmm; nmm.run(nmm.parse_scene({flying('', duration=0.002)!r})); "
        "assert not [name for name in sys.modules if name.startswith('nmm.effects.members')]"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


PENDULUM = """
plane = "strain"
duration = "{duration} s"
[materials.stone]
young_modulus = "50 GPa"
poisson_ratio = 0.2
density = 1000
[[blocks]]
name = "bob"
material = "stone"
vertices = [[-0.01, -2.01], [0.01, -2.01], [0.01, -1.99], [-0.01, -1.99]]
[[springs]]
name = "string"
points = [[0, 0], [0, -2]]
blocks = ["ground", "bob"]
stiffness = "10 MN/m"
force = "3.924 N"
carries = "tension"
[[initial_velocities]]
block = "bob"
velocity = [0.1, 0]
[[monitors]]
name = "bob"
point = [0, -2]
[inertia]
[gravity]
[formulation.integrator]
type = "newmark"
step = "10 ms"
"""


def test_a_bob_on_a_string_swings_with_the_root_of_gravity_over_length():
    found = nmm.run(nmm.parse_scene(PENDULUM.format(duration=0.5)))
    assert found.summary.status == "converged", found.summary.sentence
    time, way = found.history["time"], found.history["monitor:bob:ux"]
    omega = np.sqrt(9.81 / 2)
    exact = 0.1 / omega * np.sin(omega * time)
    # The swing of 0.0226 rad is slower by its square / 16; the bob's own moment of inertia is 1e-5.
    assert np.abs(way - exact).max() / np.abs(exact).max() < 2e-3


YIELDING = """
plane = "strain"
[materials.stone]
young_modulus = "50 GPa"
poisson_ratio = 0.0
[[blocks]]
name = "stone"
material = "stone"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[springs]]
name = "s"
points = [[-1, 0.5], [0, 0.5]]
blocks = ["ground", "stone"]
stiffness = "1 MN/m"
force = "1 kN"
yield_force = "5 kN"
[[supports]]
name = "jack"
segment = [[1, 0], [1, 1]]
fix = ["x", "y"]
displacement = ["10 mm", 0]
[loading]
[formulation.loading]
increment = 0.05
"""


@pytest.mark.parametrize("increment", [0.05, 0.3, 1.0])
def test_a_spring_yields_and_its_plastic_work_is_booked(increment):
    """In one increment the mean of the forces at its ends would be 18 J in place of 30."""
    text = YIELDING.replace("increment = 0.05", f"increment = {increment}")
    found = nmm.run(nmm.parse_scene(text))
    row = found.history
    assert row["springs:s:force"][-1] == pytest.approx(5e3, rel=1e-9)
    # 4 mm to the yield force; 6 mm beyond at 5 kN.
    # The stone gives way by 0.1 um.
    assert row["loss:springs"][-1] == pytest.approx(5e3 * 6e-3, rel=2e-5)
    assert row["energy:springs"][-1] == pytest.approx(5e3**2 / 2e6, rel=1e-9)
    # What the prestress of 1 kN stores is there from the start.
    assert row["external_work"][-1] == pytest.approx(12.5 - 0.5 + 30, rel=2e-5)
    assert abs(found.summary.energy_balance) < 1e-5


PULLED_AND_LET_GO = """
plane = "strain"
[materials.stone]
young_modulus = "100 GPa"
poisson_ratio = 0.0
[[blocks]]
name = "block"
material = "stone"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[supports]]
name = "rails"
segment = [[0, 0], [1, 0]]
fix = ["y"]
[[springs]]
name = "weak"
blocks = ["ground", "block"]
points = [[-1, 0.5], [0, 0.5]]
stiffness = "1 MN/m"
yield_force = "500 N"
[[springs]]
name = "strong"
blocks = ["ground", "block"]
points = [[-1, 0.5], [0, 0.5]]
stiffness = "2 MN/m"
[[loads]]
name = "pull"
kind = "point"
point = [1, 0.5]
force = ["3 kN", 0]
[[monitors]]
name = "m"
point = [0, 0.5]
[[stages]]
name = "pulled"
[[stages]]
name = "let go"
loads = []
[formulation.loading]
increment = 0.25
"""


@pytest.mark.parametrize("update", ["exact", "small"])
@pytest.mark.parametrize("cover", ["", '[formulation.cover]\ntype = "quads"\nsize = 0.5\n'])
def test_a_spring_that_has_yielded_stays_longer_once_its_load_is_gone(cover, update):
    """Two springs side by side: 1.25 mm under the load, 0.25 mm without, 0.375 J lost for good."""
    text = f'{PULLED_AND_LET_GO}{cover}[formulation.rotation]\nupdate = "{update}"\n'
    row = nmm.run(nmm.parse_scene(text)).history
    # Force and way are those of rigid stone; it gives way by 1e-5 of the springs.
    assert row["monitor:m:ux"].max() == pytest.approx((3e3 - 500) / 2e6, rel=1e-4)
    assert row["monitor:m:ux"][-1] == pytest.approx(0.25e-3, rel=1e-4)
    assert row["loss:springs"][-1] == pytest.approx(500 * (1.25e-3 - 0.5e-3), rel=1e-4)


@pytest.mark.parametrize("update", ["exact", "small"])
def test_springs_keep_what_every_effect_promises(update):
    text = flying(spring(points=OBLIQUE, more="force = 2e3"), spin=1.0)
    scene = nmm.parse_scene(text + f'[formulation.rotation]\nupdate = "{update}"\n')
    check_effect_of(scene, "springs")


@pytest.mark.parametrize("cover", ["triangles", "quads", "bspline", "mls"])
def test_the_end_on_the_ground_may_be_where_no_cover_reaches(cover):
    """A square that hangs on a spring is stretched by its weight over the stiffness, 1.962 mm."""
    hung = HUNG + f'[formulation.cover]\ntype = "{cover}"\nsize = 0.6\ndegree = 1\n'
    run = nmm.run(nmm.parse_scene(hung))
    # The spring's force over its stiffness; the square's own strain is 1e-5 of that.
    assert run.history["monitor:o:uy"][-1] == pytest.approx(-2000 * 9.81 / 1e7, rel=1e-3)


SLACK = """
plane = "strain"
[materials.m]
young_modulus = "1 GPa"
poisson_ratio = 0.2
density = 1000
[[blocks]]
name = "a"
material = "m"
vertices = [[0, 0], [2, 0], [2, 1], [0, 1]]
[[supports]]
name = "held"
point = [0, 0]
fix = ["x", "y"]
[[springs]]
name = "slack"
points = [[2, 0], [2, -1]]
blocks = ["a", "ground"]
stiffness = 1e6
carries = "tension"
[[springs]]
name = "tight"
points = [[1, 1], [1, 2]]
blocks = ["a", "ground"]
stiffness = 1e6
[[loads]]
name = "down"
kind = "point"
point = [2, 1]
force = [0, -1e3]
[formulation.cover]
type = "block"
functions = "{functions}"
"""


@pytest.mark.parametrize("functions", ["rigid", "rigid_strain"])
def test_a_spring_that_goes_slack_leaves_its_load_to_the_other(functions):
    """The load turns the block about a corner, against the one spring that pulls, at half its arm.

    A rigid block has no stiffness to measure forces by: all of them once compared as nothing, and
    the first iteration, with both springs, was taken for the answer.
    """
    run = nmm.run(parse_scene(SLACK.format(functions=functions)))
    assert run.summary.status == "converged"
    assert run.history["springs:slack:force"][-1] == 0.0
    assert run.history["springs:tight:force"][-1] == pytest.approx(2e3, rel=1e-9)
    # The support's spring is 1e6 times as stiff as its reaction needs: rounding.
    assert run.history["reaction:held:y"][-1] == pytest.approx(-1e3, rel=1e-6)
