"""A force that travels over a beam: deflection in closed form, work in the books."""

import math
from pathlib import Path

import numpy as np
import pytest
from shapely import Polygon

import nmm
from nmm.errors import SceneError

LENGTH, HEIGHT, YOUNG, DENSITY, FORCE = 10.0, 0.4, 30e9, 2500.0, 1e4
AREA, SECOND = HEIGHT, HEIGHT**3 / 12
FIRST = math.pi**2 / LENGTH**2 * math.sqrt(YOUNG * SECOND / (DENSITY * AREA))
BEAM = """
title = "beam under a moving force"
plane = "stress"
duration = {duration}
[materials.concrete]
young_modulus = 30e9
poisson_ratio = 0.0
density = 2500
[[blocks]]
name = "beam"
material = "concrete"
vertices = [[0, 0], [10, 0], [10, 0.4], [0, 0.4]]
[[supports]]
name = "pin"
point = [0, 0.2]
fix = ["x", "y"]
[[supports]]
name = "roller"
point = [10, 0.2]
fix = ["y"]
[[loads]]
name = "wheel"
kind = "moving"
segment = [[0, 0.4], [10, 0.4]]
force = [0, -1e4]
speed = {speed}
{more}
[[monitors]]
name = "middle"
point = [5, 0.2]
[inertia]
[formulation.cover]
type = "quads"
size = 1.25
degree = 2
[formulation.integrator]
type = "newmark"
step = {step}
[formulation.rotation]
update = "small"
"""


def beam(speed, more="", share=1.0, steps=150):
    duration = share * LENGTH / speed
    return BEAM.format(speed=speed, more=more, duration=duration, step=duration / steps)


def deflection(times, speed, modes=9):
    """Of the middle: a force over a simply supported beam of Euler and Bernoulli (Fryba 1972)."""
    found = np.zeros_like(times)
    for n in range(1, modes + 1, 2):
        own, driven = n**2 * FIRST, n * math.pi * speed / LENGTH
        swing = np.sin(driven * times) - driven / own * np.sin(own * times)
        found += (
            2
            * FORCE
            / (DENSITY * AREA * LENGTH)
            * math.sin(n * math.pi / 2)
            * swing
            / (own**2 - driven**2)
        )
    return found


def missing(run):
    h = run.history
    stored = h["kinetic_energy"] + h["strain_energy"] + h["support_energy"]
    rest = h["external_work"] - stored - h["integration_loss"]
    return np.abs(rest).max() / np.abs(h["external_work"]).max()


@pytest.mark.parametrize("share", [0.25, 0.5])  # of the critical speed
def test_the_middle_of_a_beam_swings_under_a_moving_force_as_in_closed_form(share):
    speed = share * FIRST * LENGTH / math.pi
    run = nmm.run(nmm.parse_scene(beam(speed)))
    assert run.summary.status == "converged"
    found = -run.history["monitor:middle:uy"]
    expected = deflection(run.history["time"], speed)
    # Shear adds pi^2 / 12 (h/L)^2 E / (5/6 G) = 0.3 % to the first mode; supports are springs.
    assert np.abs(found - expected).max() < 0.02 * expected.max()
    assert missing(run) < 1e-9


def test_a_force_that_is_spread_comes_and_goes_whole():
    speed = 0.5 * FIRST * LENGTH / math.pi
    run = nmm.run(nmm.parse_scene(beam(speed, "spread = 1.0\n", steps=80)))
    loads = run.stepper.plan.effects["moving loads"]
    from nmm.effects.base import Instant

    def total(front):
        return sum(forces[:, 1].sum() for _, forces in loads._acting(Instant(front / speed, 1.0)))

    assert total(5.3) == pytest.approx(-1e4, rel=1e-12)
    assert total(0.25) == pytest.approx(-2.5e3, rel=1e-12)
    assert total(11.0) == 0.0
    assert missing(run) < 1e-9


def at_rest(stages=""):
    """The beam without inertia, over which the force travels in equilibrium; in 20 steps."""
    text = beam(2.0, steps=20).replace("[inertia]\n", "")
    if stages:
        text = text.replace("duration", "#", 1) + stages
    return nmm.run(nmm.parse_scene(text.replace('type = "newmark"\n', "")))


@pytest.mark.parametrize("stages", ["", '[[stages]]\nname = "crossing"\nduration = 5.0\n'])
def test_a_force_that_travels_at_rest_draws_the_line_of_influence(stages):
    h = at_rest(stages).history
    front = 2.0 * h["time"]
    way = np.minimum(front, LENGTH - front)
    bent = FORCE * way * (3 * LENGTH**2 - 4 * way**2) / (48 * YOUNG * SECOND)
    sheared = FORCE * way / 2 / (5 / 6 * YOUNG / 2 * AREA)
    # Timoshenko's line; where the force stands above the monitor the beam is squeezed besides.
    expected = bent + sheared
    assert np.abs(-h["monitor:middle:uy"] - expected).max() < 2e-3 * expected.max()
    np.testing.assert_allclose(h["reaction:pin:y"], FORCE * (1 - front / LENGTH), atol=1e-6 * FORCE)


def test_a_force_that_travels_at_rest_stands_where_the_clock_stopped_it_while_a_stage_rests():
    way = '[[stages]]\nname = "{}"\nduration = 2.5\n'
    h = at_rest(way.format("half way") + '[[stages]]\nname = "waits"\n' + way.format("on")).history
    assert (h["time"] == 2.5).sum() > 1
    # The lever; supports are springs whose forces end at the tolerance of a solution.
    front = 2.0 * h["time"]
    np.testing.assert_allclose(h["reaction:pin:y"], FORCE * (1 - front / LENGTH), atol=1e-6 * FORCE)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("speed = 20", "", "no speed: expected a speed, as kind is moving"),
        ('kind = "moving"', 'kind = "edge"', "loads.0: force: expected traction or field"),
        ("force = [0, -1e4]\nspeed = 20", "pressure = 1", "loads.0: pressure: expected force"),
        ("[inertia]", "", 'loads.0.kind: "moving" in a scene without time: expected a clock'),
    ],
)
def test_wrong_moving_loads_are_told_by_line(old, new, said):
    text = beam(20)
    if old == "[inertia]":
        text = text.replace("duration", "#", 1)
    assert old in text
    with pytest.raises(SceneError) as caught:
        nmm.parse_scene(text.replace(old, new, 1), "s.toml")
    assert said in str(caught.value)


def test_an_arch_that_is_crossed_at_rest_hands_weight_and_load_to_its_abutments():
    text = Path("examples/arch_bridge/bridge.toml").read_text()
    slow = text.replace("[inertia]\n", "").replace('step = "2 ms"', 'step = "50 ms"')
    run = nmm.run(nmm.parse_scene(slow))
    assert run.summary.status == "converged"
    both = run.history["reaction:west:y"] + run.history["reaction:east:y"]
    # 13 voussoirs, 13 slices of fill and two abutments, by their corners; contact ends at 1e-8.
    weight = 9.81 * sum(
        {"stone": 2400, "fill": 1800}[block.material] * Polygon(block.vertices).area
        for block in nmm.parse_scene(slow).blocks
    )
    np.testing.assert_allclose(both[0], weight, rtol=1e-3)  # g is 9.80665
    np.testing.assert_allclose(both[2:24], both[0] + 80e3, rtol=1e-6)
