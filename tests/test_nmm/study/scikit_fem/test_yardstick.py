"""Finite elements of scikit-fem as a yardstick: meshes that fit, answers of their own, refusals."""

import sys

import numpy as np
import pytest
import shapely

import nmm
from nmm.errors import NmmError
from nmm.study.cost.cost_study import cost_study, yardsticks
from nmm.study.cost.report import cost_page
from nmm.study.scikit_fem.meshes import fitted_mesh
from nmm.study.scikit_fem.yardstick import run_elements

HEAD = """
title = "bar"
plane = "{plane}"
thickness = {thickness}
[materials.m]
young_modulus = 200.0
poisson_ratio = 0.3
density = 2.0
[[blocks]]
material = "m"
vertices = [[0, 0], [4, 0], [4, 1], [0, 1]]
{holes}
[[supports]]
name = "wall"
segment = [[0, 0], [0, 1]]
fix = ["x"]
[[supports]]
name = "pin"
point = [0, 0]
fix = ["y"]
[[monitors]]
name = "end"
point = [4, 0.37]
"""
PULL = """
[[loads]]
name = "pull"
kind = "edge"
segment = [[4, 0], [4, 1]]
traction = [3.0, 0]
"""


def scene(rest=PULL, plane="stress", thickness=1.0, holes=""):
    return nmm.parse_scene(HEAD.format(plane=plane, thickness=thickness, holes=holes) + rest)


def elements(degree=1, size=0.5):
    return nmm.Formulation.model_validate(
        {"cover": {"type": "skfem", "degree": degree, "size": size}}
    )


@pytest.mark.parametrize("degree", [1, 2, 3, 4])
@pytest.mark.parametrize(("plane", "modulus"), [("stress", 200.0), ("strain", 200 / (1 - 0.09))])
def test_a_pulled_bar_is_exact_for_every_degree(degree, plane, modulus):
    # a linear field is in every space: u = s L / E', energy s^2 L h t / (2 E')
    run = run_elements(scene(plane=plane, thickness=0.7), elements(degree))
    # a monitor on the outline is read 1e-9 of the extent inside it
    assert run.history["monitor:end:ux"][-1] == pytest.approx(3 / modulus * 4, rel=2e-9)
    assert run.history["external_work"][-1] == pytest.approx(0.7 * 9 / modulus * 4 / 2, rel=1e-10)


def test_weight_along_the_bar_is_exact_from_degree_two():
    # u(L) = rho g L^2 / (2 E') with nu = 0: a quadratic field
    weight = "[gravity]\nacceleration = [10.0, 0.0]\n"
    text = (HEAD.format(plane="stress", thickness=1, holes="") + weight).replace("= 0.3", "= 0.0")
    run = run_elements(nmm.parse_scene(text), elements(2))
    assert run.history["monitor:end:ux"][-1] == pytest.approx(2 * 10 * 16 / 400, rel=1e-10)


def test_the_mesh_fills_an_outline_with_a_hole_and_short_edges():
    ring = [(0, 0), (4, 0), (4, 3), (2.05, 3), (2, 2.95), (0, 3)]
    angle = np.linspace(0, 2 * np.pi, 24, endpoint=False)
    hole = np.stack([1 + 0.3 * np.cos(angle), 1 + 0.3 * np.sin(angle)], axis=1)
    body = shapely.Polygon(ring, [hole])
    mesh = fitted_mesh(body, [], np.array([[1.3, 0.0]]), 0.5)
    corner = mesh.p[:, mesh.t].transpose(2, 1, 0)
    assert shapely.area(shapely.polygons(corner)).sum() == pytest.approx(body.area, rel=1e-12)
    # every edge of the boundary lies on the outline, and the mark is a node
    middle = mesh.p[:, mesh.facets[:, mesh.boundary_facets()]].mean(axis=1).T
    assert shapely.distance(shapely.points(middle), body.boundary).max() < 1e-12
    assert np.hypot(*(mesh.p.T - [1.3, 0.0]).T).min() < 1e-12
    # no sliver: 4 sqrt(3) area / sum of squared sides is 1 for an equal-sided triangle
    sides = ((corner - np.roll(corner, 1, axis=1)) ** 2).sum(axis=(1, 2))
    assert (4 * np.sqrt(3) * shapely.area(shapely.polygons(corner)) / sides).min() > 0.3


def test_faces_of_a_crack_part_and_its_tip_holds():
    plate = shapely.box(0, -1, 1, 1)
    whole = fitted_mesh(plate, [], np.zeros((0, 2)), 0.2)
    mesh = fitted_mesh(plate, [np.array([[0, 0], [0.5, 0]])], np.zeros((0, 2)), 0.2)
    on = (np.abs(mesh.p[1]) < 1e-12) & (mesh.p[0] <= 0.5 + 1e-12)
    x, copies = np.unique(np.round(mesh.p[0, on], 9), return_counts=True)
    assert copies.tolist() == [2] * (len(x) - 1) + [1]
    # Euler: a slit that opens to the outline leaves one piece without holes
    for one in (whole, mesh):
        assert one.nvertices - one.nfacets + one.nelements == 1


def test_a_crack_through_the_body_leaves_two_pieces():
    mesh = fitted_mesh(shapely.box(0, 0, 2, 1), [np.array([[1, 0], [1, 1]])], np.zeros((0, 2)), 0.3)
    assert mesh.nvertices - mesh.nfacets + mesh.nelements == 2


@pytest.mark.parametrize(
    ("rest", "what"),
    [
        (PULL + "[interfaces.j]\nfriction_angle = 0.5\n[contact]\n", r"\[contact\]"),
        (PULL + "[loading]\nuntil = 2.0\n", r"\[loading\]"),
        (
            '[[blocks]]\nmaterial = "m"\nvertices = [[5, 0], [6, 0], [6, 1]]\n'
            '[[supports]]\nname = "b"\nsegment = [[5, 0], [6, 0]]\nfix = ["x", "y"]\n',
            r"2 \[\[blocks\]\]",
        ),
    ],
)
def test_what_the_elements_do_not_carry_is_named(rest, what):
    with pytest.raises(NmmError, match=f"scikit-fem: the scene has {what}: expected linear"):
        run_elements(scene(rest), elements())


def test_a_point_load_inside_the_body_is_named():
    load = '[[loads]]\nname = "jack"\nkind = "point"\npoint = [2.01, 0.5]\nforce = [1, 0]\n'
    with pytest.raises(NmmError, match="scikit-fem: jack: its point is no node"):
        run_elements(scene(load), elements())


def test_a_yardstick_stands_beside_a_manifold_in_a_study():
    kinds = {"NMM": nmm.Formulation.model_validate({"cover": {"type": "triangles"}})}
    vary = {"formulation.cover.size": [1.0, 0.5]}
    study = cost_study(
        scene(), kinds | yardsticks(["P1", "P2"]), vary, "external_work", 1, memory=False
    )
    assert [one.family for one in study.records] == ["manifold"] * 2 + ["elements"] * 4
    assert all(one.valid for one in study.records)
    # the pulled bar lies in every space: 9 x 4 / (2 x 200)
    work = [one.quantities["external_work"] for one in study.records]
    assert work == pytest.approx([0.09] * 6, rel=1e-6)
    assert all(set(one.phases) >= {"covers", "assembly", "solve"} for one in study.records)


def test_scenes_the_elements_do_not_carry_are_failures_with_a_reason():
    kinds = {"DDA": nmm.Formulation()} | yardsticks(["P1"])
    text = HEAD.format(plane="stress", thickness=1, holes="")
    moving = nmm.parse_scene("duration = 0.01\n" + text + "[inertia]\n")
    vary = {"formulation.integrator.step": [4e-3, 2e-3]}
    study = cost_study(moving, kinds, vary, "energy", 1, memory=False)
    page = cost_page(study, "cost.png")
    assert "scikit-fem: the scene has [inertia]: expected linear statics of one" in page


def test_an_element_that_is_not_offered_is_named():
    with pytest.raises(NmmError, match="--yardstick Q1: expected some of P1, P2, P3, P4"):
        yardsticks(["Q1"])


def test_a_mesh_without_the_package_that_makes_it_says_what_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, "triangle", None)
    with pytest.raises(NmmError, match="pip install triangle"):
        fitted_mesh(shapely.box(0, 0, 1, 1), [], np.zeros((0, 2)), 0.5)
