"""Relaxation ends after a bounded number of attempts, whatever its steps do."""

from dataclasses import replace

import pytest

import nmm
from nmm.effects.given.steps import Instant
from nmm.stepping.drive.equilibrium.pace import CUTS
from nmm.stepping.drive.equilibrium.relaxation import _first_length, relax
from nmm.stepping.prepare import prepare
from nmm.stepping.step.nonlinear.progress import FRUITLESS, MOST, hopeless
from nmm.stepping.step.stepper import Stepper

LOOSE = """
plane = "stress"
[contact]
[gravity]
[materials.r]
young_modulus = 1e9
poisson_ratio = 0.0
density = 2000.0
[interfaces.any]
friction_angle = "30 deg"
[[blocks]]
name = "base"
material = "r"
vertices = [[0, 0], [3, 0], [3, -1], [0, -1]]
[[blocks]]
name = "above"
material = "r"
vertices = [[1, 0.01], [2, 0.01], [2, 1.01], [1, 1.01]]
[[supports]]
name = "held"
block = "base"
fix = ["x", "y"]
"""


@pytest.fixture
def made():
    return prepare(nmm.parse_scene(LOOSE), nmm.Formulation())


def relaxed(made, monkeypatch, share):
    """Relax where every step longer than a share of the first fails; also count the attempts."""
    tries, attempt = {"in time": 0, "at rest": 0}, Stepper.attempt
    state, end = made.start, Instant(made.start.time, 1.0)
    longest = share * _first_length(
        made.stepper.model, made.stepper.plan.force(state, end), made.stepper.size
    )

    def limited(self, state, end, length):
        found = attempt(self, state, end, length)
        tries["at rest" if length is None else "in time"] += 1
        fails = length is not None and length > longest
        return replace(found, converged=False, sentence="made to fail") if fails else found

    monkeypatch.setattr(Stepper, "attempt", limited)
    return relax(made.stepper, state, end, ["base", "above"]), tries


def test_short_steps_between_those_that_fail_do_not_prolong_the_search(made, monkeypatch):
    # Each cut to 0.3 is followed by three or four steps, 1.5 times as long as the one before.
    found, tries = relaxed(made, monkeypatch, 1e-3)
    assert not found.at_rest
    assert "made to fail" in found.sentence
    assert tries["in time"] <= 5 * CUTS


def test_a_step_that_was_cut_short_is_not_taken_for_rest(made, monkeypatch):
    # Each static solution takes as long as many steps; a body in free fall has not come to rest.
    _, tries = relaxed(made, monkeypatch, 1e-3)
    assert tries["at rest"] == 0


def test_a_loose_block_comes_to_rest_where_steps_are_held_at_a_third_of_the_first(
    made, monkeypatch
):
    monkeypatch.setattr("nmm.stepping.drive.equilibrium.pace.LONGER", 1.0)
    found, _ = relaxed(made, monkeypatch, 1 / 3)
    assert found.at_rest


@pytest.mark.parametrize("rate", [0.0, 0.3, 0.9])
def test_iterations_that_gain_go_on_and_those_that_go_to_and_fro_end(rate):
    falling = [rate**k for k in range(MOST - 1)]
    assert not hopeless(falling)
    to_and_fro = [(1e-3, 0.6)[k % 2] for k in range(MOST)]
    ends = next(k for k in range(1, MOST + 1) if hopeless(to_and_fro[:k]))
    assert ends <= FRUITLESS + 2


def test_what_friction_took_on_the_way_to_rest_is_told():
    """Down a slope of 45 degrees to a step, on which it comes to lie; and straight down."""
    slope = "[[0, 0], [1, -1], [3, -3], [3, -2.5], [4, -2.5], [4, -5], [0, -5]]"
    above = "[[1, -0.99], [1.3, -1.29], [1.6, -0.99], [1.3, -0.69]]"
    slides = LOOSE.replace("[[0, 0], [3, 0], [3, -1], [0, -1]]", slope)
    slides = slides.replace("[[1, 0.01], [2, 0.01], [2, 1.01], [1, 1.01]]", above)
    sentences = [nmm.run(nmm.parse_scene(text)).summary.sentence for text in (slides, LOOSE)]
    assert all("brought to rest" in sentence for sentence in sentences)
    assert ["by another way" in sentence for sentence in sentences] == [True, False]


ANCHORED = (
    LOOSE.replace("1, 0.01", "1, 0").replace("2, 0.01", "2, 0")
    + """
[[springs]]
name = "anchor"
points = [[1.5, -0.5], [1.5, 0.95]]
blocks = ["base", "above"]
stiffness = %s
[[loads]]
name = "pull"
kind = "point"
block = "above"
point = [1.5, 0.9]
force = [0, 30000]
"""
)


def test_a_block_that_hangs_on_one_anchor_is_at_rest():
    # The anchor takes what the weight leaves of 30 kN; acting below, the weight brings it back.
    left = 30000 - 2000 * 9.81 * 1.01
    run = nmm.run(nmm.parse_scene(ANCHORED % 1e5))
    assert run.summary.status == "converged", run.summary.sentence
    # A turn is opposed by 30 kN x 0.395 m - 10.2 kN x 0.445 m = 7.3 kN m.
    assert "neutral" not in run.summary.sentence
    lift = run.frames[-1].points[-4:] - run.frames[0].points[-4:]
    assert lift[:, 1] == pytest.approx(left / 1e5, rel=1e-3)  # strain of the block: 1e-5 m
    assert run.history["springs:anchor:force"][-1] == pytest.approx(left, rel=1e-6)


def test_a_block_that_swings_about_its_place_is_no_failed_structure():
    # It hangs 0.52 m above the ground, where steps without the turn of forces do not find it.
    run = nmm.run(nmm.parse_scene(ANCHORED % 2e4))
    assert run.summary.status in ("converged", "failed")
