"""Ground in balance under its initial stress stands still, however supports hold it."""

import numpy as np
import pytest

import nmm
from nmm.verification import text

COVERS = {
    "block": "",
    "triangles": 'type = "triangles"\nsize = 3.0\n',
    "quadratic": 'type = "quads"\nsize = 4.0\ndegree = 2\n',
    "splines": 'type = "bspline"\nsize = 4.0\ndegree = 2\n',
}
HELD = [(cover, method) for cover in COVERS for method in ("penalty", "nitsche", "lagrange")]
HELD = [one for one in HELD if one[0] != "block" or one[1] == "penalty"]
SUB_BLOCKS = (
    'type = "sub_blocks"\nsize = 3.0\noptions = {{ mesh = "{}", glue = "{}" }}\n'
    'functions = "monomials"\ndegree = {}\n'
)
MODULUS, RATIO, WEIGHT, HIGH = 50e6, 0.3, 20e3, 10.0
# What rounding of stresses of 0.2 MPa does to springs and matter.
STILL = 1e-12


def formulation(cover: str, method: str) -> str:
    return f'[formulation.supports]\nmethod = "{method}"\n[formulation.cover]\n{COVERS[cover]}'


def support(name: str, segment: list[list[float]], axes: str) -> str:
    return f'[[supports]]\nname = "{name}"\nsegment = {segment}\nfix = {list(axes)}\n'


def soil(law: str = "") -> str:
    return text.material("rock", MODULUS, RATIO, WEIGHT / text.G) + law


def ground(more: list[str], blocks: tuple[str, ...], base: str = "y") -> nmm.Run:
    """Ground of 8 m by 10 m between walls under its weight and the stress that balances it."""
    walls = [
        support("base", [[0, 0], [8, 0]], base),
        support("left", [[0, 0], [0, HIGH]], "x"),
        support("right", [[8, 0], [8, HIGH]], "x"),
    ]
    laid = f'[[initial_stresses]]\nblock = "all"\nsurface = {HIGH}\nratio = 0.6\n'
    laid += f"unit_weight = {WEIGHT}\n"
    tables = [*blocks, *walls, laid, *more]
    return nmm.run(nmm.parse_scene(text.scene('plane = "strain"\n[gravity]\n', tables)))


@pytest.mark.parametrize(("cover", "method"), HELD)
def test_ground_under_its_weight_stands_still(cover, method):
    run = ground([formulation(cover, method)], (soil(), text.box("soil", (0, 0), (8, HIGH))))
    assert run.summary.status == "converged", run.summary.sentence
    # Its weight alone would press it in by 1.5e-2 m.
    assert np.abs(run.displacement).max() < STILL
    assert run.history["reaction:base:y"][-1] == pytest.approx(WEIGHT * 8 * HIGH, rel=1e-9)
    at_wall = 0.6 * WEIGHT * HIGH**2 / 2
    assert run.history["reaction:left:x"][-1] == pytest.approx(at_wall, rel=1e-9)


@pytest.mark.parametrize("degree", [1, 2])
@pytest.mark.parametrize("glue", ["springs", "nitsche"])
@pytest.mark.parametrize("mesh", ["triangles", "voronoi"])
def test_ground_of_sub_blocks_stands_still_whatever_glues_them(mesh, glue, degree):
    """Springs between them carried nothing at first."""
    more = f"[formulation.cover]\n{SUB_BLOCKS.format(mesh, glue, degree)}"
    run = ground([more], (soil(), text.box("soil", (0, 0), (8, HIGH))))
    assert run.summary.status == "converged", run.summary.sentence
    assert np.abs(run.displacement).max() < STILL


CELLS = 'type = "quads"\nsize = 2.0\ndegree = 0\n'


def at(number: int, point: list[float], axes: str) -> str:
    return f'[[supports]]\nname = "at {number}"\npoint = {point}\nfix = {list(axes)}\n'


@pytest.mark.parametrize(("cover", "cells", "angle"), [("", 1, 0), ("", 1, 0.4), (CELLS, 4, 0)])
def test_ground_held_at_points_stands_still(cover, cells, angle):
    """Points between which all functions are linear hold what an edge would."""
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    corners = np.array([[0.0, 0.0], [8, 0], [8, 8], [0, 8]]) @ turn.T
    share = np.arange(cells)[:, None] / cells
    ring = np.concatenate(
        [a + share * (b - a) for a, b in zip(corners, np.roll(corners, -1, 0), strict=True)]
    )
    block = f'[[blocks]]\nname = "body"\nmaterial = "rock"\nvertices = {corners.tolist()}\n'
    laid = '[[initial_stresses]]\nblock = "all"\nstress = [-1e5, -2e5, 3e4]\n'
    points = [at(i, point, "xy") for i, point in enumerate(ring.tolist())]
    more = f"[formulation.cover]\n{cover}"
    run = nmm.run(
        nmm.parse_scene(text.scene('plane = "strain"\n', [soil(), block, *points, laid, more]))
    )
    assert run.summary.status == "converged", run.summary.sentence
    assert np.abs(run.displacement).max() < STILL


def test_a_block_on_two_points_between_walls_stands_still():
    """The walls hold what is across them, the points what is below."""
    tables = [
        soil(),
        text.box("soil", (0, 0), (8, HIGH)),
        at(0, [0, 0], "y"),
        at(1, [8, 0], "xy"),
        at(2, [0, HIGH], "x"),
        at(3, [0, 0], "x"),
        support("right", [[8, 0], [8, HIGH]], "x"),
        f'[[initial_stresses]]\nblock = "all"\nsurface = {HIGH}\nratio = 0.6\n'
        f"unit_weight = {WEIGHT}\n",
    ]
    run = nmm.run(nmm.parse_scene(text.scene('plane = "strain"\n[gravity]\n', tables)))
    assert run.summary.status == "converged", run.summary.sentence
    assert np.abs(run.displacement).max() < STILL
    assert run.history["reaction:at 0:y"][-1] == pytest.approx(WEIGHT * 4 * HIGH, rel=1e-9)


@pytest.mark.parametrize("law", ["mohr_coulomb", "neo_hookean"])
def test_ground_of_any_matter_stands_still_on_springs(law):
    kind = {
        "mohr_coulomb": 'law = "mohr_coulomb"\ncohesion = 1e5\nfriction_angle = 0.5\n',
        "neo_hookean": 'law = "neo_hookean"\n',
    }[law]
    more = formulation("quadratic", "penalty")
    if law == "neo_hookean":
        more += '[formulation.rotation]\nupdate = "finite"\n'
    run = ground([more], (soil(kind), text.box("soil", (0, 0), (8, HIGH))))
    assert run.summary.status == "converged", run.summary.sentence
    assert np.abs(run.displacement).max() < STILL


@pytest.mark.parametrize("angle", [0.0, 0.4])
@pytest.mark.parametrize(("cover", "method"), HELD)
def test_a_turned_body_held_all_round_stands_still(cover, method, angle):
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    corners = (np.array([[0.0, 0.0], [6, 0], [6, 5], [0, 5]]) @ turn.T).tolist()
    ring = [*corners, corners[0]]
    block = f'[[blocks]]\nname = "body"\nmaterial = "rock"\nvertices = {corners}\n'
    sides = [support(f"side {i}", ring[i : i + 2], "xy") for i in range(4)]
    laid = '[[initial_stresses]]\nblock = "all"\nstress = [-1e5, -2e5, 3e4]\n'
    tables = [soil(), block, *sides, laid, formulation(cover, method)]
    run = nmm.run(nmm.parse_scene(text.scene('plane = "strain"\n', tables)))
    assert run.summary.status == "converged", run.summary.sentence
    assert np.abs(run.displacement).max() < STILL


@pytest.mark.parametrize("cover", ["block", "triangles"])
def test_a_floor_that_is_held_all_round_leaves_its_face_to_what_stands_on_it(cover):
    """The contact has the traction there; springs of the floor had it once more."""
    layers = [text.box("floor", (0, 0), (8, 2)), text.box("soil", (0, 2), (8, HIGH - 2))]
    whole = '[[supports]]\nname = "floor"\nblock = "floor"\nfix = ["x", "y"]\n'
    joint = text.interface("joint", 30.0)
    walls = [
        support("left", [[0, 2], [0, HIGH]], "x"),
        support("right", [[8, 2], [8, HIGH]], "x"),
    ]
    laid = f'[[initial_stresses]]\nblock = "all"\nsurface = {HIGH}\nratio = 0.6\n'
    laid += f"unit_weight = {WEIGHT}\n"
    tables = [soil(), joint, *layers, whole, *walls, laid, formulation(cover, "penalty")]
    head = 'plane = "strain"\n[gravity]\n[contact]\n'
    run = nmm.run(nmm.parse_scene(text.scene(head, tables)))
    assert run.summary.status == "converged", run.summary.sentence
    # Contact is solved to 1e-8 of its forces.
    assert np.abs(run.displacement).max() < 1e-10


STAGES = """
[[stages]]
name = "in place"
[[stages]]
name = "finer"
cover = { size = 2.0 }
[[stages]]
name = "let go"
supports = ["base", "left"]
[[stages]]
name = "again"
supports = ["base", "left", "right"]
[[stages]]
name = "coarser"
cover = { size = 3.0 }
"""
PRESSURE = 1e5


def slab(method: str, right: str = "", stages: str = "") -> nmm.Run:
    """Run a slab of 8 m by 4 m under one pressure across, between two walls."""
    tables = [
        soil(),
        text.box("slab", (0, 0), (8, 4)),
        support("base", [[0, 0], [8, 0]], "y"),
        support("left", [[0, 0], [0, 4]], "x"),
        support("right", [[8, 0], [8, 4]], "x") + right,
        f'[[initial_stresses]]\nblock = "all"\nstress = [{-PRESSURE}, 0, 0]\n',
        '[[monitors]]\nname = "wall"\npoint = [8, 2]\n',
        stages,
        formulation("triangles", method),
    ]
    return nmm.run(nmm.parse_scene(text.scene('plane = "strain"\n', tables)))


@pytest.mark.parametrize("method", ["penalty", "nitsche", "lagrange"])
def test_a_wall_that_is_let_go_moves_as_its_stress_says(method):
    """It is ``p L (1 - nu^2) / E`` at the end that is let go."""
    run = slab(method, stages=STAGES)
    assert run.summary.status == "converged", run.summary.sentence
    way = run.history["monitor:wall:ux"]
    assert np.abs(way[:2]).max() < STILL
    # Springs of 1e2 to 1e3 moduli over a cell give by 1e-3 of it.
    far = PRESSURE * 8 * (1 - RATIO**2) / MODULUS
    assert way[2] == pytest.approx(far, rel=2e-3 if method == "penalty" else 1e-9)
    assert way[3:] == pytest.approx(way[2], abs=STILL)
    assert abs(run.summary.energy_balance) < 1e-9


@pytest.mark.parametrize("method", ["penalty", "nitsche", "lagrange"])
def test_work_of_a_wall_that_is_driven_counts_the_stress_against_it(method):
    """It left out half of what the wall held at first: 7 % of the turnover."""
    summary = slab(method, right="displacement = [1e-3, 0]\n").summary
    assert abs(summary.energy_balance) < 1e-9


HANDED_OVER = """
[[viscous_boundaries]]
name = "below"
segment = [[0, 0], [8, 0]]
reactions = true
[[stages]]
name = "in place"
[[stages]]
name = "in time"
duration = 0.02
supports = ["left", "right"]
[inertia]
[formulation.integrator]
type = "newmark"
step = 2e-3
"""


@pytest.mark.parametrize("method", ["penalty", "nitsche", "lagrange"])
def test_a_viscous_boundary_takes_on_what_the_base_was_laid_with(method):
    more = [HANDED_OVER, formulation("triangles", method)]
    run = ground(more, (soil(), text.box("soil", (0, 0), (8, HIGH))))
    assert run.summary.status == "converged", run.summary.sentence
    assert np.abs(run.displacement).max() < STILL
