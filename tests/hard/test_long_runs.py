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


@pytest.mark.parametrize(
    ("steps", "integrator"),
    [
        (1_000, "newmark"),
        (1_000, "generalized_alpha"),
        pytest.param(100_000, "newmark", marks=pytest.mark.slow),
    ],
)
def test_a_block_at_rest_does_not_creep_by_its_own_swing(steps, integrator):
    """Without damping it swings by its penetration, 1e-7 m, and goes nowhere."""
    case = Threshold(friction=40.0, duration=steps * 0.01)
    source = case.scene().replace(
        "[formulation.integrator]\n", f'[formulation.integrator]\ntype = "{integrator}"\n'
    )
    found = run(parse_scene(source))
    assert found.summary.status == "converged"
    slid = way(found, "toe") @ down(30.0)
    first, last = slid[100 : 100 + steps // 10], slid[-steps // 10 :]
    assert abs(last.mean() - first.mean()) < 1e-8
    assert np.ptp(slid[100:]) < 1e-7


@pytest.mark.parametrize(
    ("steps", "formulation"),
    [
        (2_000, "dda"),
        (2_000, "newmark"),
        pytest.param(100_000, "dda", marks=pytest.mark.slow),
        pytest.param(100_000, "newmark", marks=pytest.mark.slow),
    ],
)
def test_a_sliding_block_goes_the_way_of_its_friction(steps, formulation):
    """On the level at mu g: s = v t - mu g t^2 / 2, with steps so short that it slides to the end.

    Penetration and angle stay those of the first steps; 1e-3 of the way is the stretch of shear
    springs and the load put on at once, both of them once.
    """
    step = 1e-5
    time, speed = steps * step, 5.0
    base = text.block("base", "rock", text.rectangle((-2, -1), (8, 0)))
    scene = parse_scene(
        text.scene(
            f'plane = "strain"\nduration = {time!r}\n[gravity]\n[inertia]\n[contact]\n'
            f"[formulation.integrator]\nstep = {step!r}\n",
            [
                text.material("rock", modulus=1e9),
                text.interface("contact", 20.0),
                base,
                text.held("base"),
                text.box("block", (0, 0), (1, 0.5)),
                f'[[initial_velocities]]\nblock = "block"\nvelocity = [{speed!r}, 0]\n',
                text.monitor("middle", (0.5, 0.25), "block"),
            ],
        )
    )
    found = run(scene, chosen(formulation, scene.formulation))
    assert found.summary.status == "converged", found.summary.sentence
    drag = text.G * np.tan(np.radians(20.0))
    expected = speed * time - drag * time**2 / 2
    assert last_way(found, "middle")[0] == pytest.approx(expected, rel=1e-3)
    assert rates(found)[1, 0] == pytest.approx(speed - drag * time, rel=1e-3)
    assert abs(last_way(found, "middle")[1]) < 1e-5
    assert abs(found.state.frames.angle[1]) < 1e-5
