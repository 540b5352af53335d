"""Runs in which blocks split by their stress: at the right load, along the right plane, by rule."""

from pathlib import Path

import numpy as np
import pytest

import nmm
from nmm.errors import NmmError
from nmm.materials.principal_stresses import PrincipalStresses
from nmm.testing.resumed.killing import check_same_bytes
from nmm.testing.resumed.stopping import stopped_after

COLUMN = """
title = "column"
plane = "stress"
thickness = 0.1
[materials.concrete]
young_modulus = "27.5 GPa"
poisson_ratio = 0.2
density = 2400
[contact]
[interfaces.any]
between = "any"
friction_angle = "20 deg"
[splitting.concrete]
tensile_strength = "2.9 MPa"
cohesion = "4.7 MPa"
friction_angle = "37 deg"
smallest_block = "5 mm"
[[blocks]]
name = "column"
material = "concrete"
vertices = {corners}
[[supports]]
name = "foot"
segment = {foot}
fix = {fix}
[[supports]]
name = "corner"
point = {corner}
fix = ["x", "y"]
[[loads]]
name = "head"
kind = "edge"
segment = {head}
traction = {traction}
[loading]
until = "failure"
[formulation.loading]
increment = 1.0
tolerance = 1e-4
{cover}
"""
NET = '[formulation.cover]\ntype = "quads"\nsize = 0.03\ndegree = 0\n'


def column(pressure, cover="", quarter=0):
    """A column 0.1 x 0.25 m under a pressure (Pa, tension positive), in quarters of a turn."""
    c, s = [(1, 0), (0, 1), (-1, 0), (0, -1)][quarter]
    turn = np.array([[c, -s], [s, c]])
    low, right, up, left = (turn @ p for p in np.array([[0, 0], [0.1, 0], [0.1, 0.25], [0, 0.25]]))
    return COLUMN.format(
        corners=[p.tolist() for p in (low, right, up, left)],
        foot=[low.tolist(), right.tolist()],
        fix='["y"]' if c else '["x"]',
        corner=low.tolist(),
        head=[left.tolist(), up.tolist()],
        traction=(turn @ [0, pressure]).tolist(),
        cover=cover,
    )


def run(text, **more):
    return nmm.run(nmm.parse_scene(text, "scene"), **more)


def planes_of(found):
    """Directions (degrees, 0 to 180) of the faces inside the block, in the reference place."""
    manifold = found.manifold
    edges = manifold.boundary
    way = edges.end - edges.start
    points = manifold.elements.points
    apart = edges.start - (points.min(axis=0) + points.max(axis=0)) / 2
    off = apart[:, 0] * way[:, 1] - apart[:, 1] * way[:, 0]
    through = np.abs(off) < 1e-6 * np.hypot(*way.T)
    angle = np.degrees(np.arctan2(way[through, 1], way[through, 0]))
    return np.unique(np.round(angle, 4) % 180)


@pytest.mark.parametrize("quarter", [0, 1, 2, 3])
def test_a_column_in_tension_splits_normal_to_the_load_at_its_strength(quarter):
    found = run(column(1e6, quarter=quarter))
    assert found.summary.status == "failure_load", found.summary.sentence
    assert found.summary.failure_factor == pytest.approx(2.9, rel=1e-4)
    assert "1 block splits into 2 (1 by tension)" in found.summary.sentence
    assert planes_of(found).tolist() == [0.0 if quarter % 2 == 0 else 90.0]


def test_a_column_in_compression_splits_at_45_and_half_of_phi_to_its_loaded_face():
    """c = 4.7 MPa, phi = 37: 18.853483 MPa, both planes of 63.5 degrees, for they are as long."""
    found = run(column(-1e7))
    assert found.summary.status == "failure_load", found.summary.sentence
    assert found.summary.failure_factor == pytest.approx(1.8853483, rel=1e-4)
    np.testing.assert_allclose(planes_of(found), [63.5, 116.5], atol=1e-5)
    assert found.manifold.n_bodies == 4


def test_a_net_over_the_column_splits_at_the_same_load_along_the_same_plane():
    text = column(1e6, NET).replace(
        'point = [0.0, 0.0]\nfix = ["x", "y"]', 'segment = [[0, 0], [0, 0.25]]\nfix = ["x"]'
    )
    found = run(text)
    assert found.summary.failure_factor == pytest.approx(2.9, rel=1e-4)
    assert planes_of(found).tolist() == [0.0]
    assert found.manifold.n_bodies == 2


SATURATED = """
[seepage]
[[heads]]
name = "pores"
block = "column"
head = {head}
gradient = [0, 1]
"""


@pytest.mark.parametrize(
    ("unit", "stress", "factor"),
    [
        (1e6, "effective", 1.9),  # s + p = ft
        (1e6, "total", 2.9),
        # Coulomb of s1 = p and s2 = p - q: q = 2 c N - p (N^2 - 1), N = tan(45 + 37 / 2 degrees).
        (-1e7, "effective", 1.8853483 - 0.1 * (np.tan(np.deg2rad(63.5)) ** 2 - 1)),
    ],
)
def test_water_in_pores_takes_from_the_strength_of_blocks(unit, stress, factor):
    # Water of 1 MPa changed nothing: columns carried 1.5 and 1.2 times what they may.
    text = column(unit).replace("2400\n", "2400\nhydraulic_conductivity = 1e-6\n")
    text = text.replace("[splitting.concrete]\n", f'[splitting.concrete]\nstress = "{stress}"\n')
    found = run(text + SATURATED.format(head=1e6 / 9810))
    assert found.summary.status == "failure_load", found.summary.sentence
    # The tolerance of the load.
    assert found.summary.failure_factor == pytest.approx(factor, rel=2e-4)


DROP = """
title = "drop"
plane = "stress"
duration = "12 ms"
[materials.rock]
young_modulus = "1 GPa"
poisson_ratio = 0.2
density = 2000
[[blocks]]
name = "floor"
material = "rock"
vertices = [[-1, -1], [3, -1], [3, 0], [-1, 0]]
[[blocks]]
name = "left"
material = "rock"
vertices = [[0, 0.01], [0.8, 0.21], [0.8, 0.71], [0, 0.51]]
[[blocks]]
name = "right"
material = "rock"
vertices = [[1.2, 0.21], [2, 0.01], [2, 0.51], [1.2, 0.71]]
[inertia]
[gravity]
[contact]
[interfaces.any]
between = "any"
friction_angle = "30 deg"
[splitting.rock]
tensile_strength = "60 kPa"
cohesion = "150 kPa"
friction_angle = "30 deg"
smallest_block = "60 mm"
[[supports]]
name = "held"
block = "floor"
fix = ["x", "y"]
[[initial_velocities]]
block = "left"
velocity = [0, -4]
[[initial_velocities]]
block = "right"
velocity = [0, -4]
[output]
events = ["shape_changes"]
{checkpoint}
[formulation.integrator]
type = "newmark"
step = "0.5 ms"
"""


@pytest.fixture(scope="module")
def dropped():
    return run(DROP.format(checkpoint=""))


def test_a_block_that_hits_the_floor_shatters_and_momentum_and_energy_add_up(dropped):
    assert dropped.summary.status == "converged", dropped.summary.sentence
    assert dropped.manifold.n_bodies > 8
    assert dropped.manifold.body_area.sum() == pytest.approx(4 + 2 * 0.4, rel=1e-12)
    assert dropped.summary.audits["energy_made_in_run"] < 1e-2
    assert dropped.history["splitting:bodies"][0] == 3
    # A frame for every event beside the first and the last.
    assert len(dropped.frames) >= len(dropped.summary.changes)


def test_the_step_after_a_split_loses_no_energy_by_a_rule_that_keeps_it():
    # Pieces without contact are linear: Newmark's rule (1/4, 1/2) keeps their energy. Contacts spin
    # strained pieces up as if they were unstrained: 4e-5 of the energy of motion. Shi's rule took a
    # fifth of the strain energy.
    short = DROP.format(checkpoint="").replace("12 ms", "3 ms").replace("0.5 ms", "0.05 ms")
    history = run(short).history
    split = np.flatnonzero(np.diff(history["splitting:bodies"]))[0]
    lost = np.diff(history["integration_loss"])[split]
    assert abs(lost) < 2e-3 * history["strain_energy"][split]


def test_blocks_that_reach_their_strength_together_split_in_one_event_as_mirror_images(dropped):
    """Later events differ, for friction between the pieces has many answers."""
    assert "2 blocks split into 4" in dropped.summary.changes[0]
    centre = dropped.topologies[1].elements.centroids[1:]
    mirrored = centre * [-1, 1] + [2, 0]
    found, expected = (points[np.lexsort(np.round(points, 6).T)] for points in (centre, mirrored))
    np.testing.assert_allclose(found, expected, atol=1e-9)


def test_the_order_of_blocks_in_the_scene_does_not_matter(dropped):
    text = DROP.format(checkpoint="").replace("12 ms", "3.2 ms")
    left, right = text.index('[[blocks]]\nname = "left"'), text.index('[[blocks]]\nname = "right"')
    end = text.index("[inertia]")
    other = run(text[:left] + text[right:end] + text[left:right] + text[end:])
    one, two = (run.topologies[1].elements.centroids for run in (dropped, other))
    sort = [points[np.lexsort(np.round(points, 6).T)] for points in (one, two)]
    np.testing.assert_allclose(*sort, atol=1e-12)


@pytest.mark.parametrize("steps", [7, 15])
def test_two_halves_of_a_run_with_splits_are_the_whole(steps, tmp_path):
    text = DROP.format(checkpoint="checkpoint = { every_steps = 3 }")
    whole = run(text, out=tmp_path / "whole")
    folder = stopped_after(nmm.parse_scene(text, "scene"), tmp_path / "half", steps)
    check_same_bytes(whole, nmm.resume(folder), (tmp_path / "whole", folder))


def test_no_more_blocks_than_the_rule_says_and_the_history_counts_those_kept_whole():
    found = run(DROP.format(checkpoint="").replace("60 mm", '60 mm"\nmost_blocks = 5\n#"'))
    assert found.manifold.n_bodies <= 5
    assert found.history["splitting:kept_whole"].max() > 0


FAULTS = {
    "smallest_block larger": (
        'smallest_block = "60 mm"',
        "smallest_block = 9",
        "less than the largest block",
    ),
    "negative strength": ('tensile_strength = "60 kPa"', "tensile_strength = -1", "> 0"),
    "no strength": ('tensile_strength = "60 kPa"\ncohesion = "150 kPa"', "", "one of them"),
    "no such material": ("[splitting.rock]", "[splitting.rook]", 'did you mean "rock"'),
    "no contact": ("[contact]\n", "", "a scene with contact"),
    "no such law": ("[splitting.rock]", '[splitting.rock]\nlaw = "hoek"', "mohr_coulomb"),
    "too few": ("[splitting.rock]", "[splitting.rock]\nmost_blocks = 1", ">= 2"),
    "too steep": ("smallest_block", "options = {}\nsmallest_bloc", "smallest_block"),
}


@pytest.mark.parametrize("fault", FAULTS)
def test_what_cannot_split_is_refused_by_line_before_anything_runs(fault):
    old, new, said = FAULTS[fault]
    text = DROP.format(checkpoint="")
    assert old in text
    with pytest.raises(NmmError) as refused:
        run(text.replace(old, new, 1))
    assert said in str(refused.value)
    assert "scene:" in str(refused.value)


BEAM = """
title = "beam"
plane = "stress"
thickness = 0.1
[materials.concrete]
young_modulus = "27.5 GPa"
poisson_ratio = 0.2
[contact]
[interfaces.joint]
friction_angle = "37 deg"
cohesion = "50 MPa"
tensile_strength = "50 MPa"
bonded = true
[splitting.concrete]
tensile_strength = "2.9 MPa"
smallest_block = "5 mm"
most_blocks = 26
[[blocks]]
name = "beam"
material = "concrete"
vertices = [[0, 0], [0.6, 0], [0.6, 0.1], [0, 0.1]]
[[supports]]
name = "left"
point = [0, 0]
fix = ["x", "y"]
[[supports]]
name = "right"
point = [0.6, 0]
fix = ["y"]
[[loads]]
name = "press"
kind = "point"
point = [0.3, 0.1]
force = [0, -1000]
[loading]
until = 14.0
[formulation.cover]
type = "sub_blocks"
size = 0.05
options = { mesh = "quads", bond = "interface" }
[formulation.loading]
increment = 2.0
tolerance = 1e-2
"""


def test_sub_blocks_split_where_their_joints_are_stronger():
    """Joints of 50 MPa hold; the sub-blocks under the load reach 2.9 MPa and split upwards."""
    found = run(BEAM)
    assert "by tension" in found.summary.changes[0]
    first = found.topologies[0].elements.centroids
    second = found.topologies[1].elements.centroids
    far = np.abs(second[:, None] - first).sum(axis=2).min(axis=1) > 1e-9
    assert far.any()
    assert (np.abs(second[far][:, 0] - 0.3) < 0.06).all()
    assert (second[far][:, 1] < 0.05).all()
    # They are those that had the largest principal stress, which was the strength.
    frame = [one for one in found.frames if one.topology == 0][-1]
    larger = PrincipalStresses.of(frame.stress).larger
    assert larger.max() == pytest.approx(2.9e6, rel=1e-2)
    gone = np.abs(first[:, None] - second).sum(axis=2).min(axis=1) > 1e-9
    assert (larger[gone] > 0.99 * larger.max()).all()


def test_the_slab_of_the_example_breaks_across_its_middle_and_keeps_its_energy():
    text = (Path(__file__).parents[3] / "examples" / "splitting" / "slab.toml").read_text()
    found = run(text.replace('duration = "50 ms"', 'duration = "19.6 ms"'))
    assert found.summary.changes == ["at 0.01932: 1 block splits into 2 (1 by tension)"]
    assert abs(found.summary.energy_balance) < 1e-3
    edges = found.manifold.boundary
    lengths = np.sort(np.hypot(*(edges.end - edges.start)[edges.body > 0].T))
    assert lengths[:2] == pytest.approx(0.3, rel=0.01)  # both new faces are the shortest
