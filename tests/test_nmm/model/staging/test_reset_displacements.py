"""Displacements that count from the start of a stage that asks for it."""

import pytest

import nmm
from nmm.testing.resumed.stopping import check_goes_on

COLUMN = """
plane = "strain"
{head}
[materials.soil]
young_modulus = "20 MPa"
poisson_ratio = 0.0
density = 2000
[[blocks]]
name = "soil"
material = "soil"
vertices = [[0, 0], [2, 0], [2, 4], [0, 4]]
[[blocks]]
name = "lift"
material = "soil"
vertices = [[0, 4], [2, 4], [2, 6], [0, 6]]
[interfaces.any]
friction_angle = 0.5
bonded = true
[gravity]
acceleration = [0, -10]
[[supports]]
name = "floor"
segment = [[0, 0], [2, 0]]
fix = ["x", "y"]
[[loads]]
name = "fill"
kind = "edge"
segment = [[0, 6], [2, 6]]
traction = [0, -10e3]
[[monitors]]
name = "middle"
point = [1, 4]
block = "soil"
[[monitors]]
name = "top"
point = [1, 6]
block = "lift"
[[stages]]
name = "in place"
blocks = ["soil"]
loads = []
[[stages]]
name = "lift"
add = ["lift"]
{reset}
[[stages]]
name = "fill"
loads = ["fill"]
{cover}
[formulation.cover]
type = "quads"
size = 1.0
degree = 1
[formulation.supports]
method = "lagrange"
{more}
"""
# Settlements in closed form: gamma (h y - y^2 / 2) / E of the weight, q y / E of what is above.
OF_WEIGHT = 20e3 * 4**2 / 2 / 20e6
OF_LIFT = 40e3 * 4 / 20e6
OF_LIFT_ITSELF = 20e3 * 2**2 / 2 / 20e6
FILL = 10e3 / 20e6


def column(reset="", cover="", head="", more=""):
    text = COLUMN.format(reset=reset, cover=cover, head=head, more=more)
    return nmm.parse_scene(text)


@pytest.mark.parametrize("cover", ["", "cover = { size = 0.7 }", "cover = { degree = 2 }"])
@pytest.mark.parametrize("reset", ["", "reset_displacements = true"])
def test_settlements_are_those_since_the_stage_that_asks(reset, cover):
    run = nmm.run(column(reset, cover))
    assert run.summary.status == "converged", run.summary.sentence
    before = 0.0 if reset else OF_WEIGHT
    expected = [OF_WEIGHT, before + OF_LIFT, before + OF_LIFT + 4 * FILL]
    middle = -run.history["monitor:middle:uy"]
    assert middle == pytest.approx(expected, rel=1e-9)
    # What arrives counts from where it is put: the lift sinks with the ground, and by its own.
    top = -run.history["monitor:top:uy"]
    assert top[-1] == pytest.approx(OF_LIFT + OF_LIFT_ITSELF + 6 * FILL, rel=1e-9)


def test_frames_count_as_monitors_do():
    run = nmm.run(column("reset_displacements = true", "cover = { size = 0.7 }"))
    last = run.frames[-1]
    start = last.points - last.displacement
    soil = last.points[:, 1] < 3.9
    way = OF_LIFT / 4 + FILL
    assert -last.displacement[soil, 1] == pytest.approx(way * start[soil, 1], rel=1e-2, abs=1e-9)
    assert -last.displacement[:, 1].min() == pytest.approx(
        OF_LIFT + OF_LIFT_ITSELF + 6 * FILL, rel=1e-9
    )


def test_a_run_that_is_stopped_goes_on_counting(tmp_path):
    more = "[output.checkpoint]\nevery_steps = 2\n[formulation.loading]\nincrement = 0.25\n"
    scene = column("reset_displacements = true", "cover = { size = 0.7 }", more=more)
    check_goes_on(scene, tmp_path, 10)
