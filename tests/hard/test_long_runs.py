"""Ten thousand steps, and a hundred thousand, leave what should stay where it was."""

import numpy as np
import pytest

from nmm.scene import parse_scene
from nmm.stepping.run import run
from nmm.verification import text
from nmm.verification.formulations import chosen
from nmm.verification.problems.incline import Threshold, down
from nmm.verification.problems.rotation import spinning
from nmm.verification.reading import last_way, rates, way

OMEGA = 2 * np.pi * 0.37


def flight(steps, formulation):
    """A rectangle that flies and turns for so many steps of 10 ms."""
    velocity = f"velocity = [3, 4]\nangular_velocity = {OMEGA!r}"
    shape = text.rectangle((-1, -0.5), (1, 0.5))
    scene = parse_scene(spinning(steps * 0.01, 0.01, velocity, shape=shape))
    return run(scene, chosen(formulation, scene.formulation))


@pytest.mark.parametrize(
    ("steps", "formulation"),
    [
        (10_000, "dda"),
        (10_000, "degree 2"),
        (10_000, "newmark"),
        pytest.param(100_000, "dda", marks=pytest.mark.slow),
    ],
)
def test_a_body_in_free_flight_neither_drifts_nor_gains(steps, formulation):
    found = flight(steps, formulation)
    time = steps * 0.01
    # Rounding of 1e-16 a step in rates of 5, summed without sign: 1e-9 in 1e5 steps.
    assert rates(found)[0] == pytest.approx([3, 4, OMEGA], abs=1e-13 * steps)
    assert last_way(found, "middle") == pytest.approx([3 * time, 4 * time], rel=1e-10)
    assert found.state.frames.angle[0] == pytest.approx(OMEGA * time, rel=1e-9)
    kinetic = found.history["kinetic_energy"]
    assert kinetic[-1] <= kinetic[0] * (1 + 1e-14 * steps)
    # 37 turns in a hundred seconds: the long side lies along x again; rho omega^2 a^2 / 12. Shi's
    # rule hardly damps a sawtooth of 4 / Omega^2, 1e-4, and Newmark's not even the breathing.
    centrifugal = 1000 * OMEGA**2 * np.array([4, 1]) / 12
    tolerance = 2.0 if formulation == "newmark" else 1e-4
    assert found.stress[0, :2] == pytest.approx(centrifugal, rel=tolerance)


@pytest.mark.slow
@pytest.mark.parametrize("steps", [10_000, 100_000])
def test_a_block_at_rest_on_a_slope_stays(steps):
    case = Threshold(friction=40.0, duration=steps * 0.01)
    found = case.run()
    assert found.summary.status == "converged"
    slid = way(found, "toe") @ down(30.0)
    # Its contacts are pressed by 9e-8 m; what it creeps after the first steps is far below that.
    assert np.ptp(slid[100:]) < 1e-9
    assert np.abs(rates(found)[1]).max() < 1e-5
    weight = 2600 * text.G * np.array([np.cos(np.pi / 6), np.sin(np.pi / 6)])
    assert -found.contact_forces.sum(axis=0) == pytest.approx(weight, rel=1e-3)


def test_a_block_at_rest_on_a_slope_stays_for_a_thousand_steps():
    found = Threshold(friction=40.0, duration=10.0).run()
    slid = way(found, "toe") @ down(30.0)
    assert np.ptp(slid[100:]) < 1e-9
