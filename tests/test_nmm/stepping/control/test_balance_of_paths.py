"""What a path ends in is audited by the forces on all bodies, whatever its equations say."""

import numpy as np
import pytest

import nmm
from nmm.scene.read import parse_scene
from nmm.stepping.control import following, other_answers
from nmm.stepping.control.settling import settled
from nmm.stepping.step.trial import Attempt

# Two blocks and a bond that softens under a path by dissipation, drawn from random scenes.
SCENE = """
title = "A wedge on a wedge"
plane = "stress"

[materials.rock]
density = 2000
young_modulus = 3.27e8
poisson_ratio = 0.0

[interfaces.joint]
law = "linear_softening"
bonded = true
cohesion = 1.96e5
tensile_strength = 9.8e4
friction_angle = 0.3
fracture_energy = 84.3

[[blocks]]
name = "b0"
material = "rock"
vertices = [[0, 0.2289], [4.252, 1.6294], [4.252, 0], [0, 0]]

[[blocks]]
name = "b1"
material = "rock"
vertices = [[4.252, 1.6294], [0, 0.2289], [0, 2.8645], [4.252, 2.8645]]

[contact]

[[supports]]
name = "held"
segment = [[0, 0], [4.252, 0]]
fix = ["x", "y"]

[[loads]]
name = "corner"
kind = "point"
point = [4.252, 2.8645]
force = [-653.3, -1079.4]

[[loads]]
name = "body"
kind = "body"
block = "b0"
density = [3846.8, -10263.2]

[loading]
until = "failure"

[loading.control]
type = "dissipation"
energy = 2.68
end_energy = 13.4

[formulation.loading]
max_steps = 40
increment = 1.0
"""


def out_of_balance(history):
    """Loads less reactions at each step (S,), as a share of the largest reaction of the step."""
    area, factor = 4.252 * (0.2289 + 1.6294) / 2, history["load_factor"]
    asked = np.array([653.3 - 3846.8 * area, 1079.4 + 10263.2 * area])[:, None] * factor
    given = np.array([history[f"reaction:held:{axis}"] for axis in "xy"])
    return np.hypot(*(asked - given)) / np.abs(given).max(axis=0)


def test_a_path_keeps_no_step_whose_end_is_in_no_balance() -> None:
    """Steps by what all unloads to its origin led to the load turned round, far away."""
    run = nmm.run(parse_scene(SCENE))
    assert out_of_balance(run.history).max() < 1e-6
    assert "a limit point was passed" in run.summary.sentence
    assert min(run.history["load_factor"]) > 0
    assert run.summary.audits["force_balance"] < 1e-6


def test_a_path_whose_reactions_do_not_bear_its_loads_is_unbalanced(monkeypatch) -> None:
    def kept(stepper, attempt, correction):
        return attempt, *stepper.accept(attempt)

    monkeypatch.setattr(following, "settled", kept)
    monkeypatch.setattr(other_answers, "JUMPS_FROM", np.inf)
    monkeypatch.setattr(other_answers, "TAKEN", -np.inf)
    # The longer its steps the more a body turns in one.
    longer = "energy = 26.8\nend_energy = 134.0"
    run = nmm.run(parse_scene(SCENE.replace("energy = 2.68\nend_energy = 13.4", longer)))
    assert out_of_balance(run.history)[-1] > 1e-2
    assert run.summary.status == "unbalanced"
    assert "out of balance" in " ".join(run.summary.warnings)


PULLED = """
title = "Two blocks, a bond between them, pulled apart"
plane = "stress"
[materials.rock]
density = 2000
young_modulus = 3.27e8
poisson_ratio = 0.2
[interfaces.joint]
bonded = true
cohesion = 1e6
tensile_strength = 1e5
friction_angle = 0.3
[[blocks]]
name = "left"
material = "rock"
vertices = [[0, 0.1], [0.9, 0.3], [0.9, 1.3], [0, 1.1]]
[[blocks]]
name = "right"
material = "rock"
vertices = [[0.9, 0.3], [1.7, 0.1], [1.7, 0.9], [0.9, 1.3]]
[contact]
[[supports]]
name = "held"
point = [0.9, 1.3]
fix = ["x", "y"]
[[supports]]
name = "straight"
point = [0.9, 0.3]
fix = ["x"]
[[loads]]
name = "to the left"
kind = "point"
point = [0, 0.6]
force = [-6800, 400]
[[loads]]
name = "to the right"
kind = "point"
point = [1.7, 0.5]
force = [6800, -400]
[loading]
until = "failure"
[loading.control]
type = "events"
fall = 0.1
[formulation.loading]
increment = 1.0
"""


def test_loads_that_cancel_and_reactions_of_rounding_are_in_balance() -> None:
    """Two pulls of 6.8 kN have no sum: what is missed is set beside them, not beside rounding."""
    run = nmm.run(parse_scene(PULLED))
    assert run.summary.status != "unbalanced", run.summary.sentence
    # Steps are solved to 1e-8 of the load; reactions have nothing else to bear.
    reactions = [run.history[f"reaction:{one}"] for one in ("held:x", "straight:x", "held:y")]
    across = reactions[0] + reactions[1]
    assert np.abs([across, reactions[2]]).max() < 1e-6 * 6800
    assert run.summary.audits["force_balance"] < 1e-6


class PathState:
    """Where a stepper stands is the sum of what it accepted."""

    small, carried, size, anchored, reference = False, "before", 1.0, False, np.ones((1, 2))

    def accept(self, attempt):
        self.carried = "after"
        return attempt.state, None

    def return_to(self, carried):
        self.carried = carried


def moved(motion, converged=True):
    state, increment = object(), np.full(1, motion)
    return Attempt(converged, "no balance", state, increment, motion, 0.0, 1)


@pytest.mark.parametrize(
    ("corrections", "settles"),
    [
        ([(1e-3, True), (1e-6, True), (1e-12, True)], True),
        ([(1e-3, True), (1e-6, True), (0.0, False)], True),
        ([(0.0, False)], False),
        ([(1e-3, True), (0.0, False)], False),
        ([(1e-3, True), (2.0, True)], False),
        ([(1e-3, True)] * 40, False),
    ],
)
def test_a_step_is_taken_back_where_corrections_find_no_balance(corrections, settles):
    stepper, tried = PathState(), iter(corrections)
    attempt, *_ = settled(stepper, moved(1.0), lambda so_far: moved(*next(tried)))
    assert attempt.converged == settles
    assert stepper.carried == ("after" if settles else "before")
