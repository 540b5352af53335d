"""Contacts on faces that bend: their normals, and that what slides along a face makes no energy."""

import numpy as np
import pytest

import nmm
from nmm.assembly.material_points import material_points
from nmm.contact.points.bent_faces import bent_normals, turned
from nmm.formulation import parse_formulation
from nmm.frozen import with_parts
from nmm.scene.read import parse_scene
from nmm.stepping.prepare import prepare

DROP = """
plane = "stress"
duration = "0.6 ms"
[materials.m]
density = 2400
young_modulus = "20 GPa"
poisson_ratio = 0.2
[interfaces.any]
friction_angle = 0.0
[[blocks]]
name = "beam"
material = "m"
vertices = [[-0.5, 0.0], [0.5, 0.0], [0.5, 0.2], [-0.5, 0.2]]
[[blocks]]
name = "left"
material = "m"
vertices = [[-0.45, -0.1], [-0.35, -0.1], [-{edge}, 0.0]]
[[blocks]]
name = "right"
material = "m"
vertices = [[0.35, -0.1], [0.45, -0.1], [{edge}, 0.0]]
[[supports]]
name = "l"
block = "left"
fix = ["x", "y"]
[[supports]]
name = "r"
block = "right"
fix = ["x", "y"]
[inertia]
[contact]
[[initial_velocities]]
block = "beam"
velocity = [0, -2]
"""
NET = """
[cover]
type = "quads"
size = 0.025
degree = {degree}
[integrator]
type = "newmark"
step = "10 us"
"""


@pytest.mark.parametrize("degree", [1, 2])
@pytest.mark.parametrize("update", ["exact", "small"])
def test_normals_are_across_the_material_where_it_is(degree: int, update: str) -> None:
    more = f'[rotation]\nupdate = "{update}"\n'
    net = parse_formulation(NET.replace("0.025", "0.1").format(degree=degree) + more)
    made = prepare(parse_scene(DROP.format(edge=0.4)), net)
    contact, start = made.stepper.plan.contact, made.start
    bend = 1e-2 * np.random.default_rng(1).normal(size=len(start.deformation))
    state = with_parts(start, deformation=bend)
    points, boundary = contact.candidates(start, 0.2, None), made.stepper.model.manifold.boundary
    points = points.take(~points.is_joint)
    edge, s = points.edge_b, np.clip(points.parameter_b, 1e-3, 1 - 1e-3)
    points = with_parts(points, parameter_b=s, normal=contact.partners.surface(state).normal[edge])
    places = [
        material_points(
            made.stepper.model.manifold, boundary.element[edge], boundary.at(edge, s + ahead)
        ).place(state.frames, state.deformation)
        for ahead in (-1e-5, 1e-5)
    ]
    way = places[1] - places[0]
    found = bent_normals(contact.geometry.sides, points, state)
    # Central differences over 2e-5 of an edge: errors of 1e-10, rounding of 1e-16 / 1e-6.
    across = (found * way).sum(axis=1) / np.hypot(*way.T)
    assert len(points) == 2
    np.testing.assert_allclose(across, 0.0, atol=1e-8)
    np.testing.assert_allclose(np.hypot(*found.T), 1.0, rtol=1e-14)


def test_strain_without_bound_at_the_tip_of_a_crack_turns_no_normal() -> None:
    up, along = np.array([[0.0, 1.0]] * 3), np.array([[1.0, 0.0]] * 3)
    lines = np.array([[-6e9, 5e9], [1.0, 0.1], [0.0, 0.0]])
    found = turned(up, along, lines)
    slope = np.hypot(1.0, 0.1)
    np.testing.assert_allclose(found, [[0, 1], [-0.1 / slope, 1 / slope], [0, 1]], atol=1e-15)


@pytest.mark.parametrize(("degree", "edge"), [(1, 0.4), (1, 0.41), (2, 0.4)])
def test_a_beam_that_bends_on_two_edges_makes_no_energy(degree: int, edge: float) -> None:
    # Edges at corners of cells and within them; 2e-3 and 5e-3 came across chords.
    run = nmm.run(parse_scene(DROP.format(edge=edge)), parse_formulation(NET.format(degree=degree)))
    assert run.summary.status == "converged"
    assert run.summary.audits["energy_made_in_run"] < 1e-4
    # What steps of 10 us lose of the waves of an impact.
    assert 0 < run.summary.energy_balance < 0.02


@pytest.mark.parametrize("edge", [0.4, 0.41])
def test_energy_momentum_keeps_the_energy_of_a_beam_on_two_edges(edge: float) -> None:
    # Springs at corners act across chords, by discrete slopes; 2e-3 came under Newmark's rule.
    net = NET.format(degree=1).replace("0.025", "0.05").replace("newmark", "energy_momentum")
    more = '[rotation]\nupdate = "finite"\n'
    run = nmm.run(parse_scene(DROP.format(edge=edge)), parse_formulation(net + more))
    assert run.summary.status == "converged"
    assert run.summary.audits["energy_made_in_run"] < 1e-7
    assert abs(run.summary.energy_balance) < 1e-7
