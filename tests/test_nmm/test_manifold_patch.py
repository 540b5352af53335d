"""Patch tests, rates and supports on cut meshes turned and shifted against the geometry."""

import numpy as np
import pytest

from integration.arrays import Floats
from integration.polygons import Polygons
from integration.rules import polygon_rule
from nmm.assembly.errors import field_errors, stresses
from nmm.assembly.model import Model
from nmm.assembly.motion import initial_state, move
from nmm.assembly.places import on_edges
from nmm.effects.supports import Method
from nmm.formulation import Cover
from nmm.materials.elastic import Elastic
from nmm.stepping.equilibrium import Equilibrium, body_force, equilibrium, hold, traction
from nmm.stepping.solid import solid

HOLED = Polygons.from_rings(
    [
        [
            [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 0.6], [0.0, 1.0]],
            [[0.9, 0.2], [1.2, 0.2], [1.2, 0.4], [0.9, 0.4]],
        ]
    ]
)
SQUARE = Polygons.from_vertices([np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])])
LAW = Elastic(1000.0, 0.3)
STRAIN = np.array([1e-3, -2e-4, 5e-4])
STRESS = np.array([1.032967033, 0.1098901099, 0.1923076923])


def linear(x: Floats) -> Floats:
    half = STRAIN[2] / 2
    return np.asarray(x @ np.array([[STRAIN[0], half], [half, STRAIN[1]]]))


def everywhere(model: Model, order: int = 10):  # type: ignore[no-untyped-def]
    return on_edges(model.manifold, np.ones(len(model.manifold.boundary), dtype=bool), order)


COVERS = [
    Cover(type="triangles", size=0.31, degree=0, angle=0.4, shift=(0.2, 0.3)),
    Cover(type="triangles", size=0.31, degree=1, angle=0.4, shift=(0.2, 0.3)),
    Cover(type="triangles", size=0.4, degree=2, angle=1.1, shift=(0.7, 0.1)),
    Cover(type="quads", size=0.31, degree=1, angle=0.4, shift=(0.2, 0.3)),
    Cover(type="bspline", size=0.31, functions="monomials", degree=0, angle=0.4),
]
MESHLESS = Cover(type="mls", size=0.2, degree=0, angle=0.4)


@pytest.mark.parametrize("cover", COVERS, ids=lambda c: f"{c.type}{c.degree}")
@pytest.mark.parametrize("method", ["nitsche", "lagrange"])
def test_exact_displacements_of_a_linear_field_give_its_stress_in_every_element(
    cover: Cover, method: str
) -> None:
    model = solid(HOLED, cover, [LAW], "stress")
    assert cover.size is not None
    held = hold(model, everywhere(model), Method(method, cover.size, cover.degree or 0), linear)
    found = equilibrium(model, [held])
    rule = polygon_rule(model.manifold.elements, 2)
    stress = stresses(model, found.state.deformation, rule)
    np.testing.assert_allclose(stress, np.tile(STRESS, (len(stress), 1)), atol=1e-9)
    area = model.element_area.sum()
    assert found.energy == pytest.approx(5.535714286e-4 * area, rel=1e-9)
    assert found.residual < 1e-10


def test_meshless_covers_pass_the_patch_test_up_to_their_quadrature() -> None:
    model = solid(HOLED, MESHLESS, [LAW], "stress")
    found = equilibrium(model, [hold(model, everywhere(model), Method("penalty", 0.2, 0), linear)])
    rule = polygon_rule(model.manifold.elements, 2)
    miss = stresses(model, found.state.deformation, rule) - STRESS
    # Weights of discs are rational and jump in their third derivatives within cells:
    # measured 1.8e-3 of a stress of about 1.
    assert np.sqrt(rule.weights @ (miss**2).sum(axis=1)) < 5e-3


@pytest.mark.parametrize("cover", COVERS[:4], ids=lambda c: f"{c.type}{c.degree}")
def test_exact_tractions_and_three_pins_give_the_stress_too(cover: Cover) -> None:
    from nmm.assembly.places import at_point
    from nmm.effects.support_methods import Springs
    from nmm.effects.supports import Supports

    model = solid(HOLED, cover, [LAW], "stress")

    def pull(points: Floats, n: Floats) -> Floats:
        x, y = n.T
        s = STRESS
        return np.stack([s[0] * x + s[2] * y, s[2] * x + s[1] * y], axis=1)

    def pin(point: list[float], held: list[bool]) -> Springs:
        place = at_point(model.manifold, np.array(point))
        return Springs("pin", place, np.array(held), lambda end: np.zeros(2), np.array([1e3]))

    pins = [pin([0.0, 0.0], [True, True]), pin([2.0, 0.0], [False, True])]
    state = initial_state(model.manifold)
    supports = Supports(pins, model.manifold.n_unknowns, state)
    found = equilibrium(model, [supports, traction(model, everywhere(model), pull)])
    rule = polygon_rule(model.manifold.elements, 2)
    stress = stresses(model, found.state.deformation, rule)
    # The printed stress has ten figures.
    np.testing.assert_allclose(stress, np.tile(STRESS, (len(stress), 1)), atol=2e-9)


@pytest.mark.parametrize("method", ["nitsche", "lagrange"])
@pytest.mark.parametrize("cover", [COVERS[1], COVERS[2], COVERS[3]], ids=lambda c: f"{c.type}")
def test_linear_covers_pass_the_quadratic_patch_test(cover: Cover, method: str) -> None:
    model = solid(HOLED, cover, [LAW], "stress")
    d = LAW.stiffness("stress")

    def u(p: Floats) -> Floats:
        x, y = p.T
        return np.stack([x**2 + 2 * x * y - y**2, -(x**2) + x * y + 3 * y**2], axis=1)

    def strain(p: Floats) -> Floats:
        x, y = p.T
        return np.stack([2 * x + 2 * y, x + 6 * y, 2 * x - 2 * y - 2 * x + y], axis=1)

    # - div sigma with strains (2x + 2y, x + 6y, -y): sxx_x + sxy_y, sxy_x + syy_y.
    divergence = [d[0, 0] * 2 + d[0, 1] - d[2, 2], d[1, 0] * 2 + d[1, 1] * 6]
    force = body_force(model, lambda p: -np.tile(divergence, (len(p), 1)), 6)
    assert cover.size is not None
    place = everywhere(model)
    found = equilibrium(
        model, [hold(model, place, Method(method, cover.size, cover.degree or 0), u), force]
    )
    errors = field_errors(model, found.state.deformation, u, strain, 6)
    assert errors.energy < 1e-8
    assert errors.displacement < 1e-8


@pytest.mark.parametrize("cover", [*COVERS, MESHLESS], ids=lambda c: f"{c.type}{c.degree}")
def test_a_finite_turn_strains_nothing_and_keeps_areas(cover: Cover) -> None:
    from nmm.stepping.step import vertex_points

    model = solid(HOLED, cover, [LAW], "stress")
    start = initial_state(model.manifold)
    turn = np.zeros(3 * model.manifold.n_bodies)
    turn[2] = np.pi / 6
    state = move(model, start, model.manifold.rigid_modes @ turn)
    assert state.frames.angle[0] == pytest.approx(np.pi / 6, rel=1e-12)
    assert np.abs(model.mean_strain(state.deformation)).max() < 1e-12
    placed = vertex_points(model.manifold).place(state.frames, state.deformation)
    moved = model.manifold.elements.with_points(placed)
    np.testing.assert_allclose(moved.areas, model.element_area, rtol=1e-9)


def manufactured(cover: Cover, turn: float = 0.0, method: str = "nitsche") -> tuple[float, float]:
    """Benchmark A8: relative errors in energy and displacement."""
    law = Elastic(1.0, 0.3)
    c, s = np.cos(turn), np.sin(turn)
    region = SQUARE.with_points(SQUARE.points @ np.array([[c, s], [-s, c]]))
    model = solid(region, cover, [law], "strain")
    d = law.stiffness("strain")
    pi = np.pi

    def u(p: Floats) -> Floats:
        x, y = pi * p.T
        return np.stack([np.sin(x) * np.cos(y), np.cos(x) * np.sin(y)], axis=1)

    def strain(p: Floats) -> Floats:
        x, y = pi * p.T
        normal = pi * np.cos(x) * np.cos(y)
        return np.stack([normal, normal, -2 * pi * np.sin(x) * np.sin(y)], axis=1)

    factor = (d[0, 1] + 2 * d[2, 2]) * 2 * pi**2
    degree, size = cover.degree or 0, cover.size or 0.0
    order = 2 * degree + 6
    place = everywhere(model, order)
    effects = [
        hold(model, place, Method(method, size, degree), u),
        body_force(model, lambda p: factor * u(p), order),
    ]
    found = equilibrium(model, effects)
    assert found.residual < 1e-10
    errors = field_errors(model, found.state.deformation, u, strain, order)
    return errors.energy, errors.displacement


def rates(degree: int, sizes: tuple[float, ...], **options: object) -> tuple[float, float]:
    """Median over positions of the mesh of the rate of the last two sizes."""
    shifts = [(0.17, 0.29), (0.61, 0.83), (0.42, 0.05)]
    kind = str(options.get("kind", "triangles"))
    found = []
    for number, shift in enumerate(shifts):
        errors = [
            manufactured(
                Cover(type=kind, size=h, degree=degree, angle=0.2 + 0.3 * number, shift=shift),
                turn=0.35 * number,
                method=str(options.get("method", "nitsche")),
            )
            for h in sizes
        ]
        first, last = np.array(errors[-2]), np.array(errors[-1])
        found.append(np.log(first / last) / np.log(sizes[-2] / sizes[-1]))
    energy, displacement = np.median(found, axis=0)
    return float(energy), float(displacement)


@pytest.mark.parametrize(("degree", "sizes"), [(0, (1 / 16, 1 / 32)), (1, (1 / 10, 1 / 20))])
def test_errors_fall_by_the_degree_plus_one_in_energy(
    degree: int, sizes: tuple[float, ...]
) -> None:
    energy, displacement = rates(degree, sizes)
    assert energy == pytest.approx(degree + 1, abs=0.15)
    assert displacement == pytest.approx(degree + 2, abs=0.3)


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["triangles", "quads"])
@pytest.mark.parametrize(
    ("degree", "sizes"), [(0, (1 / 32, 1 / 64)), (1, (1 / 24, 1 / 48)), (2, (1 / 16, 1 / 32))]
)
def test_rates_of_the_manufactured_solution(
    kind: str, degree: int, sizes: tuple[float, ...]
) -> None:
    energy, displacement = rates(degree, sizes, kind=kind)
    assert energy == pytest.approx(degree + 1, abs=0.15)
    assert displacement == pytest.approx(degree + 2, abs=0.15)


@pytest.mark.parametrize("method", ["penalty", "nitsche", "lagrange"])
def test_every_method_of_support_keeps_the_order(method: str) -> None:
    coarse, fine = (
        manufactured(
            Cover(type="triangles", size=h, degree=1, angle=0.3, shift=(0.2, 0.3)), 0, method
        )
        for h in (1 / 8, 1 / 16)
    )
    # At least the rate 2 of the approximation, less 0.2.
    assert fine[0] < coarse[0] / 2**1.8


def cantilever(cover: Cover, method: str = "nitsche") -> tuple[Equilibrium, float]:
    """Benchmark A2: the solution and its relative error in energy."""
    e, nu, length, depth, load = 3e7, 0.3, 48.0, 12.0, 1000.0
    inertia = 144.0
    region = Polygons.from_vertices(
        [np.array([[0.0, -6.0], [48.0, -6.0], [48.0, 6.0], [0.0, 6.0]])]
    )
    model = solid(region, cover, [Elastic(e, nu)], "stress")

    def u(p: Floats) -> Floats:
        x, y = p.T
        a = (6 * length - 3 * x) * x + (2 + nu) * (y**2 - depth**2 / 4)
        b = 3 * nu * y**2 * (length - x) + (4 + 5 * nu) * depth**2 * x / 4 + (3 * length - x) * x**2
        return np.asarray(load / (6 * e * inertia) * np.stack([-y * a, b], axis=1))

    def stress(p: Floats) -> Floats:
        x, y = p.T
        shear = load / (2 * inertia) * (depth**2 / 4 - y**2)
        return np.stack([-load * (length - x) * y / inertia, 0 * x, shear], axis=1)

    compliance = np.linalg.inv(Elastic(e, nu).stiffness("stress"))
    edges = model.manifold.boundary
    middle = (edges.start + edges.end)[:, 0] / 2
    order = 2 * (cover.degree or 0) + 6
    left = on_edges(model.manifold, middle < 1e-9, order)
    right = on_edges(model.manifold, middle > 48 - 1e-9, order)
    held = hold(model, left, Method(method, cover.size, cover.degree or 0), u)
    found = equilibrium(model, [held, traction(model, right, lambda p, n: stress(p)[:, [0, 2]])])
    errors = field_errors(
        model, found.state.deformation, u, lambda p: stress(p) @ compliance, order
    )
    return found, errors.energy


def test_cantilever_is_exact_with_quadratic_covers_on_any_mesh() -> None:
    for kind, method in (("triangles", "nitsche"), ("triangles", "lagrange"), ("quads", "nitsche")):
        cover = Cover(type=kind, size=4.0, degree=2, angle=0.2, shift=(0.3, 0.1))
        found, error = cantilever(cover, method)
        assert error < 1e-8
        assert found.energy == pytest.approx(4.474666667, rel=1e-8)
        assert found.residual < 1e-10


def test_cantilever_errors_of_fitted_meshes_are_those_of_finite_elements() -> None:
    # Bilinear quads 8 x 2 and 16 x 4: 0.336 and 0.175 by finite elements (strong supports).
    for size, expected in ((6.0, 0.336), (3.0, 0.175)):
        _, error = cantilever(Cover(type="quads", size=size, degree=0))
        assert error == pytest.approx(expected, rel=0.01)


def test_cantilever_with_linear_covers_has_the_rate_two() -> None:
    errors = [
        cantilever(Cover(type="triangles", size=h, degree=1, angle=0.2, shift=(0.3, 0.1)))[1]
        for h in (3.0, 1.5)
    ]
    assert np.log2(errors[0] / errors[1]) == pytest.approx(2.0, abs=0.1)


@pytest.mark.parametrize("shift", [1e-14, 1e-12, 1e-10, 1e-8])
def test_the_field_does_not_depend_on_the_regularisation(shift: float) -> None:
    from nmm.formulation import Solver

    cover = Cover(type="triangles", size=0.4, degree=2, angle=0.4, shift=(0.2, 0.3))
    model = solid(HOLED, cover, [LAW], "stress")
    place = everywhere(model)
    held = hold(
        model, place, Method("nitsche", 0.4, 2), lambda p: np.stack([p[:, 1] ** 4, p[:, 0] ** 3], 1)
    )
    usual = equilibrium(model, [held])
    other = equilibrium(model, [held], Solver(options={"shift": shift, "refinements": 8}))
    points = model.manifold.vertex_rows
    one, two = points.apply(usual.state.deformation), points.apply(other.state.deformation)
    assert usual.residual < 1e-10
    assert other.residual < 1e-10
    assert np.abs(one - two).max() < 1e-8 * np.abs(one).max()


def test_compliance_never_exceeds_that_of_quadratic_finite_elements_on_the_same_mesh() -> None:
    import skfem
    from skfem.models.elasticity import linear_elasticity

    from covers.cutting import cut
    from covers.local_functions import Monomials
    from covers.mesh_manifold import mesh_manifold
    from covers.triangles import Triangles

    mesh = skfem.MeshTri.init_tensor(np.linspace(0, 1, 5), np.linspace(0, 1, 5))
    d = Elastic(1.0, 0.3).stiffness("stress")
    basis = skfem.Basis(mesh, skfem.ElementVector(skfem.ElementTriP2()), intorder=4)
    stiffness = skfem.asm(linear_elasticity(d[0, 1], d[2, 2]), basis)
    load = skfem.LinearForm(lambda v, w: v[1]).assemble(basis)
    fixed = basis.get_dofs(lambda x: x[0] < 1e-9)
    u = skfem.solve(*skfem.condense(stiffness, load, D=fixed))
    # The subspace with displacements zero on the held side: constraints at as many points of it as
    # a quadratic edge needs, by least squares on the null space.
    cover = Triangles.from_mesh(mesh)
    manifold = mesh_manifold(cover, cut(cover, SQUARE), Monomials(1))
    n = len(manifold.elements)
    model = Model(manifold, np.broadcast_to(d, (n, 3, 3)).copy(), np.zeros(n), np.ones(n), 1.0)
    edges = manifold.boundary
    place = on_edges(manifold, (edges.start + edges.end)[:, 0] < 1e-9, 4)
    rows = place.points.rows.matrix(manifold.n_unknowns).toarray()
    _, size, right = np.linalg.svd(rows)
    null = right[int((size > 1e-10 * size[0]).sum()) :].T
    force = null.T @ model.body_load(np.tile([0.0, 1.0], (n, 1)))
    reduced = null.T @ (model.stiffness @ null)
    d_free = np.linalg.lstsq(reduced, force, rcond=1e-12)[0]
    assert force @ d_free <= load @ u * (1 + 1e-10)
    assert force @ d_free > 0.9 * load @ u
