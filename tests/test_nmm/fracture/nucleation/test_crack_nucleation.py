"""Cracks that begin in a run: energies, further growth, resumption, what is seen and refused."""

from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.distance import pdist

import nmm
from nmm.errors import NmmError
from nmm.formulation import parse_formulation
from nmm.scene.model import Scene
from nmm.scene.read import parse_scene
from nmm.stepping.prepare import prepare
from nmm.stepping.run import Run
from nmm.testing.cracked_plates import turned_net
from nmm.testing.resumed.stopping import check_resumed, stopped_after
from nmm.verification import text
from nmm.verification.problems.cracks.nucleation import led

from .nucleating_scenes import body, plate

BAR = ((0.0, 0.0), (2.0, 0.5))
TENSION = ["1", "0", "0"]
STRONG = "tensile_strength = 3.0\nlength = 0.2\ncrack_length = 0.2"
FOLLOW = 'control = "toughness"\n'
NET = turned_net(0.1)
LOADS = "[loading]\nuntil = {until}\n"
STEPS = "[loading]\nincrement = 1.0\ntolerance = 1e-3\n"


def bar(rule: str = FOLLOW, nucleation: str = STRONG, more: str = "") -> Scene:
    return parse_scene(body([plate(BAR), *led(BAR, TENSION), more], rule, nucleation))


def run(scene: Scene, net: str = NET) -> Run:
    return nmm.run(scene, parse_formulation(net))


def test_the_energy_of_the_jump_is_booked_as_freed_by_fracture() -> None:
    # Half the load times the way it goes: the crack opens under the load that began it.
    found = run(bar("max_growth = 0.1\n", STRONG + "\nnumber = 1", LOADS.format(until=3.0)), NET)
    summary, history = found.summary, found.history
    assert history["load_factor"][-2:] == pytest.approx([3.0, 3.0], rel=1e-9)
    work, stored = np.array(history["external_work"]), np.array(history["strain_energy"])
    jump = work[-1] - work[-2]
    assert summary.freed_energy == pytest.approx(jump / 2, rel=1e-9)
    assert stored[-1] - stored[-2] == pytest.approx(jump / 2, rel=1e-9)
    assert summary.fracture_energy == pytest.approx(0.2 * (1 - 0.3**2), rel=1e-9)
    assert abs(summary.energy_balance or 0.0) < 1e-12
    # What an edge crack in a strip frees on its way (Gross 1964), K to 0.5 %.
    a = 0.2 * (np.arange(200) + 0.5) / 200
    s = a / 0.5
    shape = 1.122 - 0.231 * s + 10.55 * s**2 - 21.71 * s**3 + 30.382 * s**4
    energy = 0.2 * np.mean(9 * np.pi * a * shape**2) * (1 - 0.3**2)
    assert summary.freed_energy == pytest.approx(energy, rel=0.02)


@pytest.mark.parametrize("angle", [0.0, 0.3, 0.7])
def test_a_crack_of_one_cell_has_its_intensity(angle: float) -> None:
    rule = FOLLOW + "max_growth = 0.1\n"
    history = run(bar(rule, STRONG + "\nnumber = 1"), turned_net(0.2, angle)).history
    load = history["load_factor"][1]
    s = 0.2 / 0.5
    shape = 1.122 - 0.231 * s + 10.55 * s**2 - 21.71 * s**3 + 30.382 * s**4
    # At its toughness of 1 (Gross 1964, 0.5 %); measured 0.6 % and less.
    assert load * np.sqrt(0.2 * np.pi) * shape == pytest.approx(1.0, rel=0.012)


def test_both_controls_free_the_same_as_a_crack_begins() -> None:
    held = run(bar("max_growth = 0.1\n", STRONG + "\nnumber = 1", LOADS.format(until=3.0)))
    rule = FOLLOW + "max_growth = 0.1\n"
    followed = run(bar(rule, STRONG + "\nnumber = 1"))
    assert followed.summary.freed_energy == pytest.approx(held.summary.freed_energy, rel=1e-6)


def test_the_load_at_which_a_crack_begins_is_found_to_the_tolerance() -> None:
    scene = bar("max_growth = 0.1\n", STRONG + "\nnumber = 1", LOADS.format(until=3.3))
    history = run(scene, NET + STEPS.replace("1.0", "0.7")).history
    length = history["fracture:growth"]
    first = int(np.flatnonzero(np.array(length) > 0)[0])
    assert history["load_factor"][first - 1] == pytest.approx(3.0, rel=2e-3)
    assert history["load_factor"][first - 1] >= 3.0
    assert history["load_factor"][first] == history["load_factor"][first - 1]
    assert history["load_factor"][-1] == pytest.approx(3.3)


def test_a_crack_that_has_begun_grows_through_and_frees_a_piece() -> None:
    found = run(bar())
    assert "a piece came free" in found.summary.sentence
    assert found.summary.changes[0].startswith("at 3: a crack began at [")
    assert all("nucleus 1:end" in change for change in found.summary.changes[1:])
    share = np.array(found.history["fracture:nucleus 1:end:share"])[1:]
    assert share == pytest.approx(np.ones(len(share)), abs=1e-6)
    assert abs(found.summary.energy_balance or 0.0) < 1e-9


def test_a_notch_and_a_nucleus_are_fronts_of_one_scene() -> None:
    notch = '[[cracks]]\nname = "notch"\npoints = [[0.4, -0.1], [0.4, 0.12]]\n'
    weak = "tensile_strength = 1.0\nlength = 0.2\nnumber = 1"
    history = run(bar(FOLLOW + "max_growth = 0.01\n", weak, notch)).history
    assert history["fracture:nucleation:x"][0] > 0.8
    assert np.nanmax(history["fracture:notch:end:growth"]) == pytest.approx(0.1)
    assert np.nanmin(history["fracture:nucleus 1:end:growth"]) == pytest.approx(0.2)


def test_several_cracks_begin_away_from_each_other() -> None:
    weak = "tensile_strength = 3.0\nlength = 0.1\nnumber = 3"
    scene = bar("max_growth = 1e-3\n", weak, LOADS.format(until=5.0))
    found = run(scene, NET + STEPS)
    at = [change for change in found.summary.changes if "began" in change]
    assert len(at) == 3
    ends = [
        [found.history[f"fracture:nucleus {k}:start:{axis}"][-1] for axis in "xy"]
        for k in (1, 2, 3)
    ]
    # One and a half lengths from the whole of any other.
    assert pdist(ends).min() > 0.15


def test_a_run_that_is_stopped_goes_on_to_the_same_cracks(tmp_path: Path) -> None:
    rule = FOLLOW + "max_growth = 0.3\n"
    scene = bar(rule, STRONG + "\nnumber = 1", "[output]\ncheckpoint = { every_steps = 1 }\n")
    net, folder = parse_formulation(turned_net(0.15)), tmp_path / "half"
    whole = nmm.run(scene, net, out=tmp_path / "whole")
    for steps in (1, 2):
        half = stopped_after(scene, folder / str(steps), steps, net)
        check_resumed(whole, nmm.resume(half))


def test_a_crack_that_has_begun_is_in_frames_paraview_and_pictures(tmp_path: Path) -> None:
    from nmm import plots
    from nmm.plots.results.crack_paths import grown_paths
    from nmm.results.viewing.paraview import write_paraview

    found = nmm.run(bar(), parse_formulation(NET), out=tmp_path / "run")
    assert not len(found.frames[0].fields["fracture:faces"].values)
    faces = found.frames[1].fields["fracture:faces"].values
    frames = [frame.fields["fracture:tip"].values for frame in found.frames]
    assert [len(tips) for tips in frames[:3]] == [0, 0, 1] or len(frames[2]) == 1, faces
    stored = nmm.read_run(tmp_path / "run")
    files = {path.name for path in write_paraview(stored, tmp_path / "paraview")}
    assert {"blocks.pvd", "cracks.pvd", "tips.pvd"} <= files
    (points,) = grown_paths(found).values()
    assert points[0][1] == pytest.approx(0.2, abs=1e-3) or points[0][1] == pytest.approx(0.3)
    plots.crack_paths(found, path=tmp_path / "paths.png")
    assert (tmp_path / "paths.png").stat().st_size > 10_000


def test_far_from_the_origin_cracks_begin_alike() -> None:
    away = ((1e5, 2e5), (1e5 + 2, 2e5 + 0.5))
    tables = [plate(away), *led(away, TENSION)]
    found = run(parse_scene(body(tables, FOLLOW + "max_growth = 1e-3\n", STRONG + "\nnumber = 1")))
    assert found.history["load_factor"][0] == pytest.approx(3.0, rel=1e-6)
    assert found.history["fracture:nucleation:x"][0] == pytest.approx(1e5 + 1, abs=0.1)
    assert "a crack began at [100001, 200000" in found.summary.changes[0]


def test_a_length_that_no_block_holds_is_refused_with_its_line() -> None:
    scene = bar(nucleation="tensile_strength = 3.0\nlength = 4.0")
    with pytest.raises(NmmError, match=r"length.*4 m"):
        prepare(scene, parse_formulation(NET))
    # From a toughness that is too large for the strength too.
    with pytest.raises(NmmError, match="smaller length, or check toughness"):
        prepare(bar(nucleation="tensile_strength = 0.1"), parse_formulation(NET))


def test_stress_beyond_the_strength_that_no_line_can_open_is_told() -> None:
    # Lines of 0.6 fit along the bar, and none across it, where tension of 1 would open it at 0.5.
    deep = "tensile_strength = 0.5\nlength = 0.6"
    summary = run(bar("", deep, LOADS.format(until=1.0))).summary
    assert summary.audits["nucleation_length"] == pytest.approx(2, rel=1e-6)
    assert any("no crack could begin" in one for one in summary.warnings)


@pytest.mark.parametrize(
    "cover",
    [
        '[cover]\ntype = "block"\nfunctions = "rigid_strain"\n',
        '[cover]\ntype = "triangles"\nsize = 0.1\n[cover.enrichment]\ntips = false\n',
    ],
)
def test_covers_on_which_no_crack_begins_are_refused(cover: str) -> None:
    with pytest.raises(NmmError, match="whose tips carry functions"):
        prepare(bar(), parse_formulation(cover))


def test_cracks_that_begin_too_short_are_warned_of() -> None:
    assert "means over 0.2 m on cells of 0.25 m" in cautions(STRONG, 0.25)
    assert "from 0.637 m on as much" in cautions("tensile_strength = 1.0\nlength = 0.2", 0.15)
    assert not cautions(STRONG, 0.15)


def cautions(nucleation: str, size: float) -> str:
    """What is said against the growth of cracks before anything runs."""
    made = prepare(bar(nucleation=nucleation), parse_formulation(turned_net(size)))
    effect = made.stepper.plan.fracture
    assert effect is not None
    return effect.caution


def test_a_crack_begins_in_time_and_takes_what_its_faces_give() -> None:
    ends = [text.fixed_edge("left", ((0, 0.5), (0, 0)), "x")]
    pull = '[[loads]]\nname = "pull"\nkind = "edge"\nsegment = [[2, 0], [2, 0.5]]\n'
    pull += "traction = [0.033, 0]\nhistory = [[0, 0], [10, 1]]\n"
    pin = '[[supports]]\nname = "pin"\npoint = [0, 0]\nfix = ["y"]\n'
    weak = "tensile_strength = 0.03\nlength = 0.2\nnumber = 1"
    scene = body([plate(BAR), *ends, pin, pull, "[inertia]\n"], "max_growth = 0.01\n", weak, TEN)
    scene = scene.replace("toughness = 1.0", "toughness = 0.01")
    found = run(parse_scene(scene), turned_net(0.2) + MOVING)
    history, summary = found.history, found.summary
    # A force that grows evenly reaches the strength at 9.1 s; a wave takes two along the bar.
    time = float(summary.changes[0].split()[1].rstrip(":"))
    assert "a crack began" in summary.changes[0]
    assert time == pytest.approx(9.1, abs=0.5)
    # The tip is at twice its toughness at once: the faces take more than that of the growth.
    assert summary.fracture_energy == pytest.approx(2e-5 * 0.91, rel=1e-6)
    assert history["loss:fracture"][-1] > summary.fracture_energy
    assert abs(summary.energy_balance or 0.0) < 2e-3


TEN = "duration = 10.0\n"
MOVING = '[integrator]\ntype = "newmark"\nstep = 0.1\n'
