"""Supports that follow records: one mass on a spring against the exact answer, and its books."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import nmm
from nmm.effects.motion.record import GroundMotion

# Record R1: m/s2, every 0.1 s, linear between.
R1 = [0, 0.6, 1.8, -1.2, -3.0, 0.9, 3.4, 2.1, -0.8, -3.6, -1.5, 2.4, 1.1, -2.2, 0.4, 1.6, -0.9]
R1 += [-0.5, 0.3, -0.1, 0]
# A bilinear cell that only shears, with its base driven: the top is 1.5 times the oscillator.
SCENE = """
title = "one cell on a shaken base"
plane = "strain"
duration = {duration}
[materials.soil]
young_modulus = {young}
poisson_ratio = 0.25
density = 1000
[[blocks]]
name = "cell"
material = "soil"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[records.R1]
values = {values}
step = 0.1
[[supports]]
name = "base"
segment = [[0, 0], [1, 0]]
fix = ["x"]
motion = {{ x = "R1" }}
[[supports]]
name = "level"
block = "cell"
fix = ["y"]
[[monitors]]
name = "top"
point = [0.5, 1]
[[monitors]]
name = "base"
point = [0.5, 0]
[inertia]
[damping]
stiffness = {damping}
[formulation.cover]
type = "quads"
size = 1.0
degree = 0
[formulation.integrator]
type = "newmark"
step = {step}
[formulation.rotation]
update = "small"
[formulation.supports]
method = "lagrange"
"""


def scene(period=0.5, ratio=0.05, step=0.005, duration=2.0):
    omega = 2 * math.pi / period
    shear = 1000 * omega**2 / 3
    return SCENE.format(
        values=R1, young=2.5 * shear, damping=2 * ratio / omega, step=step, duration=duration
    )


def oscillator(**more):
    """History of the top relative to the base as that of one mass on a spring; and the run."""
    run = nmm.run(nmm.parse_scene(scene(**more)))
    assert run.summary.status == "converged"
    return (run.history["monitor:top:ux"] - run.history["monitor:base:ux"]) / 1.5, run


def at(run, values, time):
    return float(np.interp(time, run.history["time"], values))


def test_the_ground_follows_the_integral_of_the_record():
    _, run = oscillator(step=0.025)
    base = run.history["monitor:base:ux"]
    assert base[-1] == pytest.approx(0.204, abs=1e-9)


@pytest.mark.parametrize(
    ("period", "ratio", "largest", "first", "last"),
    [
        (0.5, 0.05, 0.08199225, 0.0756450992, 0.0482207489),
        (0.3, 0.0, 0.02778873, 0.0113379287, 0.0186646556),
    ],
)
def test_one_mass_under_the_record_has_the_exact_displacements(period, ratio, largest, first, last):
    found, run = oscillator(period=period, ratio=ratio, step=period / 100)
    # Second order: 1e-3 of the largest displacement at a hundred steps a period. The period is
    # (2 pi / 100)^2 / 12 longer, so that undamped swings are late by w t times it.
    late = (2 * math.pi / 100) ** 2 / 12 * 2 * math.pi / period
    assert np.abs(found).max() == pytest.approx(largest, rel=1.5e-3)
    assert at(run, found, 1.0) == pytest.approx(first, abs=(1e-3 + late) * largest)
    assert at(run, found, 2.0) == pytest.approx(last, abs=(1e-3 + 2 * late) * largest)


def test_mass_that_damps_against_the_moving_ground_has_the_same_answer():
    omega = 2 * math.pi / 0.5
    text = scene().replace(f"stiffness = {0.1 / omega}", f'mass = {0.1 * omega}\nground = "base"')
    assert "ground" in text
    run = nmm.run(nmm.parse_scene(text))
    found = (run.history["monitor:top:ux"] - run.history["monitor:base:ux"]) / 1.5
    assert np.abs(found).max() == pytest.approx(0.08199225, rel=1.5e-3)
    h = run.history
    stored = h["kinetic_energy"] + h["strain_energy"] + h["support_energy"]
    lost = h["damping_loss:damping against the ground"] + h["integration_loss"]
    assert np.abs(h["external_work"] - stored - lost).max() < 1e-9 * h["external_work"].max()


def test_errors_fall_fourfold_when_steps_are_halved_that_do_not_divide_the_samples():
    errors = []
    for step in (0.03, 0.015):
        found, run = oscillator(step=step)
        errors.append(np.abs(found - exact(run.history["time"])).max())
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.15)


def exact(times, period=0.5, ratio=0.05):
    """Relative displacements by an independent integration to 1e-9."""
    omega, samples = 2 * math.pi / period, np.arange(21) * 0.1

    def rates(t, y):
        return [y[1], -np.interp(t, samples, R1) - 2 * ratio * omega * y[1] - omega**2 * y[0]]

    asked = {"t_eval": times, "rtol": 1e-9, "atol": 1e-12, "max_step": 0.01}
    return solve_ivp(rates, (0, times[-1] + 1e-9), [0.0, 0.0], method="DOP853", **asked).y[0]


def test_the_work_of_the_shaken_ground_is_in_the_books():
    _, run = oscillator(step=0.01)
    h = run.history
    stored = h["kinetic_energy"] + h["strain_energy"] + h["support_energy"]
    missing = (
        h["external_work"] - stored - h["damping_loss:viscous damping"] - h["integration_loss"]
    )
    assert np.abs(missing).max() < 1e-9 * h["external_work"].max()
    assert abs(h["integration_loss"][-1]) < 1e-2 * h["external_work"].max()


def exact_work(times, period=0.5, ratio=0.05):
    """Work of the ground by an independent integration to 1e-9: the base and half of the top."""
    omega, samples = 2 * math.pi / period, np.arange(21) * 0.1

    def rates(t, y):
        ground = np.interp(t, samples, R1)
        relative = -ground - 2 * ratio * omega * y[1] - omega**2 * y[0]
        return [y[1], relative, ground, 1000 * (ground + 0.75 * relative) * y[2]]

    asked = {"t_eval": times, "rtol": 1e-9, "atol": 1e-12, "max_step": 0.01}
    return solve_ivp(rates, (0, times[-1] + 1e-9), [0.0] * 4, method="DOP853", **asked).y[3]


def alpha(step, ratio=0.05, method="lagrange"):
    text = scene(step=step, ratio=ratio).replace('"newmark"', '"generalized_alpha"')
    return nmm.run(nmm.parse_scene(text.replace('"lagrange"', f'"{method}"')))


def test_the_work_of_the_ground_has_the_order_two_of_generalized_alpha():
    errors = []
    for step in (0.02, 0.01):
        run = alpha(step)
        errors.append(run.history["external_work"][-1] - exact_work(run.history["time"])[-1])
    # With reactions 0.056 of a step after its middle it is 3.1.
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.05)


@pytest.mark.parametrize("method", ["lagrange", "penalty"])
def test_generalized_alpha_gives_less_than_a_thousandth_at_fifty_steps_a_period(method):
    # (w dt)^2 / 12 of the turnover, the relative error of its period; to first order it were 3e-3.
    late = (2 * math.pi / 50) ** 2 / 12
    assert alpha(0.01, 0.0, method).summary.audits["energy_made_in_run"] < late


@pytest.mark.parametrize(("step", "warns"), [(0.05, False), (0.06, True), (0.2, True)])
def test_a_step_above_half_of_the_record_s_warns(step, warns):
    _, run = oscillator(step=step, duration=0.4)
    told = [line for line in run.summary.warnings if "(audit record_step)" in line]
    assert bool(told) is warns


@pytest.mark.parametrize(
    ("baseline", "speed", "way"), [("velocity", 0.0, 0.124), ("displacement", 0.0, 0.0)]
)
def test_baselines_bring_the_record_to_rest(baseline, speed, way):
    from nmm.effects.motion.record import GroundMotion
    from nmm.scene.tables.shaking.records import RecordTable

    table = RecordTable(values=R1, step=0.1, baseline=baseline)
    motion = GroundMotion.of(table)
    assert motion.velocity_at(2.0) == pytest.approx(speed, abs=1e-12)
    assert motion.displacement_at(2.0) == pytest.approx(way, abs=1e-12)
    assert motion.displacement_at(3.0) == pytest.approx(way, abs=1e-12)


@pytest.mark.parametrize("quantity", ["velocity", "displacement"])
def test_a_record_of_velocity_or_displacement_moves_by_it(quantity):
    from nmm.effects.motion.record import GroundMotion
    from nmm.scene.tables.shaking.records import RecordTable

    values = [0.0, 1.0, 3.0, 0.0]
    motion = GroundMotion.of(RecordTable(values=values, step=0.5, quantity=quantity))
    if quantity == "displacement":
        assert motion.displacement_at(0.75) == pytest.approx(2.0)
        assert motion.velocity_at(0.75) == pytest.approx(4.0)
    else:
        assert motion.velocity_at(0.75) == pytest.approx(2.0)
        assert motion.displacement_at(0.75) == pytest.approx(0.25 + 0.25 * 1.5)
        assert motion.displacement_at(2.0) == pytest.approx(0.25 + 1.0 + 0.75)


@pytest.mark.parametrize(
    ("times", "resolved"),
    [
        ([0.0, 0.1, 0.1 + 1e-6, 1.0], 0.1),
        ([0.0, 1e-6, 0.5, 0.7], 0.2),
        ([0.0, 1e-6], 1e-6),
        ([0.0, 0.1, 0.11, 0.12, 1.0], 0.01),
    ],
)
def test_a_jump_drawn_by_two_samples_asks_for_no_steps_that_resolve_it(times, resolved):
    motion = GroundMotion.from_acceleration(np.array(times), np.arange(float(len(times))))
    assert motion.shortest_step == pytest.approx(resolved, rel=1e-4)


@pytest.mark.parametrize(
    ("period", "step", "status"), [(1.0, 0.05, "unbalanced"), (0.25, 0.1, "converged")]
)
def test_a_gift_of_the_integrator_beyond_a_tenth_of_the_turnover_is_no_converged_run(
    period, step, status
):
    sine = [round(1e-3 * math.sin(0.4 * math.pi * n), 8) for n in range(21)]
    text = scene(period=period, step=step).replace(
        f"values = {R1}", f'values = {sine}\nquantity = "displacement"'
    )
    found = nmm.run(nmm.parse_scene(text.replace('"newmark"', '"generalized_alpha"'))).summary
    assert (found.audits["energy_made_in_run"] > 0.1) == (status == "unbalanced")
    assert found.status == status


BELT = """
plane = "strain"
duration = 0.02
[materials.rubber]
young_modulus = 1e8
poisson_ratio = 0.0
density = 1000.0
[[blocks]]
name = "belt"
material = "rubber"
vertices = [[0, 0], [4, 0], [4, 0.5], [0, 0.5]]
[records.speed]
quantity = "velocity"
samples = {samples}
[[supports]]
name = "drive"
block = "belt"
fix = ["x", "y"]
motion = {{ x = "speed" }}
[[initial_velocities]]
block = "belt"
velocity = [{first}, 0]
[inertia]
[formulation.integrator]
type = "newmark"
step = 0.001
"""


@pytest.mark.parametrize(
    ("samples", "first", "told"),
    [
        ([[0, 1], [1, 1]], 0.0, "sets out at once with 1 m/s along x"),
        ([[0, 1], [1, 1]], 1.0, ""),
        ([[0, 1], [1, 1]], 2.0, "sets out at once with -1 m/s along x"),
        ([[0.005, 1], [1, 1]], 0.0, "sets out at once with 1 m/s along x"),
        ([[-0.01, 1], [1, 1]], 1.0, "is 0.01 m away along x at time zero"),
        ([[0, 0.01], [0.01, 1]], 0.0, ""),
        ([[0, 0], [0.008, 0], [0.00801, 1], [1, 1]], 0.0, "jumps by 1 m/s along x at 0.008 s"),
        ([[0, 2], [0.008, 2], [0.00801, 1], [1, 1]], 2.0, "jumps by -1 m/s along x at 0.008 s"),
        ([[-2, 0], [0, 0], [0.01, 1], [3, 1]], 0.0, ""),
        ([[0, 0], [0.03, 0], [0.0301, 1], [3, 1]], 0.0, ""),
    ],
)
def test_ground_that_jumps_throws_bodies_about_and_is_told(samples, first, told):
    run = nmm.run(nmm.parse_scene(BELT.format(samples=samples, first=first)))
    found = [one for one in run.summary.warnings if one.startswith("supports: ")]
    assert len(found) == bool(told)
    assert all(told in one and 'support "drive"' in one for one in found)
    # By the trapezoidal rule speeds swing for good between twice a jump of 1 m/s and nothing:
    # energies of 2 t by 4 kJ, a part of it in strain; a ramp over ten steps leaves less than 0.2.
    kinetic = run.history["kinetic_energy"][12:] / 1000.0
    assert (np.ptp(kinetic) > 2) if told else (np.ptp(kinetic) < 0.2)


STEADY = "displacement = [1, 0]\nhistory = [[0, 0], [1, 1]]"


@pytest.mark.parametrize(
    ("way", "first", "told"),
    [
        (STEADY, 0.0, "sets out at once with 1 m/s along x"),
        (STEADY, 1.0, ""),
        ('field = ["t", "0"]', 0.0, "sets out at once with 1 m/s along x"),
        ('field = ["0.01*(1 - cos(100*t))", "0"]', 0.0, ""),
        ('motion = { x = "way" }', 0.0, "sets out at once with 1 m/s along x"),
        ('motion = { x = "way" }', 1.0, ""),
        (
            STEADY.replace("[1, 1]", "[0.009, 0], [1, 0.991]"),
            0.0,
            "jumps by 1 m/s along x at 0.009",
        ),
        (STEADY.replace("[1, 1]", "[0.03, 0], [1, 1]"), 0.0, ""),
    ],
)
def test_ground_whose_way_is_given_is_told_where_its_speed_jumps(way, first, told):
    text = BELT.format(samples=[[0, 1], [1, 1]], first=first)
    text = text.replace('motion = { x = "speed" }', way)
    if "motion" in way:
        text = text.replace(".speed", ".way").replace('"velocity"', '"displacement"')
        text = text.replace("[[0, 1], [1, 1]]", "[[0, 0], [1, 1]]")
    else:
        text = text.replace("[records.speed]", "").replace('quantity = "velocity"\n', "")
        text = text.replace("samples = [[0, 1], [1, 1]]\n", "")
    run = nmm.run(nmm.parse_scene(text))
    found = [one for one in run.summary.warnings if one.startswith("supports: ")]
    assert len(found) == bool(told)
    assert all(told in one for one in found)
    if "cos" not in way:
        kinetic = run.history["kinetic_energy"][12:] / 1000.0  # as above
        assert (np.ptp(kinetic) > 2) if told else (np.ptp(kinetic) < 0.2)
