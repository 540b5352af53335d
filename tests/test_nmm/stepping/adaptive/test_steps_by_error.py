"""Runs whose steps follow from their error: closed forms, impacts, frames, and what is refused."""

import numpy as np
import pytest
from scipy.special import ellipj, ellipk

import nmm
from nmm.errors import NmmError
from nmm.verification import text
from nmm.verification.problems.motion.time_integration import FREQUENCY, oscillator

CYCLES = 3.07
GRAVITY = 9.81


def auto(scene):
    """Put steps by error in the place of the step of a scene."""
    return nmm.run(nmm.parse_scene(scene, "scene"))


def oscillates(rule, error):
    """Largest error of an oscillator over its amplitude, a cycle; and the run."""
    scene = oscillator(rule, 1.0, CYCLES * 2 * np.pi / FREQUENCY)
    scene = scene.replace("step = 1.0", f'step = "auto"\nerror = {error}')
    rigid = '[formulation.cover]\nfunctions = "rigid"\n'
    run = auto(scene.replace("[formulation.integrator]", f"{rigid}[formulation.integrator]"))
    exact = np.sin(FREQUENCY * run.history["time"])
    off = run.history["monitor:middle:ux"] * FREQUENCY - exact
    return float(abs(off).max()) / CYCLES, run


@pytest.mark.parametrize(
    ("rule", "errors"),
    [("newmark", (0.03, 0.003)), ("generalized_alpha", (0.03, 0.003)), ("shi", (0.1, 0.03))],
)
def test_the_error_of_an_oscillator_is_a_share_of_what_is_asked_for(rule, errors):
    """`error` is what a cycle errs by, within a factor: 0.3 to 1.3 of it are measured."""
    found = [oscillates(rule, error)[0] / error for error in errors]
    assert all(0.25 < one < 1.5 for one in found), found


def test_steps_of_an_oscillator_are_counted_and_their_bounds_told():
    _, run = oscillates("newmark", 0.1)
    lengths, summary = np.diff(run.history["time"], prepend=0.0), run.summary
    assert summary.smallest_step == pytest.approx(lengths.min(), rel=1e-9)
    assert summary.largest_step == pytest.approx(lengths.max(), rel=1e-9)
    assert summary.steps == len(lengths)
    assert summary.rejected_steps is not None
    assert summary.status == "converged"


def test_fixed_steps_tell_no_bounds():
    scene = oscillator("newmark", 1e-4, 1e-3)
    assert auto(scene).summary.smallest_step is None


def pendulum(error, angle=np.pi / 2, half=0.5):
    """Scene of a square that swings about its corner from rest; the pull turns with ``angle``."""
    pull = [float(GRAVITY * one) for one in (np.sin(angle), -np.cos(angle))]
    return text.scene(
        'title = "pendulum"\nplane = "stress"\nduration = 2.0\n[inertia]\n'
        f"[gravity]\nacceleration = [{pull[0]!r}, {pull[1]!r}]\n"
        '[formulation.cover]\nfunctions = "rigid"\n[formulation.integrator]\n'
        f'type = "newmark"\nstep = "auto"\nerror = {error}\n',
        [
            text.material("stiff", modulus=1e9, density=2500.0),
            text.block("square", "stiff", text.rectangle((-half, -2 * half), (half, 0))),
            '[[supports]]\nname = "pin"\npoint = [0, 0]\nfix = ["x", "y"]\n',
            text.monitor("middle", (0, -half), "square"),
        ],
    )


def off_a_pendulum(run):
    """Largest error of the place of a pendulum's middle (m).

    ``sin(theta / 2) = k sn(K - w t)``, with ``I = m (a^2 / 6 + a^2 / 4)`` about a side's middle.
    """
    omega = np.sqrt(GRAVITY * 0.5 / (1 / 6 + 1 / 4))
    k = np.sin(np.pi / 4)
    time = run.history["time"]
    swing = 2 * np.arcsin(k * ellipj(ellipk(k**2) - omega * time, k**2)[0])
    # The pull has the angle pi / 2 with the pendulum, which turns towards it.
    turned = np.pi / 2 - swing
    exact = 0.5 * np.stack([np.sin(turned), 1 - np.cos(turned)], axis=1)
    found = np.stack([run.history[f"monitor:middle:u{axis}"] for axis in "xy"], axis=1)
    return float(abs(found - exact).max())


def test_a_pendulum_of_large_swings_follows_the_elliptic_function():
    """Steps of bodies that turn are of order 1: errors fall by less than the tolerance does."""
    coarse, fine = (off_a_pendulum(auto(pendulum(error))) for error in (0.1, 0.01))
    assert fine < 0.03
    assert coarse < 0.1


def test_a_block_that_spins_freely_takes_few_steps_and_keeps_its_spin():
    scene = text.scene(
        'title = "spin"\nplane = "stress"\nduration = 1.0\n[inertia]\n[formulation.cover]\n'
        'functions = "rigid"\n[formulation.integrator]\ntype = "newmark"\nstep = "auto"\n',
        [
            text.material("stiff", modulus=1e9, density=2500.0),
            text.block("square", "stiff", text.rectangle((-0.5, -0.5), (0.5, 0.5))),
            '[[initial_velocities]]\nblock = "square"\nangular_velocity = 2.0\n',
            text.monitor("corner", (0.5, 0.0), "square"),
        ],
    )
    run = auto(scene)
    found = [run.history[f"monitor:corner:u{axis}"][-1] for axis in "xy"]
    exact = 0.5 * np.array([np.cos(2.0) - 1, np.sin(2.0)])
    assert found == pytest.approx(exact, abs=1e-9)
    assert run.summary.steps < 150


def bouncing(rule, height=0.5, duration=0.8, extra=""):
    """Scene of a rigid block that falls on another one and springs back."""
    return text.scene(
        f'title = "bounce"\nplane = "strain"\nduration = {duration}\n[inertia]\n[gravity]\n'
        '[contact]\n[formulation.cover]\nfunctions = "rigid"\n[formulation.integrator]\n'
        f'type = "newmark"\n{rule}\n{extra}',
        [
            text.material("stiff", modulus=1e9, density=2500.0),
            '[interfaces.smooth]\nbetween = ["stiff", "stiff"]\nfriction_angle = 0\n',
            text.block("ground", "stiff", text.rectangle((-2, -1), (2, 0))),
            text.block("ball", "stiff", text.rectangle((-0.5, height), (0.5, height + 1))),
            '[[supports]]\nname = "base"\nsegment = [[-2, -1], [2, -1]]\nfix = ["x", "y"]\n',
            text.monitor("top", (0, height + 0.5), "ball"),
        ],
    )


def lost(run, height=0.5):
    """Share of the height that the first rebound misses."""
    time, rise = run.history["time"], run.history["monitor:top:uy"]
    return -rise[time > np.sqrt(2 * height / GRAVITY)].max() / height


@pytest.fixture(scope="module")
def bounce():
    """A fall, an impact, and the way back up."""
    return auto(bouncing('step = "auto"\nerror = 0.01'))


def test_an_impact_is_resolved_by_short_steps_there_alone(bounce):
    time = bounce.history["time"]
    lengths, falls = np.diff(time, prepend=0.0), np.sqrt(2 * 0.5 / GRAVITY)
    short = lengths < 0.02 * lengths.max()
    # The spring holds the block for 1.3 ms; the first steps of the run are short as well.
    assert (abs(time[short & (time > 0.01)] - falls) < 0.02).all()
    assert abs(lost(bounce)) < 0.01


def test_an_impact_costs_less_than_with_fixed_steps_of_a_larger_error(bounce):
    """A thousand fixed steps a second, which the impact lasts for, lose half of the height.

    A step by error is one and a half solutions, a rejected one at most three.
    """
    fixed = auto(bouncing("step = 1e-3"))
    assert abs(lost(bounce)) < 0.02 * abs(lost(fixed))
    solved = bounce.summary.steps * 1.5 + 3 * bounce.summary.rejected_steps
    assert solved < fixed.summary.steps


def test_frames_stand_at_the_times_that_are_asked_for():
    output = "[output]\nevery_time = 0.07\n"
    scene = bouncing('step = "auto"\nerror = 0.1', duration=0.5, extra=output)
    times = [frame.time for frame in auto(scene).frames]
    assert times == pytest.approx([*np.arange(0, 0.5, 0.07), 0.5], abs=1e-12)


def test_steps_that_are_to_be_no_shorter_are_told():
    run = auto(bouncing('step = "auto"\nerror = 0.01\nshortest = "2 ms"', duration=0.5))
    assert any("shortest length" in warning for warning in run.summary.warnings)


def faults_of(rule, scene=None):
    """Return what is said of a rule."""
    with pytest.raises(NmmError) as caught:
        auto((scene or bouncing)(rule))
    return str(caught.value)


@pytest.mark.parametrize(
    ("rule", "line"),
    [
        ('step = "fast"', "integrator.step"),
        ("step = 0", "integrator.step"),
        ('step = "auto"\nerror = 0', "integrator.error"),
        ('step = "auto"\nerror = 0.5', "integrator.error"),
        ('step = "auto"\nerror_of = "blocks"', "integrator.error_of"),
        ("step = 1e-3\nerror = 0.01", "integrator"),
        ('step = "auto"\nshortest = 1.0\nlongest = 0.1', "integrator"),
        ('step = "auto"\nkinetic_factor = 0.9', "integrator.step"),
        ('step = "auto"\n[formulation.rotation]\nupdate = "linear"', "integrator.step"),
    ],
)
def test_what_steps_cannot_be_chosen_by_is_refused_by_line(rule, line):
    said = faults_of(rule)
    assert line in said
    assert "scene:" in said


def test_explicit_steps_are_bounded_by_stability_and_refused():
    scene = oscillator("central_differences", 1.0, 1e-2).replace("step = 1.0", 'step = "auto"')
    with pytest.raises(NmmError, match="stability"):
        auto(scene)
