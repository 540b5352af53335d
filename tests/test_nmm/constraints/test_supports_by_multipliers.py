"""Lagrange supports along kinked and curved edges, and in scenes with contact."""

import numpy as np
import pytest
from scipy.sparse import csc_array, csr_array

from integration.arrays import Floats
from integration.polygons import Polygons
from integration.rules import polygon_rule
from nmm.assembly.errors import stresses
from nmm.assembly.places import on_edges
from nmm.constraints.imposition import Method
from nmm.constraints.supports import Supports
from nmm.contact.enforcement.base import make_enforcement
from nmm.contact.enforcement.null_space import NullSpace
from nmm.contact.problem.step_problem import Limits, StepProblem
from nmm.contact.problem.transform import solve_through
from nmm.formulation import CoverTable, parse_formulation
from nmm.materials.elastic import Elastic
from nmm.model.from_polygons import solid
from nmm.scene import parse_scene
from nmm.solvers.linear import make_solver
from nmm.stepping.drive.linear_statics import equilibrium, hold
from nmm.stepping.run import Run, run
from nmm.testing.scenes import block_on_slab
from nmm.verification import text

STRESS = np.array([1.032967033, 0.1098901099, 0.1923076923])


def linear(x: Floats) -> Floats:
    return np.asarray(x @ np.array([[1e-3, 2.5e-4], [2.5e-4, -2e-4]]))


def patch(corners: int, kind: str, degree: int) -> float:
    """Benchmark A1a on a regular polygon held all around: largest error of a stress of 1."""
    t = 2 * np.pi * np.arange(corners) / corners
    ring = np.stack([np.cos(t), np.sin(t)], axis=1)
    cover = CoverTable(type=kind, size=0.31, degree=degree, angle=0.4, shift=(0.2, 0.3))
    region = Polygons.from_vertices([ring])
    model = solid(region, cover, [Elastic(1000.0, 0.3)], "stress")
    edges = on_edges(model.manifold, np.ones(len(model.manifold.boundary), dtype=bool), 8)
    found = equilibrium(model, [hold(model, edges, Method("lagrange", 0.31, degree), linear)])
    assert found.residual < 1e-10
    rule = polygon_rule(model.manifold.elements, 2)
    return float(np.abs(stresses(model, found.state.deformation, rule) - STRESS).max())


@pytest.mark.parametrize("kind", ["triangles", "quads"])
@pytest.mark.parametrize("degree", [0, 1, 2])
@pytest.mark.parametrize("corners", [3, 8, 16])
def test_polygons_held_by_multipliers_pass_the_patch_test(
    corners: int, degree: int, kind: str
) -> None:
    # The printed stress has ten figures.
    assert patch(corners, kind, degree) < 1e-9


HALVES = [
    text.fixed_edge("left half", ((0, 0), (1, 0))),
    text.fixed_edge("right half", ((1, 0), (2, 0))),
]
BASE = block_on_slab(0.2, HALVES)
COVER = '[cover]\ntype = "triangles"\nsize = 0.3\ndegree = 1\nangle = 0.3\n'
WEIGHT = 9.81 * 2000 * 1.36


def simulate(scene: str, method: str, enforcement: str, degree: int = 1) -> Run:
    cover = COVER.replace("degree = 1", f"degree = {degree}")
    text = f'[supports]\nmethod = "{method}"\n[contact]\nenforcement = "{enforcement}"\n'
    found = run(parse_scene(scene, "scene"), parse_formulation(cover + text))
    assert found.summary.status == "converged", found.summary.sentence
    return found


def reaction(found: Run) -> float:
    return sum(found.history[f"reaction:{side} half:y"][-1] for side in ("left", "right"))


@pytest.mark.parametrize(
    ("enforcement", "degree"), [("penalty", 1), ("lagrange", 1), ("augmented", 0), ("cone", 0)]
)
def test_a_block_on_a_slab_held_by_multipliers_hands_its_weight_down(
    enforcement: str, degree: int
) -> None:
    found = simulate(BASE, "lagrange", enforcement, degree)
    assert reaction(found) == pytest.approx(WEIGHT, rel=1e-8)
    other = simulate(BASE, "nitsche", enforcement, degree)
    # Two methods on cells of 0.3: measured 0.25 % apart with degree 1, 1.4 % with degree 0.
    way = [one.history["monitor:top:uy"][-1] for one in (found, other)]
    assert way[0] == pytest.approx(way[1], rel=1e-2 if degree else 3e-2)
    assert found.summary.condition_estimate is not None
    assert other.summary.condition_estimate is not None
    assert found.summary.condition_estimate < 10 * other.summary.condition_estimate


def test_multipliers_hold_a_slab_while_a_block_bounces_on_it() -> None:
    moving = "duration = 0.02\n" + BASE.replace("[gravity]", "[gravity]\n[inertia]")
    found = simulate(moving, "lagrange", "penalty")
    other = simulate(moving, "nitsche", "penalty")
    # Measured 0.1 % apart, far from the weight at this instant.
    assert reaction(found) == pytest.approx(reaction(other), rel=1e-2)
    assert abs(reaction(found) / WEIGHT - 1) > 0.1
    assert abs(found.summary.energy_balance or 1.0) < 1.5 * abs(other.summary.energy_balance or 0)


def test_conditions_in_contact_give_what_a_bordered_system_gives() -> None:
    random = np.random.default_rng(3)
    n, k = 14, 4
    half = random.normal(size=(n, n))
    matrix, force = half @ half.T + np.eye(n), random.normal(size=n)
    rows = random.normal(size=(k, n))
    rows[3] = rows[0] - 2 * rows[1]  # one condition says nothing new
    sides = random.normal(size=k)
    sides[3] = sides[0] - 2 * sides[1]
    contact = random.normal(size=(1, n))
    one = np.ones(1)
    problem = StepProblem(
        csc_array(matrix),
        force,
        csr_array(contact),
        csr_array(random.normal(size=(1, n))),
        gap=-5 * one,
        slip=0 * one,
        normal_stiffness=7 * one,
        shear_stiffness=one,
        limits=Limits(0 * one, 0 * one, 0 * one),
        state=np.ones(1, dtype=np.int64),
        normal_force=0 * one,
        shear_force=0 * one,
    )
    held = NullSpace.of(csr_array(rows), sides)
    answer = solve_through(
        [held], problem, lambda changed: make_enforcement("penalty").solve(changed, make_solver())
    )
    assert answer.verdict.converged
    assert answer.normal_force[0] < 0
    whole = np.zeros((n + 3, n + 3))
    whole[:n, :n] = matrix + 7 * contact.T @ contact
    whole[n:, :n], whole[:n, n:] = rows[:3], rows[:3].T
    load = np.concatenate([force + 7 * 5 * contact[0], sides[:3]])
    expected = np.linalg.solve(whole, load)
    np.testing.assert_allclose(answer.increment, expected[:n], rtol=1e-9)
    assert answer.multipliers is not None
    np.testing.assert_allclose(rows.T @ answer.multipliers, rows[:3].T @ expected[n:], rtol=1e-8)


def test_a_rim_of_many_short_supports_has_the_multipliers_of_one_edge() -> None:
    t = np.linspace(0, np.pi / 2, 129)
    c = np.stack([np.cos(t), np.sin(t)], axis=1)
    c[0], c[-1] = [1.0, 0.0], [0.0, 1.0]
    ring = np.concatenate([2 * c, 0.4 * c[::-1]]).tolist()
    rim = "".join(
        f'[[supports]]\nname = "o{i}"\nsegment = {(2 * c[i : i + 2]).tolist()}\n'
        f'fix = ["x", "y"]\ndisplacement = {(c[i] + c[i + 1]).tolist()}\n'
        for i in range(128)
    )
    scene = f"""
plane = "strain"
[materials.m]
young_modulus = 1
poisson_ratio = 0.3
[[blocks]]
name = "ring"
material = "m"
vertices = {ring}
[[supports]]
name = "x"
segment = [[0, 0.4], [0, 2]]
fix = ["x"]
[[supports]]
name = "y"
segment = [[0.4, 0], [2, 0]]
fix = ["y"]
{rim}"""
    text = COVER.replace("0.3\nd", "0.2\nd") + '[supports]\nmethod = "lagrange"\n'
    found = run(parse_scene(scene, "scene"), parse_formulation(text))
    assert found.summary.status == "converged", found.summary.sentence
    supports = found.stepper.plan.supports
    assert isinstance(supports, Supports)
    # Linear tractions (4 a group) on pi / (2 x 0.2) groups of the arc, a few at its ends and those
    # of two straight sides of 1.6 (2 a group, 4 groups).
    assert supports.multipliers <= 4 * 8 + 2 * 2 * 4
    # Lame: u = A r + B / r without traction at 0.4 and u(2) = 2; the energy is that of the rim's
    # traction. E = 1, nu = 0.3: lambda + mu = 0.9615385, mu = 0.3846154.
    a, b, k, mu = 0.4, 2.0, 1 / 1.04, 1 / 2.6
    big_a = 1 / (1 + k / mu * a**2 / b**2)
    traction = 2 * k * big_a * (1 - a**2 / b**2)
    energy = 0.5 * traction * 2.0 * (2 * np.pi * b) / 4
    # The polygon and its chords: 1e-4.
    assert found.history["strain_energy"][-1] == pytest.approx(energy, rel=1e-3)


RELIEVED = """
plane = "strain"
[materials.m]
young_modulus = 1e10
poisson_ratio = 0.2
density = 1e-3
[gravity]
[contact]
[interfaces.i]
friction_angle = 0.5
[[blocks]]
name = "lower"
material = "m"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[blocks]]
name = "upper"
material = "m"
vertices = [[0.1, 1], [0.9, 1], [0.9, 2], [0.1, 2]]
[[initial_stresses]]
block = "upper"
stress = [-1e6, -1e6, 0]
[[supports]]
name = "floor"
segment = [[0, 0], [1, 0]]
fix = ["y"]
[[supports]]
name = "stop"
point = [0, 0]
fix = ["x"]
[[supports]]
name = "side"
point = [0.1, 1.5]
fix = ["x"]
[[monitors]]
name = "top"
point = [0.5, 2]
block = "upper"
"""


def test_a_light_block_on_another_sheds_a_stress_of_a_million_times_its_weight():
    """What is left of forces that cancel is judged by these, beside contact as without."""
    table = '[cover]\ntype = "quads"\nsize = 0.5\nangle = 0.3\ndegree = 1\n'
    table += '[contact]\nenforcement = "cone"\n[supports]\nmethod = "lagrange"\n'
    found = run(parse_scene(RELIEVED), parse_formulation(table))
    assert found.summary.status == "converged", found.summary.sentence
    # Both stresses are shed in plane strain: (1 + nu) (1 - 2 nu) p h / E.
    assert found.history["monitor:top:uy"][-1] == pytest.approx(1.2 * 0.6 * 1e-4, rel=1e-6)
