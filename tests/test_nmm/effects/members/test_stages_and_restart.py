"""Members through stages, checkpoints, run folders and pictures."""

import numpy as np
import pytest

import nmm
from nmm import plots
from nmm.errors import NmmError
from nmm.quantity import MemberSegments
from nmm.results.viewing.paraview import write_paraview
from nmm.testing.resumed.stopping import check_goes_on

PULLED = """
plane = "stress"
[materials.rock]
young_modulus = "30 GPa"
poisson_ratio = 0.0
density = 2500
[[blocks]]
name = "host"
material = "rock"
vertices = [[0, -0.1], [0.5, -0.1], [0.5, 0.1], [0, 0.1]]
[[blocks]]
name = "load"
material = "rock"
vertices = [[0.5, -0.1], [1, -0.1], [1, 0.1], [0.5, 0.1]]
[[bars]]
name = "bar"
points = [[0, 0], [0.5, 0]]
blocks = ["host", "load"]
diameter = "16 mm"
young_modulus = "200 GPa"
yield_stress = "200 MPa"
ends = ["free", "fixed"]
[bars.bond]
law = "bilinear"
strength = "8 MPa"
slips = ["0.1 mm", "1 mm"]
[[dashpots]]
name = "buffer"
points = [[0, 0], [1, 0]]
viscosity = "5 kN s/m"
[[supports]]
name = "wall"
block = "host"
segment = [[0, -0.1], [0, 0.1]]
fix = ["x", "y"]
[[initial_velocities]]
block = "load"
velocity = [1.5, 0.2]
[inertia]
[formulation.integrator]
type = "newmark"
step = "0.1 ms"
[formulation.bars]
pieces = 10
[output]
every_steps = 2
"""
HEAD = 'duration = "1.6 ms"\n'


def test_a_run_with_bond_that_slides_goes_on_from_a_checkpoint_bit_by_bit(tmp_path):
    text = HEAD + PULLED + "checkpoint = { every_steps = 4 }\n"
    whole = check_goes_on(nmm.parse_scene(text), tmp_path, 6)
    assert whole.summary.status == "converged", whole.summary.sentence
    assert whole.history["loss:bars"][-1] > 0


def test_members_are_in_frames_run_folders_paraview_and_pictures(tmp_path):
    run = nmm.run(nmm.parse_scene(HEAD + PULLED), out=tmp_path / "run")
    stored = nmm.read_run(tmp_path / "run")
    for frame, again in zip(run.frames, stored.frames, strict=True):
        known, ends = frame.on("members"), MemberSegments.ENDS
        assert len(known[ends].values) == 10 + 1  # links between pieces and to the end; the dashpot
        for name, one in known.items():
            assert np.array_equal(one.values, again.on("members")[name].values)
    last = run.frames[-1].on("members")
    largest = np.abs(last["members:force"].values[last["members:number"].values == 1]).max()
    assert largest == pytest.approx(abs(run.history["bars:bar:force"][-1]))
    written = write_paraview(run, tmp_path / "paraview")
    assert [path.name for path in written] == ["blocks.pvd", "members.pvd"]
    assert "force" in (tmp_path / "paraview/members_000001.vtu").read_text()
    plots.members(run, path=tmp_path / "members.png")
    assert (tmp_path / "members.png").stat().st_size > 5000


STAGED = """
plane = "strain"
[materials.rock]
young_modulus = "1 GPa"
poisson_ratio = 0.0
density = 2000
[[blocks]]
name = "column"
material = "rock"
vertices = [[0, 0], [1, 0], [1, 4], [0, 4]]
[[blocks]]
name = "tower"
material = "rock"
vertices = [[2, 0], [3, 0], [3, 4], [2, 4]]
[[supports]]
name = "floor"
segment = [[0, 0], [3, 0]]
fix = ["x", "y"]
[[loads]]
name = "first"
kind = "edge"
segment = [[0, 4], [1, 4]]
traction = [0, "-1 MPa"]
[[loads]]
name = "second"
kind = "edge"
segment = [[0, 4], [1, 4]]
traction = [0, "-1 MPa"]
[[springs]]
name = "prop"
points = [[0.5, 0], [0.5, 4]]
blocks = ["ground", "column"]
stiffness = "250 MN/m"
[[springs]]
name = "tie"
points = [[1, 4], [2, 4]]
stiffness = "1 MN/m"
[[stages]]
name = "load"
loads = ["first"]
members = []
[[stages]]
name = "propped"
loads = ["first", "second"]
members = ["prop"]
"""


def test_a_spring_put_in_after_a_load_carries_of_later_loads_alone():
    found = nmm.run(nmm.parse_scene(STAGED))
    assert found.summary.status == "converged", found.summary.sentence
    # Column and prop are of 250 MN/m each: 4 mm before, half of the second load goes to each.
    assert found.history["springs:prop:force"][-1] == pytest.approx(-0.5e6, rel=2e-3)


def test_a_member_whose_block_leaves_is_told_by_line_and_name_before_anything_runs():
    text = STAGED + 'remove = ["tower"]\n'
    text = text.replace('members = ["prop"]', 'members = ["prop", "tie"]')
    with pytest.raises(NmmError, match=r'"tie": no block at \[2, 4\]') as caught:
        nmm.run(nmm.parse_scene(text))
    assert str(caught.value).startswith("scene:34: springs.1")
    assert "leave the member out of the stage" in str(caught.value)


def test_a_member_that_a_stage_leaves_out_is_gone():
    text = STAGED + '[[stages]]\nname = "after"\nmembers = []\n'
    found = nmm.run(nmm.parse_scene(text))
    assert found.summary.status == "converged", found.summary.sentence
    assert np.isnan(found.history["springs:prop:force"][-1])


AGAIN = """
[[stages]]
name = "propped"
[[stages]]
name = "without"
members = []
[[stages]]
name = "again"
members = ["prop"]
"""
BOLTED = """
[[bars]]
name = "prop"
points = [[0.5, 1], [0.5, 3]]
diameter = "32 mm"
young_modulus = "200 GPa"
[bars.bond]
law = "plastic"
stiffness = "10 GPa/m"
strength = "20 kPa"
"""


@pytest.mark.parametrize("bolted", [False, True], ids=["yields", "slides"])
def test_a_member_that_is_put_in_again_knows_nothing_of_its_yielding_before(bolted):
    whole, stages = STAGED.split('[[springs]]\nname = "tie"')[0], AGAIN
    whole = whole.replace('"250 MN/m"\n', '"250 MN/m"\nyield_force = "100 kN"\n')
    whole = whole.split("[[springs]]")[0] + BOLTED if bolted else whole
    found = nmm.run(nmm.parse_scene(whole + stages))
    assert found.summary.status == "converged", found.summary.sentence
    forces = found.history["bars:prop:force" if bolted else "springs:prop:force"]
    # A meter of bond from either end to the middle; from there on no load changes.
    most = 1.0 * np.pi * 0.032 * 2e4 if bolted else 1e5
    assert forces[0] == pytest.approx(-most, rel=0.02)  # pieces of 50 mm
    assert forces[-1] == pytest.approx(0.0, abs=1e-6 * most)
