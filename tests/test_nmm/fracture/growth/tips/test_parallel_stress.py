"""The stress along a crack, and pieces of cracks that end without shear."""

import math

import numpy as np
import pytest

import nmm
from integration.arrays import Floats
from integration.polygons import Polygons
from nmm.assembly.applied_forces import joined
from nmm.assembly.places import on_edges
from nmm.formulation import parse_formulation
from nmm.fracture.growth.tips.parallel_stress import kink_without_end_shear, parallel_stress
from nmm.materials.elastic import Elastic
from nmm.model.from_polygons import solid
from nmm.scene.methods.cover_tables import CoverTable
from nmm.scene.read import parse_scene
from nmm.stepping.drive.linear_statics import equilibrium, traction

HELD = """
plane = "{plane}"
[materials.m]
young_modulus = 1e10
poisson_ratio = 0.3
[[blocks]]
name = "b"
material = "m"
vertices = [[-2, -2], [2, -2], [2, 2], [-2, 2]]
[[cracks]]
name = "c"
points = {crack}
[[initial_stresses]]
block = "b"
stress = {stress}
[[water_pressures]]
name = "w"
crack = "c"
pressure = {water}
[[supports]]
name = "l"
segment = [[-2, -2], [-2, 2]]
fix = ["x", "y"]
[[supports]]
name = "r"
segment = [[2, -2], [2, 2]]
fix = ["x", "y"]
[[supports]]
name = "u"
segment = [[-2, 2], [2, 2]]
fix = ["x", "y"]
[[supports]]
name = "d"
segment = [[-2, -2], [2, -2]]
fix = ["x", "y"]
[formulation.cover]
type = "triangles"
size = 0.05
degree = 1
"""


@pytest.mark.parametrize(("along", "expected"), [(0.0, -1.0), (1.0, 0.0), (-0.5, -1.5)])
@pytest.mark.parametrize("turn", [0.0, 0.6])
def test_the_parallel_stress_of_a_crack_in_a_wide_plate(
    along: float, expected: float, turn: float
) -> None:
    # T = (biaxiality - 1) times the stress across (Eftis and Liebowitz 1972). With eight cells on
    # a crack strains of its faces are 4 to 9 % of the stress off.
    c, s = math.cos(turn), math.sin(turn)
    axes = np.array([[c, -s], [s, c]])
    ends = np.array([[-0.2, 0.0], [0.2, 0.0]]) @ axes.T
    ring = 2.0 * np.array([[-1.0, -1], [1, -1], [1, 1], [-1, 1]])
    cover = CoverTable(type="triangles", size=0.05, degree=1, angle=0.2)
    law, plate = Elastic(1.0, 0.3), Polygons.from_vertices([ring])
    model = solid(plate, cover, [law], "strain", cracks=[ends.tolist()])
    stress = axes @ np.diag([along, 1.0]) @ axes.T
    outer = on_edges(model.manifold, model.cut.boundary.crack < 0, 4)

    def pull(p: Floats, n: Floats) -> Floats:
        return n @ stress

    found = equilibrium(model, [traction(model, outer, pull)]).state
    measured = parallel_stress(model, found, np.arange(2), 0.05, joined([]))
    assert measured == pytest.approx(np.full(2, expected), abs=0.1)


@pytest.mark.parametrize("plane", ["stress", "strain"])
@pytest.mark.parametrize(
    ("start", "water", "expected"),
    [((0.0, 0.0), 1e6, 0.0), ((-6e6, -2e6), 0.0, -4e6), ((-6e6, -2e6), 3e6, -4e6)],
)
def test_pressure_in_a_crack_and_stress_from_the_start_count(
    plane: str, start: tuple[float, float], water: float, expected: float
) -> None:
    # T = stress along less stress across, far away; an even pressure within adds none to it. The
    # plate is held at its edges, ten half lengths wide: some 2 % of what opens the crack.
    c, s = math.cos(0.4), math.sin(0.4)
    axes = np.array([[c, -s], [s, c]])
    ends = np.array([[-0.2, 0.0], [0.2, 0.0]]) @ axes.T
    stress = axes @ np.diag(start) @ axes.T
    scene = HELD.format(
        plane=plane,
        crack=ends.tolist(),
        stress=[float(stress[0, 0]), float(stress[1, 1]), float(stress[0, 1])],
        water=water,
    )
    run = nmm.run(parse_scene(scene))
    plan = run.stepper.plan
    pushes = joined(one.applied_forces(run.state) for one in plan.having("applied_forces"))
    model, tips = run.stepper.model, np.arange(2)
    measured = parallel_stress(model, run.state, tips, 0.05, pushes, plan.stresses)
    assert measured == pytest.approx(np.full(2, expected), abs=0.08 * 4e6)


def test_a_piece_under_parallel_compression_ends_without_shear() -> None:
    opening, sliding = np.array([1.0, 1.0, 0.3]), np.array([0.2, -0.3, 0.9])
    angle = 2 * np.arctan2(-2 * sliding, opening + np.sqrt(opening**2 + 8 * sliding**2))
    parallel, length = np.array([-4.0, -0.5, -2.0]), 0.02
    found = kink_without_end_shear(angle, opening, sliding, parallel, length)
    along = parallel * math.sqrt(8 * length / math.pi)
    shear = np.cos(found / 2) / 2 * (opening * np.sin(found) + sliding * (3 * np.cos(found) - 1))
    assert shear == pytest.approx(along * np.sin(found) * np.cos(found), abs=1e-12)
    assert (np.sign(found) == np.sign(angle)).all()
    assert (np.abs(found) < np.abs(angle)).all()


def test_parallel_tension_leaves_the_kink() -> None:
    angle = np.array([0.3, -1.2])
    found = kink_without_end_shear(
        angle, np.array([1.0, -0.1]), np.array([-0.15, 0.8]), np.array([3.0, 3.0]), 0.1
    )
    assert found == pytest.approx(angle, abs=0)


def test_a_piece_of_a_crack_that_is_shut_opens_by_sliding_alone() -> None:
    sliding, parallel = np.array([-1.0]), np.array([-3.0])
    angle = np.arccos(1 / 3) * np.ones(1)
    closed = kink_without_end_shear(angle, np.array([-0.2]), sliding, parallel, 0.02)
    assert closed == pytest.approx(
        kink_without_end_shear(angle, np.zeros(1), sliding, parallel, 0.02)
    )
    assert 0 < closed[0] < angle[0]


WING = """
title = "Wing cracks"
plane = "strain"

[materials.rock]
young_modulus = 1e10
poisson_ratio = 0.2

[interfaces.any]
friction_angle = 0.29

[[blocks]]
name = "plate"
material = "rock"
vertices = [[-0.3, -0.3], [0.3, -0.3], [0.3, 0.3], [-0.3, 0.3]]

[[cracks]]
name = "c"
points = [[-0.0707, -0.0707], [0.0707, 0.0707]]

[contact]

[fracture]
toughness = 8e4
increment = 0.02
max_growth = 0.1
parallel_stress = {asked}

[[loads]]
name = "top"
kind = "edge"
segment = [[-0.3, 0.3], [0.3, 0.3]]
traction = [0, -1e6]

[[loads]]
name = "bottom"
kind = "edge"
segment = [[-0.3, -0.3], [0.3, -0.3]]
traction = [0, 1e6]

[[supports]]
name = "pin"
point = [-0.3, -0.3]
fix = ["x", "y"]

[[supports]]
name = "roller"
point = [0.3, -0.3]
fix = ["y"]
"""
NET = """
[cover]
type = "triangles"
size = 0.02
degree = 1
angle = "11 deg"

[loading]
tolerance = 0.01
"""


@pytest.mark.slow
@pytest.mark.parametrize("asked", ["true", "false"])
def test_wing_cracks_turn_towards_the_load_without_swinging(asked: str) -> None:
    # A crack pressed shut at 45 degrees: wings leave at about 70 degrees to it and turn to the
    # load's direction (Horii and Nemat-Nasser 1985). By K_I and K_II alone they swing, and say so.
    run = nmm.run(parse_scene(WING.format(asked=asked)), parse_formulation(NET))
    x, y = (np.array(run.history[f"fracture:c:end:{axis}"]) for axis in "xy")
    way = np.diff(np.stack([x, y]), axis=1)
    pieces = np.degrees(np.arctan2(*way[::-1]))[np.hypot(*way) > 0]
    assert pieces[0] == pytest.approx(45 + 70, abs=6)
    turns = np.diff(pieces)
    swings = (turns[1:] * turns[:-1] < 0) & (np.minimum(*np.abs([turns[1:], turns[:-1]])) > 15)
    assert swings.any() == (asked == "false")
    assert ("swings" in " ".join(run.summary.warnings)) == (asked == "false")
    if asked == "true":
        assert (np.abs(pieces[1:] - 90) < 30).all()


STEEP = WING.replace("max_growth = 0.1", "max_growth = 0.01")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("degrees", "asked", "expected", "within"),
    [(65, "true", 57.4, 4.0), (55, "true", 66.2, 3.0), (65, "false", 70.5, 1.0)],
)
def test_the_first_piece_of_a_crack_that_is_shut_knows_the_stress_along_it(
    degrees: int, asked: str, expected: float, within: float
) -> None:
    # Expected are the angles at which K_II of drawn pieces is zero on cells of half the size
    # (-9.4 at 55 and 28.2 kPa m^0.5 at 65 degrees, and -57.4 and -6.1), and that of the largest
    # hoop stress in pure sliding.
    turn = math.radians(degrees)
    half = 0.1 * np.array([math.cos(turn), math.sin(turn)])
    flaw = "[[-0.0707, -0.0707], [0.0707, 0.0707]]"
    scene = STEEP.format(asked=asked).replace(flaw, f"{[(-half).tolist(), half.tolist()]}")
    run = nmm.run(parse_scene(scene), parse_formulation(NET))
    (line,) = run.stepper.discretisation.setup.geometry.cracks
    for piece in (line[-1] - line[-2], line[0] - line[1]):
        along = math.copysign(1.0, piece @ half) * half
        left = along[0] * piece[1] - along[1] * piece[0]
        found = math.degrees(math.atan2(left, piece @ along))
        assert found == pytest.approx(expected, abs=within)
