"""Stress averaged about tips, principal stresses, and fronts of zones."""

import numpy as np
import pytest

from nmm.formulation import parse_formulation
from nmm.fracture.cohesive.mean_stress import StressMeans
from nmm.fracture.cohesive.zone_fronts import zone_fronts
from nmm.geometry.blocks import Regions
from nmm.geometry.geometry import Geometry
from nmm.materials.elastic import Elastic
from nmm.materials.principal_stresses import PrincipalStresses
from nmm.model.from_polygons import solid
from nmm.verification.continuum import polygon

NET = '[cover]\ntype = "triangles"\nsize = 0.2\ndegree = 1\nangle = 0.3\n'


@pytest.fixture(scope="module")
def square():
    cover = parse_formulation(NET).cover
    shape = polygon([(0, 0), (1, 0), (1, 1), (0, 1)])
    return solid(shape, cover, [Elastic(1.0, 0.0)], "stress")


def linear_field(model, slope):
    """Unknowns of ``ux = slope x y``: stress s_xx = slope y, s_xy = slope x / 2."""
    points = model.manifold.elements.points
    elements = model.manifold.elements.polygon_of_point
    rows = model.manifold.rows(elements, points)
    matrix = np.zeros((2 * len(points), model.manifold.n_unknowns))
    for axis in range(2):
        np.add.at(
            matrix,
            (np.arange(len(points))[:, None] * 2 + axis, rows.unknowns),
            rows.values[:, axis],
        )
    wanted = np.stack([slope * points[:, 0] * points[:, 1], 0 * points[:, 0]], axis=1)
    return np.linalg.lstsq(matrix, wanted.ravel(), rcond=None)[0]


def test_means_of_a_linear_stress_are_that_of_the_middle(square):
    # Weights that are even about an inner point: the mean of a linear field is its value there. The
    # rule of an element is blind to where the weights end, which leaves a few per cent.
    place = np.array([[0.5, 0.5]])
    means = StressMeans.about(square, place, np.zeros(1, dtype=int), 0.3)
    found = means.of(linear_field(square, 2.0))
    assert found[0] == pytest.approx([1.0, 0.0, 0.5], abs=0.04)


def test_only_what_is_ahead_weighs(square):
    place, up = np.array([[0.5, 0.5]]), np.array([[0.0, 1.0]])
    means = StressMeans.about(square, place, np.zeros(1, dtype=int), 0.3, up)
    assert means.of(linear_field(square, 2.0))[0, 0] > 1.1


def test_principal_stress_of_sp6():
    # (2, -1, 1.5): 2.6213203436 at 22.5 degrees; the plane opens along 112.5.
    found = PrincipalStresses.of(np.array([[2.0, -1.0, 1.5]]))
    assert found.larger[0] == pytest.approx(2.6213203436, rel=1e-10)
    angle = np.radians(112.5)
    assert found.plane[0] == pytest.approx([np.cos(angle), np.sin(angle)], rel=1e-12)


@pytest.mark.parametrize("turn", [0.3, 1.1, 2.5])
def test_principal_stress_turns_with_the_axes(turn):
    c, s = np.cos(turn), np.sin(turn)
    matrix = np.array([[c, -s], [s, c]]) @ np.diag([3.0, -1.0]) @ np.array([[c, s], [-s, c]])
    found = PrincipalStresses.of(np.array([[matrix[0, 0], matrix[1, 1], matrix[0, 1]]]))
    assert found.larger[0] == pytest.approx(3.0, rel=1e-12)
    assert found.plane[0] @ [c, s] == pytest.approx(0.0, abs=1e-12)


def test_zones_take_over_the_fronts_of_cracks_and_nuclei_have_two():
    shape = polygon([(0, 0), (1, 0), (1, 1), (0, 1)])
    regions = Regions(shape, np.zeros(1, dtype=int), ("b",), np.arange(1))
    notch = np.array([[0.0, 0.5], [0.3, 0.5]])
    zone = np.array([[0.3, 0.5], [0.4, 0.5], [0.5, 0.55]])
    nucleus = np.array([[0.8, 0.8], [0.9, 0.8]])
    fronts = zone_fronts(Geometry(regions, (notch, zone, nucleus), bonded=(1, 2)), ["notch"])
    assert fronts.name == ("notch:start", "notch:end", "nucleus 1:start", "nucleus 1:end")
    assert fronts.crack.tolist() == [0, 1, 2, 2]
    assert fronts.points((notch, zone, nucleus))[1].tolist() == [0.5, 0.55]
