"""Bars whose bond slides along paths past the peak."""

import numpy as np
import pytest

import nmm

# Two rigid blocks of half a metre on one bar; the joint between them breaks at 100 N.
PULLED = """
plane = "stress"
thickness = 0.1
[materials.stone]
young_modulus = 1e15
poisson_ratio = 0.0
[interfaces.joint]
bonded = true
tensile_strength = 1e4
cohesion = 1e4
friction_angle = "30 deg"
[[blocks]]
name = "left"
material = "stone"
vertices = [[-0.5, 0], [0, 0], [0, 0.1], [-0.5, 0.1]]
[[blocks]]
name = "right"
material = "stone"
vertices = [[0, 0], [0.5, 0], [0.5, 0.1], [0, 0.1]]
[[bars]]
name = "bar"
points = [[-0.5, 0.05], [0.5, 0.05]]
area = 400e-6
perimeter = 0.2
young_modulus = 200e9
bond = { law = "plastic", stiffness = 1e12, strength = 1.88e6 }
[[supports]]
name = "wall"
segment = [[-0.5, 0], [-0.5, 0.1]]
fix = ["x", "y"]
[[supports]]
name = "rail"
segment = [[0.5, 0], [0.5, 0.1]]
fix = ["y"]
[[loads]]
name = "pull"
kind = "edge"
segment = [[0.5, 0], [0.5, 0.1]]
traction = [1e5, 0]
[[monitors]]
name = "left lip"
point = [-0.01, 0.05]
[[monitors]]
name = "right lip"
point = [0.01, 0.05]
[contact]
[loading]
until = "failure"
[loading.control]
type = "opening"
monitors = ["right lip", "left lip"]
increment = "5 um"
end = "100 um"
[formulation.bars]
pieces = 200
"""
# Axial stiffness (N), force of the bond per length (N/m), length over which it is elastic (m).
AXIAL, BOND = 200e9 * 400e-6, 1.88e6 * 0.2
ELASTIC = np.sqrt(AXIAL / (1e12 * 0.2))


@pytest.fixture(scope="module")
def pulled():
    """Return the run of the two blocks that are pulled apart."""
    return nmm.run(nmm.parse_scene(PULLED))


def test_a_bar_across_an_opening_joint_pulls_by_its_bond_and_elasticity(pulled):
    """F^2 = E A t (w - t l^2 / (E A)), t being the bond's force per length, l its elastic length.

    The bond slides over F / t - l on either side. Pieces of 5 mm beside 20 mm of l: 4e-4.
    """
    h = pulled.history
    opening = h["monitor:right lip:ux"] - h["monitor:left lip:ux"]
    slides = opening > 6e-6
    expected = np.sqrt(AXIAL * BOND * opening[slides] - (BOND * ELASTIC) ** 2)
    assert slides.sum() == 19
    np.testing.assert_allclose(1e3 * h["load_factor"][slides], expected, rtol=2e-3)


def test_along_a_path_work_is_what_bars_store_and_their_bond_takes(pulled):
    h = pulled.history
    length = 1e3 * h["load_factor"][-1] / BOND - ELASTIC
    # The integral of t s over the length that slides, s = t / E A (l x + x^2 / 2): both sides.
    taken = 2 * BOND**2 / AXIAL * (ELASTIC * length**2 / 2 + length**3 / 6)
    assert h["loss:bars"][-1] == pytest.approx(taken, rel=5e-3)  # ten steps: 1 %
    assert abs(pulled.summary.energy_balance) < 1e-9
    # The joint lost what was stored in it: 100 N over its spring, next to nothing.
    assert 0 <= h["friction_loss"][-1] < 1e-8 * taken


@pytest.mark.slow  # five seconds
def test_steps_of_one_energy_open_a_softening_joint_alike_though_the_bond_of_a_bar_slides():
    """Bonds lose E = f_t A u / 2, u being the opening: 5 um a step; the bar pulls as above."""
    soft = 'law = "linear_softening"\nfracture_energy = 100.0\nbonded = true'
    led = 'type = "dissipation"\nenergy = 2.5e-4\nend_energy = 2.5e-3\n'
    head, tail = PULLED.replace("bonded = true", soft).split('type = "opening"')
    h = nmm.run(nmm.parse_scene(head + led + tail[tail.index("[formulation") :])).history
    opening = h["monitor:right lip:ux"] - h["monitor:left lip:ux"]
    np.testing.assert_allclose(opening, 5e-6 * np.arange(11), rtol=1e-5, atol=1e-11)
    slides = opening > 6e-6
    bar = np.sqrt(AXIAL * BOND * opening[slides] - (BOND * ELASTIC) ** 2)
    np.testing.assert_allclose(1e3 * h["load_factor"][slides], bar + 100, rtol=2e-3)


# The joint carries A f_t = 10 kN and opens by 0.2 mm; the spring yields at 2 kN.
YIELDING = """
plane = "stress"
thickness = 0.1
[materials.stone]
young_modulus = {young}
poisson_ratio = 0.0
[interfaces.joint]
bonded = true
law = "linear_softening"
fracture_energy = 100.0
tensile_strength = 1e6
cohesion = 1e7
friction_angle = "30 deg"
[[blocks]]
name = "left"
material = "stone"
vertices = [[-0.5, 0], [0, 0], [0, 0.1], [-0.5, 0.1]]
[[blocks]]
name = "right"
material = "stone"
vertices = [[0, 0], [0.5, 0], [0.5, 0.1], [0, 0.1]]
[[springs]]
name = "steel"
points = [[-0.5, 0.05], [0.5, 0.05]]
stiffness = {stiffness}
yield_force = 2e3
[[supports]]
name = "wall"
segment = [[-0.5, 0], [-0.5, 0.1]]
fix = ["x", "y"]
[[supports]]
name = "rail"
segment = [[0.5, 0], [0.5, 0.1]]
fix = ["y"]
[[loads]]
name = "pull"
kind = "edge"
segment = [[0.5, 0], [0.5, 0.1]]
traction = [1e5, 0]
[[monitors]]
name = "end"
point = [0.5, 0.05]
[contact]
[loading]
until = "failure"
[loading.control]
type = "dissipation"
energy = 0.05
end_energy = 0.8
"""


@pytest.mark.parametrize(("young", "stiffness"), [(1e13, 1e8), (2.5e9, 1e7)])
def test_a_spring_that_yields_beside_a_softening_joint_is_led_by_what_the_joint_loses(
    young, stiffness
):
    """Lost E opens the joint by w = 2 E / (A f_t), and it carries A f_t - w A f_t / 0.2 mm.

    The whole grows longer by w and what blocks of E A take. Where these are stiff the spring
    yields as the joint opens; where they shorten by more than it opens (snap-back) the spring has
    yielded before, and unloads.
    """
    run = nmm.run(nmm.parse_scene(YIELDING.format(young=young, stiffness=stiffness)))
    h = run.history
    lost = 0.05 * np.arange(17)
    opening = 2 * lost / 1e4
    joint = 1e4 * (1 - opening / 2e-4)
    longer = opening + joint / (young * 0.01)
    # No force of the spring comes to -2 kN, so that it yields one way.
    yielded = np.maximum(np.maximum.accumulate(longer) - 2e3 / stiffness, 0.0)
    spring = stiffness * (longer - yielded)
    # The spring that takes over from the joint's terms holds f_t^2 A / 2 k: 1.3e-4 J at most.
    np.testing.assert_allclose(h["friction_loss"], lost, atol=1.5e-4)
    np.testing.assert_allclose(1e3 * h["load_factor"], joint + spring, rtol=1e-3)
    # The first step, to the joint's limit, takes its losses by the mean of its ends.
    taken = h["loss:springs"] - h["loss:springs"][0]
    np.testing.assert_allclose(taken, 2e3 * (yielded - yielded[0]), atol=2e-3)
    assert abs(run.summary.energy_balance) < 1e-9


# A second spring beside the one that yields, below its own limit at the peak: the static theorem
# shows no failure there, only the path does.
BESIDE = """
[[springs]]
name = "rest"
points = [[-0.5, 0.05], [0.5, 0.05]]
stiffness = 1e7
yield_force = 5e3
[[supports]]
"""


@pytest.mark.parametrize(
    ("young", "stiffness", "increment"), [(2.5e9, 1e7, 0.1), (1e11, 1e8, 0.02)]
)
def test_a_growing_load_ends_at_the_peak_beside_a_spring_that_yields(young, stiffness, increment):
    """The whole grows longer by u = w + F / (E A), F = A f_t (1 - w / 0.2 mm) in the joint.

    The soft spring has yielded as the joint begins to open at its limit, w = 0, where the load is
    largest; the stiff one yields on the way down, at u = 2 kN / k. The second spring adds 1e7 N/m.
    """
    head = YIELDING[: YIELDING.index("[loading.control]")].format(young=young, stiffness=stiffness)
    text = head.replace("[[supports]]\n", BESIDE.lstrip(), 1).replace("[1e5, 0]", "[1e6, 0]")
    text += f"[formulation.loading]\nincrement = {increment}\n"
    summary = nmm.run(nmm.parse_scene(text)).summary
    at_limit = 1e4 / (young * 0.01)
    longer = max(at_limit, 2e3 / stiffness)
    opening = (longer - at_limit) / (1 - at_limit / 2e-4)
    peak = 1e4 * (1 - opening / 2e-4) + 2e3 + 1e7 * longer
    assert summary.status == "failure_load"
    assert "a limit point was passed" in summary.sentence
    reached = 1e4 * summary.failure_factor
    assert summary.failure_tolerance <= 5e-3  # that of the load
    assert reached * (1 - 1e-9) <= peak <= reached * (1 + summary.failure_tolerance)
    assert abs(summary.energy_balance) < 1e-3


@pytest.mark.parametrize("increment", [1.15, 0.5])
def test_a_load_that_grows_beyond_the_limit_of_a_joint_does_the_work_along_its_path(increment):
    """To the limit at u = 10 um it is 11.1 kN, then 11.1 kN + 54.5 N/um w, and u grows by 0.95 w.

    That holds while no spring yields (u = 20 um): at 11.5 kN, the ends of increments, w = 7.3 um.
    """
    head = YIELDING[: YIELDING.index("[loading.control]")].format(young=1e11, stiffness=1e8)
    text = head.replace("[[supports]]\n", BESIDE.lstrip(), 1).replace("[1e5, 0]", "[1e6, 0]")
    text = text.replace('until = "failure"', "until = 1.15")
    run = nmm.run(nmm.parse_scene(text + f"[formulation.loading]\nincrement = {increment}\n"))
    further = 0.95 * 400 / 5.45e7
    work = 11100 * 1e-5 / 2 + (11100 + 11500) / 2 * further
    assert run.summary.status == "converged"
    # The rail's springs take 2.2 uJ, those in place of the joint's terms 3.
    assert run.history["external_work"][-1] == pytest.approx(work, abs=1e-5)
    assert abs(run.summary.energy_balance) < 1e-4  # of 0.134 J, for the same springs
