"""Stress at points, recovered from the elements about them."""

import numpy as np
import pytest

from integration.arrays import Floats
from integration.polygons import Polygons
from nmm.assembly.errors import stresses
from nmm.assembly.model import Model
from nmm.assembly.places import Place, at_point, on_edges
from nmm.assembly.recovery import recovered_stress
from nmm.assembly.state import initial_state
from nmm.constraints.imposition import Method
from nmm.constraints.supports import Supports
from nmm.errors import GeometryError
from nmm.formulation import CoverTable, EnrichmentTable
from nmm.materials.elastic import Elastic
from nmm.model.from_polygons import solid
from nmm.stepping.drive.linear_statics import Equilibrium, equilibrium, hold, traction

SQUARE = Polygons.from_vertices([np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])])
LAW = Elastic(1000.0, 0.3)
SIZE = 0.25


def cover(position: tuple[float, tuple[float, float]], degree: int = 1) -> CoverTable:
    angle, shift = position
    return CoverTable(type="triangles", size=SIZE, degree=degree, angle=angle, shift=shift)


def kirsch(p: Floats) -> Floats:
    q, t = 1 / np.hypot(*p.T), np.arctan2(p[:, 1], p[:, 0])
    c2, c4, s2, s4 = np.cos(2 * t), np.cos(4 * t), np.sin(2 * t), np.sin(4 * t)
    xx = 1 - q**2 * (1.5 * c2 + c4) + 1.5 * q**4 * c4
    yy = -(q**2) * (0.5 * c2 - c4) - 1.5 * q**4 * c4
    return np.stack([xx, yy, -(q**2) * (0.5 * s2 + s4) + 1.5 * q**4 * s4], axis=1)


def pull(p: Floats, n: Floats) -> Floats:
    s = kirsch(p)
    x = s[:, 0] * n[:, 0] + s[:, 2] * n[:, 1]
    return np.stack([x, s[:, 2] * n[:, 0] + s[:, 1] * n[:, 1]], axis=1)


def plate_with_a_hole(position: tuple[float, tuple[float, float]]) -> Equilibrium:
    """Benchmark A5."""
    angle = np.linspace(np.pi / 2, 0, 257)
    arc = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    arc[0], arc[-1] = [0.0, 1.0], [1.0, 0.0]
    region = Polygons.from_vertices([np.array([*arc, [4, 0], [4, 4], [0, 4]])]).oriented()
    model = solid(region, cover(position), [LAW], "strain")
    edges = model.manifold.boundary
    x, y = ((edges.start + edges.end) / 2).T
    method = Method("nitsche", SIZE, 1)
    sides = [
        method.hold(model, on_edges(model.manifold, where, 6), lambda end: np.zeros(2), axes)
        for where, axes in ((x < 1e-9, (True, False)), (y < 1e-9, (False, True)))
    ]
    supports = Supports(sides, model.manifold.n_unknowns, initial_state(model.manifold))
    rest = on_edges(model.manifold, (x > 1e-9) & (y > 1e-9), 12)
    return equilibrium(model, [supports, traction(model, rest, pull)])


def at_the_point(found: Equilibrium, place: Place) -> Floats:
    from integration.rules import PointRule

    rule = PointRule(place.position, np.ones(len(place)), place.elements)
    return stresses(found.model, found.state.deformation, rule)[0]


POSITIONS = [
    (0.2, (0.3, 0.1)),
    (0.0, (0.0, 0.0)),
    (0.7, (0.1, 0.8)),
    (0.45, (0.6, 0.4)),
    (1.0, (0.2, 0.9)),
]


def test_the_peak_beside_a_hole_is_right_to_two_percent_wherever_the_net_lies() -> None:
    top, worst = np.array([[0.0, 1.0]]), 0.0
    for position in POSITIONS:
        found = plate_with_a_hole(position)
        assert found.energy == pytest.approx(7.693653726e-3, rel=5e-3)
        peak = recovered_stress(found.model, found.state.deformation, top, 2 * SIZE, 2)[0, 0]
        assert peak == pytest.approx(3.0, rel=0.015)
        raw = at_the_point(found, at_point(found.model.manifold, top[0]))[0]
        worst = max(worst, abs(raw / 3 - 1))
    # What the recovery is for: at the point itself 5.8 % are missing in one position.
    assert worst > 0.04


def whole_plate_with_a_hole(position: tuple[float, tuple[float, float]]) -> Equilibrium:
    """The whole of benchmark A5, held at two points, with the exact tractions all around."""
    from shapely import Polygon

    from nmm.verification.continuum import pin

    angle = np.linspace(0, 2 * np.pi, 768, endpoint=False)
    hole = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    square = [(-4, -4), (4, -4), (4, 4), (-4, 4)]
    region = Polygons.from_shapely([Polygon(square, [hole])])
    model = solid(region, cover(position), [LAW], "strain")
    rest = on_edges(model.manifold, np.ones(len(model.manifold.boundary), dtype=bool), 12)
    pins = [pin(model, [4, 0.1]), pin(model, [-4, 0.1], (False, True))]
    supports = Supports(pins, model.manifold.n_unknowns, initial_state(model.manifold))
    return equilibrium(model, [supports, traction(model, rest, pull)])


@pytest.mark.parametrize("position", POSITIONS[:2])
def test_stress_all_around_a_hole_in_a_whole_plate_is_as_good_as_stated(
    position: tuple[float, tuple[float, float]],
) -> None:
    found = whole_plate_with_a_hole(position)
    angle = np.arange(0, 768, 24) * 2 * np.pi / 768
    around = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    points = np.concatenate([around, 1.3 * around])
    stress = recovered_stress(found.model, found.state.deformation, points, 2 * SIZE, 2)
    # As the docstring has it, in parts of the threefold peak; a fit without weights misses by 13 %.
    assert stress[angle.argmin() + 8, 0] == pytest.approx(3.0, rel=0.01)
    miss = np.abs(stress - kirsch(points)) / 3
    assert miss[: len(around)].max() < 0.033
    assert miss[len(around) :].max() < 0.005


def test_stress_of_a_quadratic_displacement_comes_back_exactly() -> None:
    model = solid(SQUARE, cover(POSITIONS[0]), [LAW], "stress")
    place = on_edges(model.manifold, np.ones(len(model.manifold.boundary), dtype=bool), 8)

    # u = (x y, -(x^2 + nu y^2) / 2): pure bending, stress E y along x and none else.
    def bent(p: Floats) -> Floats:
        x, y = p.T
        return np.stack([x * y, -(x**2 + 0.3 * y**2) / 2], axis=1)

    found = equilibrium(model, [hold(model, place, Method("nitsche", SIZE, 1), bent)])
    points = np.array([[0.0, 0.0], [1.0, 1.0], [-0.3, 0.77], [0.9, -1.0]])
    stress = recovered_stress(model, found.state.deformation, points, 2 * SIZE, 2)
    expected = np.stack([1000 * points[:, 1], 0 * points[:, 0], 0 * points[:, 0]], axis=1)
    np.testing.assert_allclose(stress, expected, atol=1e-7)


def test_the_fit_does_not_look_across_a_crack() -> None:
    crack = [[-1.5, 0.03], [0.5, 0.03]]
    plain = cover(POSITIONS[0], 0).model_copy(update={"enrichment": EnrichmentTable(tips=False)})
    model: Model = solid(SQUARE, plain, [LAW], "stress", cracks=[crack])
    element, slot = np.nonzero(model.cut.covers >= 0)
    owner, height = model.cut.covers[element, slot], model.manifold.elements.centroids[element, 1]
    above = np.bincount(owner, height > 0.03) / np.bincount(owner) > 0.5
    node = model.manifold.cover_patch
    # Covers above the crack are stretched by 1 % along x, those below rest.
    x = _nodes(model)[node][:, 0]
    unknowns = np.zeros(model.manifold.n_unknowns)
    unknowns[::2] = np.where(above, 0.01 * x, 0.0)
    points = np.array([[-0.6, 0.04], [-0.6, 0.02]])
    stress = recovered_stress(model, unknowns, points, 2 * SIZE, 1)
    xx = 1000 / (1 - 0.3**2) * 0.01
    np.testing.assert_allclose(stress, [[xx, 0.3 * xx, 0.0], [0.0, 0.0, 0.0]], atol=1e-9)


def _nodes(model: Model) -> Floats:
    from covers.mathematical.triangles import Triangles

    angle, shift = POSITIONS[0]
    bounds = [[-1.0, -1.0], [1.0, 1.0]]
    return Triangles.regular(bounds, SIZE, angle=angle, shift=shift).patch_centre


def test_a_point_outside_is_named() -> None:
    model = solid(SQUARE, cover(POSITIONS[0]), [LAW], "stress")
    with pytest.raises(GeometryError, match=r"stress at \[3.0, 0.0\]: outside"):
        recovered_stress(model, np.zeros(model.manifold.n_unknowns), np.array([[3.0, 0.0]]), 0.5, 2)
