"""Cohesive zones that grow from a notch, or begin at an edge."""

import numpy as np
import pytest

import nmm
from nmm.errors import NmmError
from nmm.formulation import parse_formulation
from nmm.scene.read import parse_scene
from nmm.stepping.prepare import prepare
from nmm.testing.resumed.stopping import check_goes_on

# A beam of 100 mm, span 400, notch 30 mm, in three-point bending.
BEAM = """
plane = "stress"
thickness = 0.1
[contact]
[materials.concrete]
young_modulus = "30 GPa"
poisson_ratio = 0.2
[interfaces.crack]
law = "linear_softening"
friction_angle = "35 deg"
cohesion = "30 MPa"
tensile_strength = "3 MPa"
bonded = true
fracture_energy = 100.0
[[blocks]]
name = "beam"
material = "concrete"
vertices = [[-0.2125, 0], [0.2125, 0], [0.2125, 0.1], [-0.2125, 0.1]]
{cracks}
[cohesive_zones]
{zones}
[[supports]]
name = "pin"
point = [-0.2, 0]
fix = ["x", "y"]
[[supports]]
name = "roller"
point = [0.2, 0]
fix = ["y"]
[[loads]]
name = "push"
kind = "edge"
segment = [[-0.005, 0.1], [0.005, 0.1]]
traction = [0, -1000.0]
[[monitors]]
name = "left"
point = [{left}, 0]
[[monitors]]
name = "right"
point = [{right}, 0]
[loading]
until = "failure"
[loading.control]
type = "opening"
monitors = ["right", "left"]
increment = "8 um"
end = "{end}"
"""
NOTCH = '[[cracks]]\nname = "notch"\npoints = [[0, -0.01], [0, 0.03]]'
ZONES = "increment = 0.02\n"
NET = """
[cover]
type = "triangles"
size = {size}
degree = 1
angle = {angle}
shift = [{x}, 0.27]
"""
# Graded finite elements with the same plane (half a per cent).
PEAK = 4216.5


def beam(cracks=NOTCH, zones=ZONES, at=0.005, end="60 um"):
    return parse_scene(BEAM.format(cracks=cracks, zones=zones, left=-at, right=at, end=end))


def net(angle=0.3, x=0.13, size=0.02):
    return parse_formulation(NET.format(angle=angle, x=x, size=size))


@pytest.fixture(scope="module")
def grown():
    """Return the run of a zone that grows from a notch."""
    return nmm.run(beam(), net())


def test_a_zone_that_grows_from_a_notch_carries_the_load_of_a_drawn_plane(grown):
    # The benchmark asks for 4 % of a free path; cells of a fifth of the height are 0.2 % off, and
    # the zone leaves the plane of symmetry by less than a tenth of a cell before half the height.
    run = grown
    assert run.summary.failure_factor == pytest.approx(PEAK, rel=0.02)
    place = [run.history[f"cohesive zones:notch:end:{axis}"] for axis in "xy"]
    assert np.abs(place[0]).max() < 2.5e-3
    assert place[1][-1] == pytest.approx(0.1, abs=1e-9)
    assert run.history["cohesive zones:growth"][-1] == pytest.approx(0.07, rel=2e-3)
    assert abs(run.summary.energy_balance) < 1e-3


def test_faces_that_are_laid_change_no_energy(grown):
    """But for the first, with which the functions of the notch's tip go."""
    changed = grown.history["change_energy"]
    where = np.flatnonzero(np.diff(changed))
    assert len(grown.summary.changes) > 3
    since = changed[where[0] + 1 :]
    # Of the work, by which the beam turns meanwhile: 4e-6.
    assert np.abs(since - since[0]).max() < 1e-5 * grown.history["external_work"].max()
    assert (np.diff(grown.history["friction_loss"]) > -1e-12).all()


def test_where_functions_of_a_tip_go_no_energy_comes_from_softening():
    """Cells as long as the notch: there its functions hold more than the first faces let go of."""
    run = nmm.run(beam(zones=ZONES + "ahead = 0.3\n", end="8 um"), net(size=0.03))
    assert run.history["change_energy"].max() > 0
    lost = np.diff(run.history["friction_loss"], prepend=0.0)
    assert (lost > -1e-12 * run.history["external_work"].max()).all()
    assert abs(run.summary.energy_balance) < 1e-4


def test_work_is_what_is_stored_and_what_softening_took(grown):
    h = grown.history
    stored = h["strain_energy"] + h["contact_energy"] + h["support_energy"]
    missing = h["external_work"] - stored - h["friction_loss"]
    assert np.abs(missing).max() < 1e-3 * h["external_work"].max()


def test_a_path_along_which_a_zone_grows_goes_on_bit_by_bit(tmp_path):
    cover = NET.format(angle=0.3, x=0.13, size=0.03).replace("[cover]", "[formulation.cover]")
    beam = BEAM.format(cracks=NOTCH, zones=ZONES, left=-0.005, right=0.005, end="40 um")
    scene = parse_scene(f"{beam}[output.checkpoint]\nevery_steps = 2\n{cover}")
    whole = check_goes_on(scene, tmp_path)
    assert len(whole.summary.changes) > 1


@pytest.mark.slow
def test_the_peak_hangs_on_no_net():
    peaks = []
    for angle, x in ((0.0, 0.3), (0.5, 0.7), (0.8, 0.1), (1.3, 0.5)):
        peaks.append(nmm.run(beam(end="70 um"), net(angle, x)).history["load_factor"].max())
    # Cells of a fifth of the height: the peaks of nets scatter by 2 %.
    assert np.ptp(peaks) < 0.03 * PEAK
    assert np.mean(peaks) == pytest.approx(PEAK, rel=0.02)


def test_a_zone_begins_where_the_stress_is_largest():
    # Bending without a notch: at the lower edge under the load, to half a length of the mean.
    zones = "increment = 0.02\nnucleation = true"
    run = nmm.run(beam("", zones, at=0.04, end="12 um"), net())
    began = [one for one in run.summary.changes if "began" in one]
    assert began
    x, y = (float(one) for one in began[0].split("[")[1].rstrip("]").split(","))
    assert abs(x) < 0.01
    assert y == pytest.approx(0.0, abs=1e-12)


def test_a_zone_stops_at_its_largest_growth():
    run = nmm.run(beam(zones=ZONES + "max_growth = 0.02", end="16 um"), net())
    assert run.history["cohesive zones:notch:end:growth"][-1] == pytest.approx(0.02, rel=1e-9)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("[contact]", "", r"cohesive_zones.*no \[contact\]"),
        ("bonded = true", "", "no interface that is bonded"),
        (NOTCH, "", r"no \[\[cracks\]\]"),
        ("increment = 0.02", "increment = -1.0", "increment"),
        ("increment = 0.02", "increment = 0.02\nahead = 1.5", "ahead"),
    ],
)
def test_what_zones_lack_is_told(old, new, said):
    text = BEAM.format(cracks=NOTCH, zones=ZONES, left=-1, right=1, end="1 um")
    with pytest.raises(NmmError, match=said):
        parse_scene(text.replace(old, new, 1))


def test_a_cover_of_blocks_carries_no_zones():
    scene = beam(cracks="", zones="increment = 0.02\nnucleation = true")
    with pytest.raises(NmmError, match="a mesh, which cracks can cut"):
        prepare(scene, parse_formulation('[cover]\ntype = "block"\ndegree = 1\n'))
