"""Seepage with a free surface: discharge, pressures beside an obstacle problem, rain."""

import subprocess
import sys

import numpy as np
import pytest
from scipy.sparse import diags_array, eye_array, kron
from scipy.sparse.linalg import spsolve

import nmm
from nmm.errors import NmmError
from nmm.formulation import parse_formulation
from nmm.scene.read import parse_scene
from nmm.study.samples import elements_at, fields

COVERS = {
    "quads": 'type = "quads"\nsize = 1.0\ndegree = 0',
    "aslant": 'type = "quads"\nsize = 0.9\nangle = 0.3\ndegree = 0',
    "triangles": 'type = "triangles"\nsize = 0.9\ndegree = 1',
    "splines": 'type = "bspline"\nsize = 1.0\ndegree = 0',
    "quadratic": 'type = "triangles"\nsize = 1.5\ndegree = 2',
}
SOIL = """
[materials.{name}]
young_modulus = 50e6
poisson_ratio = 0.3
density = 2000.0
hydraulic_conductivity = {k}
"""
HEAD = '[[heads]]\nname = "{name}"\nsegment = {segment}\nhead = {head}\n'
WEIGHT = 9810.0


def block(name, corners, soil="soil"):
    return f'[[blocks]]\nname = "{name}"\nmaterial = "{soil}"\nvertices = {corners}\n'


def held(segment):
    return f'[[supports]]\nname = "base"\nsegment = {segment}\nfix = ["x", "y"]\n'


def dam(high=10.0, low=2.0, length=8.0, height=12.0, base=0.0, more=""):
    """A rectangular dam between two levels above its base."""
    corners = [[0, base], [length, base], [length, base + height], [0, base + height]]
    left, right = [corners[0], corners[3]], [corners[1], corners[2]]
    return (
        'plane = "strain"\n[seepage]\nfree_surface = true\n'
        + SOIL.format(name="soil", k=1e-6)
        + block("dam", corners)
        + held([corners[0], corners[1]])
        + HEAD.format(name="up", segment=left, head=base + high)
        + HEAD.format(name="down", segment=right, head=base + low)
        + more
    )


def run(scene, cover="quads"):
    text = f"[cover]\n{COVERS.get(cover, cover)}\n"
    return nmm.run(parse_scene(scene), formulation=parse_formulation(text))


def pressure_heads(found, points):
    """Pressure (m of water) of a run's last state at points (m, 2)."""
    seepage = found.stepper.plan.effects["seepage"]
    elements = elements_at(found.manifold.elements, points)
    return seepage.space.values(elements, points) @ seepage.acting(found.state.time) / WEIGHT


@pytest.mark.parametrize("cover", COVERS)
def test_a_rectangular_dam_gives_the_discharge_of_dupuit(cover):
    found = run(dam(), cover)
    exact = 1e-6 * (10**2 - 2**2) / (2 * 8)
    taken = [found.history[f"seepage:taken:{name}"][-1] for name in ("up", "down")]
    # The level cuts cells: the quadrature of what is held along an edge is all that is inexact.
    assert taken[0] == pytest.approx(exact, rel=2e-3)
    assert taken[0] + taken[1] == pytest.approx(0.0, abs=1e-9 * exact)


@pytest.mark.parametrize(("high", "low", "length"), [(10.0, 0.0, 5.0), (6.0, 5.5, 12.0)])
def test_so_it_does_whatever_its_levels_and_wherever_it_stands(high, low, length):
    found = run(dam(high, low, length, base=-30.0))
    exact = 1e-6 * (high**2 - low**2) / (2 * length)
    assert found.history["seepage:taken:up"][-1] == pytest.approx(exact, rel=2e-3)


def test_upright_layers_resist_in_series():
    found = run(
        'plane = "strain"\n[seepage]\nfree_surface = true\n'
        + SOIL.format(name="soil", k=1e-6)
        + SOIL.format(name="clay", k=1e-7)
        + '[interfaces.skin]\nfriction_angle = 0.5\nbonded = true\nleakage = "perfect"\n'
        + block("shell", [[0, 0], [6, 0], [6, 12], [0, 12]])
        + block("core", [[6, 0], [8, 0], [8, 12], [6, 12]], "clay")
        + held([[0, 0], [8, 0]])
        + HEAD.format(name="up", segment=[[0, 0], [0, 12]], head=10.0)
        + HEAD.format(name="down", segment=[[8, 0], [8, 12]], head=2.0)
    )
    exact = (10**2 - 2**2) / 2 / (6 / 1e-6 + 2 / 1e-7)
    # Girinskii's potential is continuous where water is held to pass, by a method that is weak.
    assert found.history["seepage:taken:up"][-1] == pytest.approx(exact, rel=5e-3)


def obstacle(high, low, length, height, h):
    """Pressure heads on a grid by Baiocchi's transform ``W = int p dy``: W >= 0, lap W <= 1.

    Five points, active sets; the base is linear in x as nothing flows through it.
    """
    x, y = np.arange(0, length + h / 2, h), np.arange(0, height + h / 2, h)
    value = np.zeros((len(x), len(y)))
    value[0] = np.maximum(high - y, 0) ** 2 / 2
    value[-1] = np.maximum(low - y, 0) ** 2 / 2
    value[:, 0] = np.linspace(high**2 / 2, low**2 / 2, len(x))
    second = [
        diags_array([1.0, -2.0, 1.0], offsets=[-1, 0, 1], shape=(n, n)) / h**2
        for n in (len(x) - 2, len(y) - 2)
    ]
    matrix = kron(second[0], eye_array(len(y) - 2)) + kron(eye_array(len(x) - 2), second[1])
    side = np.zeros((len(x) - 2, len(y) - 2))
    side[0] += value[0, 1:-1] / h**2
    side[-1] += value[-1, 1:-1] / h**2
    side[:, 0] += value[1:-1, 0] / h**2
    matrix, wet = matrix.tocsr(), np.ones(side.size, dtype=bool)
    while True:
        inner = np.zeros(side.size)
        inner[wet] = spsolve(matrix[wet][:, wet].tocsc(), (1 - side.ravel())[wet])
        rest = matrix @ inner + side.ravel() - 1
        now = np.where(wet, inner > 0, rest > 1e-9)
        if (now == wet).all():
            break
        wet = now
    value[1:-1, 1:-1] = inner.reshape(side.shape)
    return x, y, -np.gradient(value, h, axis=1)


def test_pressures_are_those_of_the_obstacle_problem():
    x, y, exact = obstacle(10.0, 2.0, 8.0, 12.0, 0.1)
    found = run(dam(), 'type = "quads"\nsize = 0.5\ndegree = 0')
    at = [(i, j) for i in (10, 25, 40, 55, 70) for j in range(10, 110, 10)]
    points = np.array([[x[i], y[j]] for i, j in at])
    heads = pressure_heads(found, points)
    missed = heads - np.array([exact[i, j] for i, j in at])
    # a cell is half a metre high; the grid of the other one is 0.1 m
    assert np.abs(missed).max() < 0.1
    assert np.sqrt((missed**2).mean()) < 0.03


def test_pores_under_still_water_are_full_and_those_above_it_empty():
    scene = (
        'plane = "strain"\n[gravity]\n[seepage]\nfree_surface = true\n'
        + SOIL.format(name="soil", k=1e-6)
        + block("column", [[0, 0], [2, 0], [2, 10], [0, 10]])
        + "".join(
            f'[[supports]]\nname = "{name}"\nsegment = {segment}\nfix = {fix}\n'
            for name, segment, fix in (
                ("left", [[0, 0], [0, 10]], ["x"]),
                ("right", [[2, 0], [2, 10]], ["x"]),
                ("low", [[0, 0], [2, 0]], ["y"]),
            )
        )
        + HEAD.format(name="below", segment=[[0, 0], [2, 0]], head=6.0)
    )
    found = run(scene, 'type = "quads"\nsize = 0.5\ndegree = 0')
    y = np.array([0.7, 2.3, 4.7, 7.8, 9.3])
    points = np.stack([np.full(5, 0.9), y], axis=1)
    heads = pressure_heads(found, points)
    np.testing.assert_allclose(heads[:3], 6 - y[:3], rtol=0, atol=2e-3)
    # what is left of the surface, of a cell, dies out by its own width
    np.testing.assert_allclose(heads[3:], 0.0, rtol=0, atol=2e-2)
    effective = fields(found, points).stress[:, 1] + WEIGHT * heads
    weight = 2000 * 9.81 * (10 - y)
    # cells of constant strain carry the mean of a cell
    np.testing.assert_allclose(effective, WEIGHT * np.maximum(6 - y, 0) - weight, atol=6e3)


def test_rain_falls_through_empty_pores_to_the_water():
    scene = dam(
        3.0, 3.0, more='[[inflows]]\nname = "rain"\nsegment = [[0, 12], [8, 12]]\nvelocity = 2e-8\n'
    )
    found = run(scene)
    taken = {name: found.history[f"seepage:taken:{name}"][-1] for name in ("rain", "up", "down")}
    assert taken["rain"] == pytest.approx(8 * 2e-8, rel=1e-12)
    assert taken["up"] == pytest.approx(taken["down"], rel=1e-9)
    assert sum(taken.values()) == pytest.approx(0.0, abs=1e-9 * taken["rain"])
    velocity = found.stepper.plan.effects["seepage"].flux(found.state)
    middle = found.manifold.elements.centroids
    inner = (np.abs(middle[:, 0] - 4) < 1) & (np.abs(middle[:, 1] - 9) < 1)
    # edges that are open to the air draw some of it aside
    assert inner.sum() == 4
    np.testing.assert_allclose(velocity[inner, 1], -2e-8, rtol=0.05)


@pytest.mark.parametrize(
    ("change", "line"),
    [
        (
            (
                "free_surface = true",
                "free_surface = true\ntransient = true\ninitial = 3\ncoupled = true",
            ),
            "coupled",
        ),
        (("head = 2.0", "head = 2.0\nhistory = [[0, 1], [1, 0.5]]"), "history"),
    ],
)
def test_what_it_does_not_know_is_refused_by_line(change, line):
    with pytest.raises(NmmError) as fault:
        run(dam().replace(*change))
    assert line in str(fault.value)
    assert "free_surface" in str(fault.value)


def test_nothing_of_it_is_imported_where_it_is_not_asked_for():
    code = (
        "import sys, nmm\n"
        f"nmm.run(nmm.parse_scene({dam().replace('free_surface = true', '')!r}))\n"
        "assert 'nmm.water.seepage' in sys.modules\n"
        "assert 'nmm.water.free_surface' not in sys.modules\n"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


@pytest.mark.parametrize("across", [0.25e-6, 4e-6])
@pytest.mark.parametrize("cover", ["quads", "triangles"])
def test_a_dam_of_beds_lets_through_what_they_conduct_along_its_base(cover, across):
    """``k_xx (h1^2 - h2^2) / 2 L``: Charny's argument with the test function x, whatever k_yy."""
    scene = dam().replace(
        "hydraulic_conductivity = 1e-06",
        f"hydraulic_conductivity = 1e-06\nhydraulic_conductivity_2 = {across}",
    )
    found = run(scene, cover).history["seepage:taken:up"][-1]
    assert found == pytest.approx(1e-6 * (10.0**2 - 2.0**2) / 16, rel=2e-3)


def test_beds_that_rise_to_the_other_side_let_through_as_much_the_other_way():
    flows = []
    for rise, levels, inlet in ((25, (10.0, 2.0), "up"), (-25, (2.0, 10.0), "down")):
        scene = dam(*levels).replace(
            "hydraulic_conductivity = 1e-06",
            f"hydraulic_conductivity = 1e-06\nhydraulic_conductivity_2 = 1e-7\n"
            f'axis_angle = "{rise} deg"',
        )
        flows.append(run(scene).history[f"seepage:taken:{inlet}"][-1])
    # Triangles of the quadrature of the saturation are not mirrored.
    assert flows[0] == pytest.approx(flows[1], rel=1e-4)
    other = run(scene.replace("-25", "25")).history["seepage:taken:down"][-1]
    assert abs(other - flows[0]) > 0.01 * flows[0]


def test_axes_of_what_is_alike_in_all_directions_are_refused_by_line():
    scene = dam().replace("density = 2000.0", "axis_angle = 0.3")
    with pytest.raises(NmmError, match="axis_angle.*expected a law that has it: orthotropic"):
        run(scene)
