"""Cracks that grow in time: how fast, what that takes, and pieces that come free."""

from pathlib import Path

import numpy as np
import pytest

import nmm
from integration.arrays import Floats
from nmm.assembly.state import State
from nmm.effects.base import Instant
from nmm.errors import NmmError
from nmm.formulation import Formulation, parse_formulation
from nmm.fracture.growth.motion.running import RunningTips
from nmm.fracture.growth.motion.speed import freund, rayleigh_part
from nmm.scene.model import Scene
from nmm.scene.read import parse_scene
from nmm.stepping.run import Run
from nmm.testing.resumed.stopping import check_resumed, stopped_after

HANGING = """
plane = "strain"
duration = {duration}
[materials.m]
young_modulus = 10e6
poisson_ratio = 0.3
density = 1000
[[blocks]]
name = "plate"
material = "m"
vertices = [[0, -0.5], [1, -0.5], [1, 0.5], [0, 0.5]]
[[cracks]]
name = "notch"
points = [[-0.1, 0.0], [0.6, 0.0]]
[[supports]]
name = "ceiling"
segment = [[1, 0.5], [0, 0.5]]
fix = ["x", "y"]
[gravity]
[inertia]
[fracture]
criterion = "straight_ahead"
toughness = 2000.0
increment = 0.15
{more}
"""
NET = """
[cover]
type = "triangles"
size = 0.25
angle = 0.3
shift = [0.13, 0.27]
degree = 1
[integrator]
type = "newmark"
step = 0.001
[supports]
method = "nitsche"
"""


def hanging(duration: float = 0.03, more: str = "") -> Scene:
    return parse_scene(HANGING.format(duration=duration, more=more))


def net() -> Formulation:
    return parse_formulation(NET)


@pytest.mark.parametrize(
    ("nu", "expected"),
    # Viktorov (1967): the root of Rayleigh's equation.
    [(0.0, 0.8740320), (0.25, 0.9194017), (0.5, 0.9553127)],
)
def test_the_speed_of_rayleighs_wave(nu: float, expected: float) -> None:
    assert rayleigh_part(3 - 4 * nu) == pytest.approx(expected, abs=1e-6)


def test_a_tip_runs_where_what_comes_in_is_what_growth_takes() -> None:
    share = np.array([0.5, 1.0, 1.5, 3.0])
    speed = freund(share)
    assert speed[:2] == pytest.approx([0.0, 0.0])
    # G (1 - v / c_R) = G_c, G of the tip at rest.
    assert share[2:] ** 2 * (1 - speed[2:]) == pytest.approx([1.0, 1.0])


def test_a_tip_takes_the_time_that_its_speed_says_for_every_piece() -> None:
    """At a constant speed: half of it until the piece is cut, half until it is through."""
    tip, step, cut = RunningTips.begun(1, 0.0), 0.01, []
    for number in range(1, 400):
        tip = tip.advanced(number * step, np.array([2.0]))
        if tip.way[0] >= 0.5:
            tip, span = tip.cut(np.array([0]), np.array([1.0]))
            assert 0 < span[0] <= 0.25 + 1e-12
            cut.append(number * step)
    # Pieces of 1 m at 2 m/s; the first step knows no speed at its start.
    assert np.diff(cut) == pytest.approx(0.5, abs=1.5 * step)
    assert (cut[-1] - cut[0]) / (len(cut) - 1) == pytest.approx(0.5, abs=1e-3)


@pytest.fixture(scope="module")
def fallen() -> Run:
    """The run in which the block comes free."""
    return nmm.run(hanging(), net())


def mean_motion(run: Run, state: State) -> tuple[Floats, Floats]:
    """Way (2,) of the lowest body's centroid, and its velocity in global axes."""
    low = int(np.argmin(run.manifold.body_centroid[:, 1]))
    rates = np.asarray(run.stepper.model.rigid_projection @ state.velocity).reshape(-1, 3)
    frames = state.frames
    assert frames.way is not None
    return frames.way[low], frames.to_global(np.array([low]), rates[[low], :2])[0]


def test_a_block_that_its_crack_cuts_off_falls_as_a_free_body(fallen: Run) -> None:
    assert fallen.summary.status == "converged"
    assert fallen.manifold.n_bodies == 2
    state, step, number = fallen.state, 1e-3, 20
    place, velocity = mean_motion(fallen, state)
    for _ in range(number):
        end = Instant(state.time + step, 1.0)
        state, _ = fallen.stepper.accept(fallen.stepper.attempt(state, end, step))
    found, faster = mean_motion(fallen, state)
    time, weight = number * step, np.array([0.0, -9.81])
    assert found == pytest.approx(place + velocity * time + weight * time**2 / 2, abs=1e-12)
    assert faster == pytest.approx(velocity + weight * time, abs=1e-10)
    # The ligament has held it before.
    assert -place[1] < 9.81 * 0.03**2 / 2


def test_energy_of_growth_in_time_is_told_to_the_last_part(fallen: Run) -> None:
    run, history = fallen, fallen.history
    taken = history["loss:fracture"]
    assert (np.diff(taken) >= -1e-12).all()
    assert taken[-1] > history["fracture:energy"][-1] > 0
    assert abs(run.summary.energy_balance or 0.0) < 1e-3
    # No faster than Rayleigh's wave, in any piece.
    grown, time = history["fracture:growth"], history["time"]
    bound = 0.9274 * np.sqrt(10e6 / 2.6 / 1000)
    begin, end = np.flatnonzero(np.diff(grown) > 0)[[0, -1]]
    assert grown[end] - grown[begin] <= bound * (time[end] - time[begin]) * (1 + 1e-9)


@pytest.mark.parametrize("integrator", ["newmark", "shi"])
def test_what_an_integrator_damps_is_not_freed_by_cracks(integrator: str) -> None:
    run = nmm.run(hanging(), parse_formulation(NET.replace("newmark", integrator)))
    history, lost = run.history, run.history["integration_loss"][-1]
    # What opening faces gave up, and what functions about grown tips took as they were laid anew.
    went = history["loss:fracture"][-1] - history["change_energy"][-1]
    assert (lost > 0.2 * went) == (integrator == "shi")
    assert run.summary.freed_energy == pytest.approx(went, rel=0.02)


def test_a_run_in_time_that_is_stopped_goes_on_to_the_same_bytes(tmp_path: Path) -> None:
    scene = hanging(0.015, "[output]\ncheckpoint = { every_steps = 1 }\n")
    whole, folder = nmm.run(scene, net(), out=tmp_path / "whole"), tmp_path / "half"
    steps = int(np.flatnonzero(whole.history["fracture:growth"] > 0)[0]) + 1
    check_resumed(whole, nmm.resume(stopped_after(scene, folder, steps, net())))


def test_a_speed_without_motion_is_refused() -> None:
    text = HANGING.format(duration=1.0, more='speed = "freund"')
    with pytest.raises(NmmError, match="speed"):
        parse_scene(text.replace("[inertia]", "").replace("duration = 1.0", ""))


def test_momentum_of_a_plate_that_is_torn_apart_stays_zero() -> None:
    """Pulled evenly at both ends, held by nothing: what one half gains the other has too."""
    text = HANGING.format(duration=0.02, more="")
    head, _, rest = text.partition("[[supports]]")
    pulls = "".join(
        f'[[loads]]\nname = "{name}"\nkind = "edge"\nsegment = [[{one}, {y}], [{other}, {y}]]\n'
        f"traction = [0, {pull}]\n"
        for name, y, one, other, pull in (
            ("up", 0.5, 1, 0, 4e3),
            ("down", -0.5, 0, 1, -4e3),
        )
    )
    scene = parse_scene(head + pulls + rest[rest.index("[inertia]") :])
    run = nmm.run(scene, net())
    model = run.stepper.model
    assert model.manifold.n_bodies == 2
    assert not [warning for warning in run.summary.warnings if "momentum" in warning]
    modes, bodies = model.manifold.rigid_modes, np.arange(2)
    parts = np.asarray(modes.T @ (model.mass @ run.state.velocity)).reshape(-1, 3)[:, :2]
    parts = run.state.frames.to_global(bodies, parts)
    # Each half has been given 4 kN for 20 ms, less what the ligament held.
    assert np.abs(parts).max() > 10.0
    assert np.abs(parts.sum(axis=0)).max() < 1e-11 * np.abs(parts).max()


PULLED = """
plane = "strain"
duration = 0.02
[inertia]
[materials.m]
young_modulus = 3e8
poisson_ratio = 0.2
density = 2000
[[blocks]]
name = "plate"
material = "m"
vertices = [[0, 0], [1.958, 0], [1.958, 1.2966], [0, 1.2966]]
[[cracks]]
name = "notch"
points = [[2.15, 0.6483], [0.783, 0.6483]]
[[supports]]
name = "floor"
segment = [[0, 0], [1.958, 0]]
fix = ["x", "y"]
[[loads]]
name = "pull"
kind = "edge"
segment = [[0, 1.2966], [1.958, 1.2966]]
traction = [0, 1e5]
[fracture]
criterion = "straight_ahead"
energy = 4.0
increment = 0.13
max_growth = 0.26
"""


@pytest.mark.parametrize(("size", "told"), [(0.54, True), (0.12, False)])
def test_functions_of_tips_that_reach_stiff_supports_are_told_by_the_energy_they_bring(size, told):
    net = f'[cover]\ntype = "triangles"\nsize = {size}\ndegree = 1\n'
    run = nmm.run(parse_scene(PULLED), parse_formulation(net + "[integrator]\nstep = 0.01\n"))
    assert run.history["fracture:growth"][-1] > 0.1
    share = abs(run.summary.audits["growth_projection"])
    assert (share > 0.02) == told
    assert any("growth_projection" in warning for warning in run.summary.warnings) == told
