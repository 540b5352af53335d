"""An effect asks for another shape in mid-run: seams that open, in time and under loads."""

from pathlib import Path

import numpy as np
import pytest

import nmm
from nmm.errors import SceneError
from nmm.results.storage.stored_run import read_run
from nmm.results.viewing.paraview import write_paraview
from nmm.testing.resumed.killing import check_same_bytes
from nmm.testing.resumed.stopping import stopped_after

EXAMPLE = Path(__file__).parents[3] / "examples" / "own_effect" / "seam.toml"
SEAM = EXAMPLE.read_text()
BAR = """
title = "bar"
plane = "stress"
[materials.rock]
young_modulus = "1 GPa"
poisson_ratio = 0.2
[[blocks]]
name = "bar"
material = "rock"
vertices = [[0, 0], [2, 0], [2, 1], [0, 1]]
[[supports]]
name = "left"
segment = [[0, 0], [0, 1]]
fix = ["x", "y"]
[[loads]]
name = "pull"
kind = "edge"
segment = [[2, 0], [2, 1]]
traction = [1e6, 0]
[loading]
until = 1.0
[[monitors]]
name = "end"
point = [2, 0.5]
[formulation.cover]
type = "triangles"
size = 0.3
degree = 1
[formulation.loading]
increment = 0.25
"""
CRACK = """
[effects.seam]
type = "seam:Seam"
at = {at}
points = [[1, -0.1], [1, {end}]]
"""


@pytest.fixture(scope="module", autouse=True)
def seam_on_the_path():
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(EXAMPLE.parent)
        yield


def run(text, **more):
    return nmm.run(nmm.parse_scene(text, "scene"), allow_code=["seam"], **more)


@pytest.fixture(scope="module")
def parted():
    return run(SEAM)


def test_what_a_seam_cuts_off_is_a_body_the_next_instant(parted):
    assert parted.summary.status == "converged", parted.summary.sentence
    assert parted.manifold.n_bodies == 2
    assert parted.summary.changes == ["at 0.01: a seam opened"]
    assert [frame.topology for frame in parted.frames] == [0] * 6 + [1] * 5


def test_two_bodies_fly_apart_as_the_points_of_the_whole_one_would(parted):
    """Rigid-body mechanics: each half keeps the velocity of its own centroid, and the spin."""
    model, state = parted.stepper.model, parted.state
    momentum = (model.manifold.rigid_modes.T @ (model.mass @ state.velocity)).reshape(-1, 3)
    push = state.frames.to_global(np.arange(2), momentum[:, :2])
    # 4000 kg at (3, 1) m/s; waves of the stress of turning are cut loose: 1e-9 of it.
    np.testing.assert_allclose(push.sum(axis=0), [12000, 4000], rtol=1e-9)
    assert abs(parted.summary.energy_balance) < 1e-5
    assert parted.summary.audits["momentum"] < 1e-12


def test_a_run_with_events_is_stored_and_read_again(parted, tmp_path):
    done = run(SEAM, out=tmp_path / "run")
    stored = read_run(tmp_path / "run")
    assert [len(one.elements) for one in stored.topologies] == [
        len(one.elements) for one in parted.topologies
    ]
    assert stored.summary.changes == done.summary.changes
    np.testing.assert_array_equal(stored.history["change_energy"], done.history["change_energy"])
    write_paraview(stored, tmp_path / "view")
    assert len(list((tmp_path / "view").glob("blocks*.vtu"))) == len(done.frames)


@pytest.mark.parametrize("steps", [6, 15])
def test_two_halves_are_the_whole_before_and_after_an_event(steps, tmp_path):
    asked = 'every_time = "2 ms"'
    kept = SEAM.replace(asked, asked + "\ncheckpoint = { every_steps = 4 }")
    whole = run(kept, out=tmp_path / "whole")
    scene, trust = nmm.parse_scene(kept, "scene"), ["seam"]
    folder = stopped_after(scene, tmp_path / "half", steps, allow_code=trust)
    half = nmm.resume(folder, allow_code=trust)
    check_same_bytes(whole, half, (tmp_path / "whole", folder))


def test_a_cracked_bar_comes_to_where_one_cracked_from_the_start_comes():
    """A linear body has one answer to its loads, whenever the crack came."""
    late = run(BAR + CRACK.format(at=0.5, end=0.6))
    table = '\n[[cracks]]\nname = "notch"\npoints = [[1, -0.1], [1, 0.6]]\n'
    early = run(BAR.replace("[loading]", table + "[loading]"))
    assert late.summary.status == "converged", late.summary.sentence
    ends = [one.history["monitor:end:ux"] for one in (late, early)]
    assert ends[0][-1] == pytest.approx(ends[1][-1], rel=1e-9)
    # The same load twice: before the crack and with it, found to 0.5 % of the load.
    factors = late.history["load_factor"]
    again = int(np.flatnonzero(np.diff(factors) == 0)[0])
    assert factors[again] == pytest.approx(0.5, rel=5e-3)
    before, after = ends[0][again] / factors[again], ends[0][again + 1] / factors[again]
    assert after == pytest.approx(ends[1][-1], rel=1e-9)
    assert before < 0.9 * after


def test_a_bar_that_is_cut_through_fails_at_the_load_of_the_cut():
    until = BAR.replace("until = 1.0", 'until = "failure"')
    done = run(until + CRACK.format(at=0.6, end=1.1))
    assert done.summary.status == "failure_load", done.summary.sentence
    assert done.summary.failure_factor == pytest.approx(0.6, rel=5e-3)
    assert "after a seam opened" in done.summary.sentence


def test_a_seam_that_opened_in_a_stage_stays_open_in_the_next_one():
    text = SEAM.replace('duration = "20 ms"\n', "", 1)
    text += '[[stages]]\nname = "first"\nduration = "15 ms"\n'
    done = run(text + '[[stages]]\nname = "second"\nduration = "5 ms"\n')
    assert done.summary.status == "converged", done.summary.sentence
    assert done.manifold.n_bodies == 2
    assert [one for one in done.summary.changes if "seam" in one] == ["at 0.01: a seam opened"]
    model, state = done.stepper.model, done.state
    momentum = (model.manifold.rigid_modes.T @ (model.mass @ state.velocity)).reshape(-1, 3)
    push = state.frames.to_global(np.arange(2), momentum[:, :2])
    # As without stages: 4000 kg at (3, 1) m/s.
    np.testing.assert_allclose(push.sum(axis=0), [12000, 4000], rtol=1e-9)


def test_a_control_that_would_overlook_an_event_is_refused_by_line():
    control = '{ type = "displacement", monitors = ["end"], increment = 1e-4, end = 1e-3 }'
    text = BAR.replace("until = 1.0", f'until = "failure"\ncontrol = {control}')
    text = text.replace("[loading]", "[contact]\n[interfaces.any]\nfriction_angle = 0.5\n[loading]")
    with pytest.raises(SceneError, match=r"scene:\d+: loading.control.*effects.seam"):
        run(text + CRACK.format(at=0.5, end=0.6))
