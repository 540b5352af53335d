"""Problems with independent answers on cut meshes: membrane, hole, cylinder, corner, modes."""

import numpy as np
import pytest

from covers.corner_functions import corner_functions
from integration.arrays import Bools, Floats
from integration.polygons import Polygons
from nmm.assembly.model import Model
from nmm.assembly.motion import initial_state
from nmm.assembly.places import Place, at_point, on_edges, on_segment
from nmm.effects.support_methods import Springs
from nmm.effects.supports import Method, Supports
from nmm.formulation import Cover
from nmm.materials.elastic import Elastic
from nmm.stepping.equilibrium import Equilibrium, equilibrium, hold, traction
from nmm.stepping.modes import lowest_modes
from nmm.stepping.solid import solid


def polygon(ring: object) -> Polygons:
    return Polygons.from_vertices([np.array(ring, dtype=float)]).oriented()


def middles(model: Model) -> Floats:
    edges = model.manifold.boundary
    return (edges.start + edges.end) / 2


def displacement_at(found: Equilibrium, point: list[float]) -> Floats:
    place = at_point(found.model.manifold, np.array(point))
    return np.asarray(place.points.rows.apply(found.state.deformation)[0])


def stress_at(found: Equilibrium, place: Place) -> Floats:
    index, rows = found.model.manifold.gradient_rows(place.elements, place.position)
    g = np.einsum("mcjl,ml->mcj", rows, found.state.deformation[index])
    strain = np.stack([g[:, 0, 0], g[:, 1, 1], g[:, 0, 1] + g[:, 1, 0]], axis=1)
    return np.einsum("mij,mj->mi", found.model.elasticity[place.elements], strain)


def pinned(model: Model, points: list[tuple[list[float], list[bool]]]) -> Supports:
    pins = [
        Springs(
            "pin",
            at_point(model.manifold, np.array(point)),
            np.array(held),
            lambda end: np.zeros(2),
            np.array([float(model.modulus.max())]),
        )
        for point, held in points
    ]
    return Supports(list(pins), model.manifold.n_unknowns, initial_state(model.manifold))


def rollers(
    model: Model, method: Method, chosen: list[tuple[Bools, tuple[bool, bool]]]
) -> Supports:
    held = [
        method.hold(
            model, on_edges(model.manifold, where, method.order), lambda e: np.zeros(2), axes
        )
        for where, axes in chosen
    ]
    return Supports(held, model.manifold.n_unknowns, initial_state(model.manifold))


@pytest.mark.parametrize("method", ["nitsche", "lagrange", "penalty"])
def test_membrane_of_cook_within_one_percent(method: str) -> None:
    cover = Cover(type="triangles", size=3.0, degree=1, angle=0.2, shift=(0.3, 0.1))
    region = polygon([[0, 0], [48, 44], [48, 60], [0, 44]])
    model = solid(region, cover, [Elastic(1.0, 1 / 3)], "stress")
    left = on_segment(model.manifold, np.array([[0.0, 0.0], [0.0, 44.0]]), order=8)
    right = on_segment(model.manifold, np.array([[48.0, 44.0], [48.0, 60.0]]), order=8)
    up = traction(model, right, lambda p, n: np.tile([0.0, 1 / 16], (len(p), 1)))
    found = equilibrium(model, [hold(model, left, Method(method, 3.0, 1)), up])
    # Measured -0.04 % (Nitsche), +0.12 % (multipliers), -0.09 % (springs).
    assert displacement_at(found, [48.0, 52.0])[1] == pytest.approx(23.9677, rel=2e-3)
    assert found.residual < 1e-10


def kirsch(plane: str, degree: int) -> Equilibrium:
    """Benchmark A5: a quarter of a plate with a hole, exact tractions."""
    nu, young = 0.3, 1000.0

    def stress(p: Floats) -> Floats:
        q, t = 1 / np.hypot(*p.T), np.arctan2(p[:, 1], p[:, 0])
        c2, c4, s2, s4 = np.cos(2 * t), np.cos(4 * t), np.sin(2 * t), np.sin(4 * t)
        xx = 1 - q**2 * (1.5 * c2 + c4) + 1.5 * q**4 * c4
        yy = -(q**2) * (0.5 * c2 - c4) - 1.5 * q**4 * c4
        return np.stack([xx, yy, -(q**2) * (0.5 * s2 + s4) + 1.5 * q**4 * s4], axis=1)

    def pull(p: Floats, n: Floats) -> Floats:
        s = stress(p)
        x = s[:, 0] * n[:, 0] + s[:, 2] * n[:, 1]
        return np.stack([x, s[:, 2] * n[:, 0] + s[:, 1] * n[:, 1]], axis=1)

    angle = np.linspace(np.pi / 2, 0, 257)
    arc = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    arc[0], arc[-1] = [0.0, 1.0], [1.0, 0.0]
    region = polygon([*arc, [4, 0], [4, 4], [0, 4]])
    cover = Cover(type="triangles", size=0.25, degree=degree, angle=0.2, shift=(0.3, 0.1))
    model = solid(region, cover, [Elastic(young, nu)], plane)
    x, y = middles(model).T
    sides = rollers(
        model,
        Method("nitsche", 0.25, degree),
        [(x < 1e-9, (True, False)), (y < 1e-9, (False, True))],
    )
    rest = on_edges(model.manifold, (x > 1e-9) & (y > 1e-9), 12)
    return equilibrium(model, [sides, traction(model, rest, pull)])


@pytest.mark.parametrize(
    ("plane", "energy", "ends"),
    [("strain", 7.693653726e-3, 2.73e-3), ("stress", 8.444912711e-3, 3.0e-3)],
)
def test_plate_with_a_hole(plane: str, energy: float, ends: float) -> None:
    found = kirsch(plane, 1)
    # Measured 6e-5 and 4e-5.
    assert found.energy == pytest.approx(energy, rel=5e-3)
    assert displacement_at(found, [1.0, 0.0])[0] == pytest.approx(ends, rel=5e-3)
    peak = stress_at(found, at_point(found.model.manifold, np.array([0.0, 1.0])))[0, 0]
    # At one point of an element of size 0.25: measured 2.91 and 2.93 of 3.
    assert peak == pytest.approx(3.0, rel=0.035)


def test_peak_stress_at_a_hole_with_quadratic_covers() -> None:
    found = kirsch("strain", 2)
    peak = stress_at(found, at_point(found.model.manifold, np.array([0.0, 1.0])))[0, 0]
    assert peak == pytest.approx(3.0, rel=0.02)


@pytest.mark.parametrize(
    ("nu", "degree", "inner", "tolerance"),
    [(0.3, 1, 1.9066666667, 5e-3), (0.49, 1, 1.9966, 5e-3), (0.4999, 2, 1.99996666, 4e-3)],
)
@pytest.mark.parametrize("position", [(0.2, (0.3, 0.1)), (0.45, (0.6, 0.4))])
def test_thick_cylinder(
    nu: float,
    degree: int,
    inner: float,
    tolerance: float,
    position: tuple[float, tuple[float, float]],
) -> None:
    t = np.linspace(0, np.pi / 2, 129)
    c = np.stack([np.cos(t), np.sin(t)], axis=1)
    c[0], c[-1] = [1.0, 0.0], [0.0, 1.0]
    region = polygon([*(2 * c), *c[::-1]])
    angle, shift = position
    # Degree 1 at 0.49: 0.25 to 0.62 % at a point of the wall with cells of 0.25, 0.14 to 0.24 %
    # with 0.2; the aim of 0.5 % needs five cells across the wall.
    size = 0.2 if degree == 1 else 0.25
    cover = Cover(type="triangles", size=size, degree=degree, angle=angle, shift=shift)
    model = solid(region, cover, [Elastic(1.0, nu)], "strain")
    x, y = middles(model).T
    sides = rollers(
        model,
        Method("nitsche", size, degree),
        [(x < 1e-9, (True, False)), (y < 1e-9, (False, True))],
    )
    arc = (np.hypot(x, y) < 1.01) & (x > 1e-9) & (y > 1e-9)
    inside = on_edges(model.manifold, arc, 8)
    found = equilibrium(model, [sides, traction(model, inside, lambda p, n: -n)])
    assert displacement_at(found, [1.0, 0.0])[0] == pytest.approx(inner, rel=tolerance)
    assert displacement_at(found, [0.0, 1.0])[1] == pytest.approx(inner, rel=tolerance)
    # Twice the energy is the work of the pressure on the whole wall.
    assert 2 * found.energy / (np.pi / 2) == pytest.approx(inner, rel=2e-3)


def test_corner_exponents_are_those_of_williams() -> None:
    functions = corner_functions(1.5 * np.pi, 1.8, 1.0)
    # Benchmark A13; the second mode from sin(3 pi l) = l sin(3 pi / 2) by hand-held bisection.
    assert functions.exponent == pytest.approx((0.5444837367824639, 0.908529189846), rel=1e-11)
    assert functions.ratio == pytest.approx((0.5430755788367366, -0.218923236249), rel=1e-10)
    crack = corner_functions(2 * np.pi, 1.8, 1.0)
    assert crack.exponent == pytest.approx((0.5, 0.5), rel=1e-9)
    assert crack.ratio == pytest.approx((1 / 3, -1.0), rel=1e-6)


def notch_energy(degree: int, size: float, radius: float | None) -> tuple[float, int]:
    """Benchmark A13: relative error of the energy, and the number of unknowns."""
    power, q, nu = 0.5444837367824639, 0.5430755788367366, 0.3
    kappa, shear = 3 - 4 * nu, 1 / 2.6
    functions = corner_functions(1.5 * np.pi, kappa, 1.0)
    assert functions.ratio[0] == pytest.approx(q, rel=1e-12)
    assert functions.exponent[0] == pytest.approx(power, rel=1e-12)
    law = Elastic(1.0, nu)
    d = law.stiffness("strain")

    def pull(p: Floats, n: Floats) -> Floats:
        gradient = functions.evaluate(np.hypot(*p.T), np.arctan2(p[:, 1], p[:, 0]))[1][:, 0]
        g = gradient / (2 * shear)
        s = np.stack([g[:, 0, 0], g[:, 1, 1], g[:, 0, 1] + g[:, 1, 0]], axis=1) @ d
        x = s[:, 0] * n[:, 0] + s[:, 2] * n[:, 1]
        return np.stack([x, s[:, 2] * n[:, 0] + s[:, 1] * n[:, 1]], axis=1)

    a, b = np.sqrt(0.5), np.sqrt(2.0)
    region = polygon([[0, 0], [-a, -a], [0, -b], [b, 0], [0, b], [-a, a]])
    extra = {} if radius is None else {"enrichment": {"radius": radius, "corners": [[0, 0]]}}
    cover = Cover(type="triangles", size=size, degree=degree, angle=0.3, shift=(0.2, 0.3), **extra)
    model = solid(region, cover, [law], "strain")
    x, y = middles(model).T
    loaded = on_edges(model.manifold, np.abs(x + np.abs(y)) > 1e-9, 16)
    pins = pinned(model, [([b, 0.0], [True, True]), ([0.0, b], [True, False])])
    found = equilibrium(model, [pins, traction(model, loaded, pull)])
    return found.energy / 4.1545442274 - 1, model.manifold.n_unknowns


def test_corner_functions_make_a_re_entrant_corner_regular() -> None:
    plain, _ = notch_energy(1, 0.2, None)
    enriched, unknowns = notch_energy(1, 0.2, 0.35)
    # Measured 3.6e-4 with 796 unknowns against 4e-2 without: energies of supported bodies under
    # given loads are bounds from below.
    assert -5e-4 < enriched < 0
    assert plain < 50 * enriched
    assert unknowns < 1000


def test_lame_mode_of_a_free_square_and_three_rigid_motions() -> None:
    square = polygon([[0, 0], [1, 0], [1, 1], [0, 1]])
    for degree, size in ((1, 0.2), (2, 0.3)):
        cover = Cover(type="triangles", size=size, degree=degree, angle=0.3, shift=(0.2, 0.3))
        model = solid(square, cover, [Elastic(1.0, 0.3)], "stress", density=[1.0])
        modes = lowest_modes(model, 9)
        assert (modes.frequency[:3] < 1e-3).all()
        assert (modes.frequency[3:] > 2.0).all()
        # Measured 2.5e-4 (p = 1) and 1.2e-5 (p = 2).
        assert np.abs(modes.frequency - 2.755359030).min() < 1e-3 * 2.755
        identity = modes.shape.T @ (model.mass @ modes.shape)
        np.testing.assert_allclose(identity, np.eye(9), atol=1e-9)
