"""Transient water in joints: what comes in is stored, joints open by it, and faults by line."""

import re

import numpy as np
import pytest

import nmm
from nmm.errors import NmmError, SceneError
from nmm.testing import check_effect_of
from nmm.testing.resumed.stopping import check_goes_on
from nmm.verification.problems.water.joint_water import PressureInJoint

SHORT = PressureInJoint(0.3)
BULK = 2.2e9


@pytest.fixture(scope="module")
def filled():
    """Ten increments of a joint that fills from one end."""
    text = SHORT.scene().replace("increment = 0.025", "increment = 0.1")
    return nmm.run(nmm.parse_scene(text))


def test_water_that_came_in_is_stored(filled):
    """``sum (dV + V dp / K)``, the second with volumes at the ends of steps: 1e-3 of the first."""
    flow = filled.stepper.plan.effects["transient joint flow"]
    opened = (flow.apertures(filled.state) - PressureInJoint.aperture).mean(axis=1)
    volume = float(opened @ flow.network.length)
    pressure = flow.pressures(filled.state, filled.state.time)[flow.network.ends].mean(axis=1)
    squeezed = float(pressure @ flow.network.length) * PressureInJoint.aperture / BULK
    taken = filled.history["transient joint flow:taken:pump"][-1]
    assert taken == pytest.approx(volume + squeezed, rel=1e-3)


def test_joints_open_by_their_pressure_over_their_stiffness(filled):
    flow = filled.stepper.plan.effects["transient joint flow"]
    opened = flow.apertures(filled.state) - PressureInJoint.aperture
    pressure = flow.pressures(filled.state, filled.state.time)[flow.network.ends]
    off = opened.mean(axis=1) - pressure.mean(axis=1) / PressureInJoint.stiffness
    assert np.abs(off).max() < 1e-3 * opened.max()


def test_a_joint_that_opens_much_lets_more_in():
    """With 1 MPa joints open to twice their aperture: water comes faster than in proportion."""
    text = SHORT.scene().replace("increment = 0.025", "increment = 0.25")
    shares = []
    for head in (1e3 / 9810, 1e6 / 9810):
        run = nmm.run(nmm.parse_scene(text.replace(f"head = {1e3 / 9810!r}", f"head = {head!r}")))
        assert run.summary.status == "converged"
        shares.append(run.history["transient joint flow:taken:pump"][-1] / head)
    assert shares[1] > 1.3 * shares[0]


def test_water_spreads_in_a_run_with_inertia_as_in_one_without():
    """Blocks that swing a thousand times faster than water spreads rest: the series of a slab."""
    given = SHORT.scene()
    lasts = float(re.search(r"duration = (\S+)", given).group(1))
    text = re.sub(r"\[loading\][^\[]*", "", given.replace(f"duration = {lasts!r}\n", ""))
    text = text.replace("[contact]", f"duration = {lasts!r}\n[inertia]\n[contact]", 1)
    text = text.replace("poisson_ratio = 0.0", "poisson_ratio = 0.0\ndensity = 2500.0")
    steps = f'[formulation.integrator]\ntype = "shi"\nstep = {lasts / 40!r}'
    text = text.replace("[formulation.loading]\nincrement = 0.025", steps)
    run = nmm.run(nmm.parse_scene(text))
    assert run.summary.status == "converged"
    checks = SHORT.measure(run)  # of order 1 in forty steps, as there
    assert all(check.passed for check in checks.values()), checks


def test_transient_water_in_joints_keeps_what_every_effect_promises():
    """Of water at one head in a wide joint, under a pressure that no motion takes away.

    A step keeps the conductances and the storage of its start, of which its matrix is made.
    """
    text = SHORT.scene().replace("increment = 0.025", "increment = 0.5")
    for was, now in (
        (r"initial = 0.0", "initial = 1e3"),
        (r"\bhead = \S+", "head = 1e3"),
        (r"aperture = \S+", "aperture = 1.0"),
        (r"duration = \S+", "duration = 1e-12"),
    ):
        text = re.sub(was, now, text)
    check_effect_of(nmm.parse_scene(text), "transient joint flow")


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (("initial = 0.0\n", ""), "initial head"),
        (("transient = true\n", ""), "transient = true"),
        (("duration = ", "bulk_modulus = "), "duration missing"),
    ],
)
def test_what_is_missing_is_told_by_line(change, said):
    with pytest.raises(SceneError, match=said):
        nmm.parse_scene(SHORT.scene().replace(*change, 1), "scene")


def in_stages(stages):
    """The text of the short joint whose water has half of its time in each stage."""
    given = SHORT.scene()
    duration = float(re.search(r"duration = (\S+)", given).group(1))
    halved = given.replace(f"duration = {duration!r}", f"duration = {duration / 2!r}")
    halved = halved.replace("increment = 0.025", "increment = 0.2")
    return re.sub(r"\[loading\][^\[]*", "", halved) + stages


def test_water_of_two_stages_goes_as_far_as_in_one_run(filled):
    text = in_stages('[[stages]]\nname = "a"\n[[stages]]\nname = "b"\n')
    run = nmm.run(nmm.parse_scene(text))
    heads = [
        one.stepper.plan.effects["transient joint flow"].pressures(one.state, one.state.time)
        for one in (filled, run)
    ]
    # Iterations of contact end at 1e-8 of the forces.
    assert np.abs(heads[1] - heads[0]).max() < 1e-7 * heads[0].max()


def test_water_stays_in_joints_when_its_pump_goes(tmp_path):
    """In a stage without a head it spreads: what came is stored, the pressure evens out."""
    text = in_stages('[[stages]]\nname = "a"\n[[stages]]\nname = "b"\nwater = []\n')
    text += "[output.checkpoint]\nevery_steps = 3\n"
    run = check_goes_on(nmm.parse_scene(text), tmp_path)
    flow = run.stepper.plan.effects["transient joint flow"]
    pressure = flow.pressures(run.state, run.state.time)
    opened = (flow.apertures(run.state) - PressureInJoint.aperture).mean(axis=1)
    squeezed = pressure[flow.network.ends].mean(axis=1) * PressureInJoint.aperture / BULK
    came = np.nanmax(run.history["transient joint flow:taken:pump"])
    # As above: volumes at the ends of steps.
    assert float((opened + squeezed) @ flow.network.length) == pytest.approx(came, rel=1e-3)
    assert pressure.max() < 0.6e3


def test_water_of_a_joint_whose_block_leaves_goes_with_it():
    text = in_stages('[[stages]]\nname = "a"\n[[stages]]\nname = "b"\nremove = ["b19"]\n')
    run = nmm.run(nmm.parse_scene(text))
    flow = run.stepper.plan.effects["transient joint flow"]
    assert run.summary.status == "converged"
    assert len(flow.network.length) == 19
    assert flow.pressures(run.state, run.state.time).max() == pytest.approx(1e3, rel=1e-9)


def pair(text, top=""):
    """A block of 1 m on another that stands, over a joint of 0.2 mm with a head at its left end."""
    return nmm.parse_scene(f"""
    title = "two blocks"
    plane = "strain"
    {top}
    [materials.rock]
    young_modulus = "20 GPa"
    poisson_ratio = 0.2
    density = "2600 kg/m^3"
    [interfaces.rock]
    friction_angle = "30 deg"
    aperture = "0.2 mm"
    residual_aperture = "0.02 mm"
    normal_stiffness = "10 GPa/m"
    shear_stiffness = "5 GPa/m"
    [contact]
    [[joint_heads]]
    name = "left"
    point = [0, 1]
    head = "1.5 m"
    [[supports]]
    name = "floor"
    segment = [[0, 0], [1, 0]]
    fix = ["x", "y"]
    [[blocks]]
    name = "below"
    material = "rock"
    vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
    [[blocks]]
    name = "above"
    material = "rock"
    vertices = [[0, 1], [1, 1], [1, 2], [0, 2]]
    {text}""")


@pytest.mark.parametrize("integrator", ["shi", "newmark"])
@pytest.mark.parametrize("step", ["0.25 ms", "0.05 ms"])
def test_a_block_that_settles_on_water_moves_no_faster_than_on_the_joint_alone(integrator, step):
    """Its kinetic energy stays below ``W^2 / 2 k``, that of its weight at once on the springs.

    Water is a thousand times stiffer than they are: its pressure comes and goes within steps.
    """
    text = f"""
    [gravity]
    [inertia]
    [joint_flow]
    transient = true
    initial = "1.5 m"
    [formulation.integrator]
    type = "{integrator}"
    step = "{step}"
    """
    run = nmm.run(pair(text, 'duration = "4 ms"'))
    weight, stiffness = 2600 * 9.81, 10e9
    softer = 1 / (1 / stiffness + 1 / 20e9)  # with half of both blocks
    assert run.summary.status == "converged"
    assert max(run.history["kinetic_energy"]) < weight**2 / 2 / softer


def test_what_opens_faster_than_water_comes_in_is_void():
    """A joint that opens at once takes what its head drives through it, not what it would suck in.

    ``q = g w^3 / (12 mu) h / L`` through its whole aperture, and what opens beside the head itself:
    half of the joint.
    """
    opened, seconds = 1e-3, 0.5
    scene = pair(f"""
    [joint_flow]
    transient = true
    initial = "1 m"
    duration = {seconds}
    [[supports]]
    name = "lift"
    segment = [[0, 2], [1, 2]]
    fix = ["x", "y"]
    displacement = [0, {opened}]
    """)
    flow = 9810 / 12e-3 * (2e-4 + opened) ** 3 * 0.5
    taken = nmm.run(scene).history["transient joint flow:taken:left"][-1]
    assert flow * seconds < opened / 2  # not yet full
    # Blocks give way to 5 kPa by 1e-7 m; heads of voids lie below their nodes by some 1e-3 m.
    assert taken == pytest.approx(flow * seconds + opened / 2, rel=2e-3)


def test_a_full_matrix_that_memory_cannot_hold_is_refused(monkeypatch):
    monkeypatch.setattr("nmm.water.full_matrix.BESIDE_CONTACT", 1e9)
    with pytest.raises(NmmError, match=r"joint_flow\.transient: 12 unknowns, about 144 GB"):
        nmm.run(pair('[joint_flow]\ntransient = true\ninitial = "1 m"\nduration = 1.0\n'))


UPRIGHT = """
title = "slit"
plane = "strain"
[materials.rock]
young_modulus = "10 GPa"
poisson_ratio = 0.2
[interfaces.rock]
friction_angle = 0.6
bonded = true
cohesion = "1 GPa"
tensile_strength = "1 GPa"
normal_stiffness = "1000 GPa/m"
shear_stiffness = "10 GPa/m"
aperture = "1 mm"
[contact]
[[blocks]]
name = "left"
material = "rock"
vertices = [[-2, 0], [0, 0], [0, 10], [-2, 10]]
[[blocks]]
name = "right"
material = "rock"
vertices = [[0, 0], [2, 0], [2, 10], [0, 10]]
[[supports]]
name = "left"
segment = [[-2, 0], [-2, 10]]
fix = ["x", "y"]
[[supports]]
name = "right"
segment = [[2, 0], [2, 10]]
fix = ["x", "y"]
[joint_flow]
transient = true
initial = 1.0
duration = 2000.0
[[joint_heads]]
name = "foot"
point = [0, 0]
head = 9.0
history = [[0, 1], [0.5, 1], [0.51, 0.1111111111111111]]
[formulation.loading]
increment = 0.05
"""


@pytest.mark.parametrize(("cover", "off"), [("quads", 1e-3), ("triangles", 0.03)])
def test_a_joint_on_end_that_fills_and_drains_takes_and_gives_what_it_holds(cover, off):
    """``w (9 - 1)`` of water, where its part below 9 m has nodes half way between."""
    text = f'{UPRIGHT}[formulation.cover]\ntype = "{cover}"\nsize = 1.0\n'
    history = nmm.run(nmm.parse_scene(text)).history
    taken = history["transient joint flow:taken:foot"]
    # Opened and compressed by 44 kPa in the mean: 6e-5.
    assert taken.max() == pytest.approx(1e-3 * 8.0, rel=off)
    # As the springs of the joint have closed again to the tolerance of contact.
    assert abs(taken[-1]) < 1e-4 * taken.max()
    assert taken == pytest.approx(history["transient joint flow:stored"], abs=1e-10 * taken.max())
