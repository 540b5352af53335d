"""Contacts in ground under stress carry it as they are drawn, whatever their stiffness."""

import numpy as np
import pytest

import nmm
from nmm.verification import text

WEIGHT, SIDE = 25e3, 0.4
QUADS = {"type": "quads", "size": 0.5, "degree": 1}
GROUND = (
    f'[[initial_stresses]]\nblock = "all"\nsurface = 4.0\nunit_weight = {WEIGHT}\nratio = {SIDE}\n'
)
BONDED = {"bonded": True, "cohesion": 1e8, "tensile_strength": 1e8}


def joint(friction, stiffness, more=None):
    springs = {"normal_stiffness": stiffness, "shear_stiffness": stiffness / 2}
    return text.interface("joint", friction, more={**springs, **(more or {})})


def contact(stiffness, more=None, friction=35.0):
    """Return a joint of a stiffness (Pa/m), or what only touches."""
    return text.interface("c", friction) if stiffness is None else joint(friction, stiffness, more)


def held(name, start, end, fix):
    return f'[[supports]]\nname = "{name}"\nsegment = {[start, end]}\nfix = {fix}\n'


def run(head, tables, enforcement="penalty", **formulation):
    scene = nmm.parse_scene(text.scene(head, tables))
    table = {"contact": {"enforcement": enforcement}, **formulation}
    return nmm.run(scene, nmm.Formulation.model_validate(table))


def moves(found):
    return float(np.hypot(*found.displacement.T).max())


@pytest.mark.parametrize("enforcement", ["penalty", "cone"])
@pytest.mark.parametrize(("stiffness", "more"), [(1e9, None), (1e9, BONDED), (None, None)])
@pytest.mark.parametrize("cover", [{}, QUADS])
def test_ground_of_layers_under_its_weight_does_not_move(cover, stiffness, more, enforcement):
    layers = [text.box(f"layer {y}", (0, y), (2, 1)) for y in range(4)]
    walls = [held(side, [x, 0], [x, 4], ["x"]) for side, x in (("left", 0), ("right", 2))]
    matter = text.material("rock", 1e9, 0.2, WEIGHT / text.G)
    tables = [
        matter,
        contact(stiffness, more),
        *layers,
        *walls,
        held("base", [0, 0], [2, 0], ["y"]),
    ]
    found = run(
        'plane = "strain"\n[gravity]\n[contact]\n', [*tables, GROUND], enforcement, cover=cover
    )
    # Free joints would close by 75 kPa / 1e9 Pa/m and less; springs of supports of blocks give.
    assert moves(found) < (1e-11 if cover else 2e-7)
    assert found.summary.status == "converged"


def test_the_ends_of_a_joint_share_force_and_moment_of_stress_that_grows_with_depth():
    columns = [text.box(f"column {x}", (x, 0), (1, 4)) for x in range(2)]
    walls = [held(side, [x, 0], [x, 4], ["x"]) for side, x in (("left", 0), ("right", 2))]
    matter = text.material("rock", 1e9, 0.2, WEIGHT / text.G)
    tables = [matter, joint(40.0, 1e8), *columns, *walls, held("base", [0, 0], [2, 0], ["y"])]
    found = run('plane = "strain"\n[gravity]\n[contact]\n', [*tables, GROUND])
    # A joint that was free would close by 40 kPa / 1e8 Pa/m; springs of supports of blocks give.
    assert moves(found) < 2e-7
    # A triangle of pressure from 0 to p has a third of its force at the top, two at the bottom.
    force = SIDE * WEIGHT * 4.0**2 / 2
    right = [-2 / 3 * force, -force / 3]
    np.testing.assert_allclose(np.sort(found.contact_forces[:, 0]), right, rtol=1e-3)


@pytest.mark.parametrize("enforcement", ["penalty", "cone"])
@pytest.mark.parametrize(("stiffness", "more"), [(1e10, None), (1e10, BONDED), (None, None)])
@pytest.mark.parametrize("time", ["", "duration = 0.01\n[inertia]\n"])
def test_an_inclined_face_carries_the_traction_of_the_stress(time, stiffness, more, enforcement):
    angle, stress = np.deg2rad(30.0), np.array([[-1e6, 3e5], [3e5, -2e6]])
    rise = float(0.5 * np.tan(angle))
    low = text.block("low", "rock", [(0, -1), (1, -1), (1, rise), (0, -rise)])
    high = text.block("high", "rock", [(0, -rise), (1, rise), (1, 1.5), (0, 1.5)])
    ring = [[0, -1], [1, -1], [1, rise], [1, 1.5], [0, 1.5], [0, -rise], [0, -1]]
    around = [held(f"edge {i}", *ring[i : i + 2], ["x", "y"]) for i in range(6)]
    laid = '[[initial_stresses]]\nblock = "all"\nstress = [-1e6, -2e6, 3e5]\n'
    tables = [text.material("rock", 1e9, 0.3), contact(stiffness, more), low, high, *around, laid]
    found = run(f'plane = "strain"\n{time}[contact]\n', tables, enforcement, cover=QUADS)
    assert moves(found) < 1e-10  # of 0.2 mm by which a free joint closes
    normal, way = np.array([-0.5, np.sqrt(0.75)]), np.array([np.sqrt(0.75), 0.5])
    right = np.array([normal @ stress @ normal, way @ stress @ normal]) / np.cos(angle)
    np.testing.assert_allclose(found.contact_forces.sum(axis=0), right, rtol=1e-6)
    assert (found.summary.status, list(found.summary.warnings)) == ("converged", [])


@pytest.mark.parametrize("enforcement", ["penalty", "cone"])
@pytest.mark.parametrize("stiffness", [1e9, None])
def test_a_block_between_walls_is_pulled_out_against_the_friction_of_the_stress(
    stiffness, enforcement
):
    bodies = [
        text.box("left", (-1, -1), (1, 2)),
        text.box("middle", (0, -0.5), (1, 1)),
        text.box("right", (1, -1), (1, 2)),
    ]
    laid = '[[initial_stresses]]\nblock = "all"\nstress = [-1e6, 0, 0]\n'
    pull = '[[loads]]\nname = "pull"\nkind = "body"\nblock = "middle"\ndensity = [0, 1e6]\n'
    tables = [
        text.material("rock", 1e9, 0.0),
        contact(stiffness, friction=30.0),
        *bodies,
        laid,
        pull,
    ]
    tables += [
        text.fixed_block("left"),
        text.fixed_block("right"),
        '[loading]\nuntil = "failure"\n',
    ]
    found = run('plane = "strain"\n[contact]\n', tables, enforcement)
    # Two faces of 1 m under 1 MPa; joints that closed freely would leave half of it and less.
    assert found.summary.failure_factor == pytest.approx(2 * np.tan(np.pi / 6), rel=5e-3)


@pytest.mark.parametrize("cover", [{}, QUADS])
def test_springs_of_joints_that_nothing_parts_carry_it_too(cover):
    layers = [text.box(f"layer {y}", (0, y), (2, 1)) for y in range(4)]
    walls = [held(side, [x, 0], [x, 4], ["x"]) for side, x in (("left", 0), ("right", 2))]
    matter = text.material("rock", 1e9, 0.2, WEIGHT / text.G)
    tables = [matter, joint(40.0, 1e9, BONDED), *layers, *walls]
    tables += [held("base", [0, 0], [2, 0], ["y"]), GROUND]
    found = run('plane = "strain"\n[gravity]\n', tables, cover=cover)
    assert moves(found) < (1e-11 if cover else 2e-7)
    assert abs(found.summary.energy_balance) < 1e-9


def test_a_start_that_is_not_in_balance_books_no_work_for_what_joints_carry():
    # Springs of supports of blocks take up the stress at the ends of the row as it moves a little.
    row = [text.box(f"block {x}", (x, 0), (1, 1)) for x in range(3)]
    ends = [held(side, [x, 0], [x, 1], ["x", "y"]) for side, x in (("left", 0), ("right", 3))]
    laid = '[[initial_stresses]]\nblock = "all"\nstress = [-1e6, 0, 0]\n'
    tables = [text.material("rock", 1e9, 0.0), joint(30.0, 1e9, BONDED), *row, *ends, laid]
    found = run('plane = "strain"\n', tables).summary
    assert abs(found.energy_balance) < 1e-9
    assert (found.status, list(found.warnings)) == ("converged", [])


@pytest.mark.parametrize("points", ["vertices", "faces"])
def test_a_block_that_only_touches_two_blocks_below_is_pressed_by_all_of_the_stress(points):
    below = [text.box(f"below {x}", (x, -1), (1, 1)) for x in range(2)]
    above = [text.box("block", (0.3, 0), (1.4, 1)), text.box("above", (-1, 1), (4, 1))]
    laid = '[[initial_stresses]]\nblock = "all"\nstress = [0, -1e6, 0]\n'
    held = [text.fixed_block(name) for name in ("below 0", "below 1", "above")]
    tables = [text.material("rock", 1e9, 0.2), contact(None), *below, *above, laid, *held]
    scene = nmm.parse_scene(text.scene('plane = "strain"\n[contact]\n', tables))
    table = {"contact": {"points": points}}
    found = nmm.run(scene, nmm.Formulation.model_validate(table))
    # 1 MPa on 1.4 m above and below; supports of blocks give by 7e-7 m.
    assert found.contact_forces[:, 0].sum() == pytest.approx(-2.8e6, rel=1e-3)
    assert moves(found) < 1e-6
