"""Transient water in joints: what comes in is stored, joints open by it, and faults by line."""

import numpy as np
import pytest

import nmm
from nmm.errors import SceneError
from nmm.testing import check_effect_of
from nmm.verification.problems.joint_water import PressureInJoint

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


def test_transient_water_in_joints_keeps_what_every_effect_promises():
    text = SHORT.scene().replace("increment = 0.025", "increment = 0.5")
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


def test_stages_are_refused_by_line():
    text = SHORT.scene() + '\n[[stages]]\nname = "one"\n'
    with pytest.raises(
        SceneError, match=r"scene:\d+: joint_flow.transient: .*steady in each stage"
    ):
        nmm.parse_scene(text, "scene")
