"""Nearly incompressible materials: pressures, displacements, supports and glue up to nu = 1/2."""

from dataclasses import replace

import numpy as np
import pytest

from integration.arrays import Floats
from integration.polygons import Polygons
from integration.rules import polygon_rule
from nmm.assembly.errors import field_errors
from nmm.assembly.places import on_edges
from nmm.assembly.state import initial_state
from nmm.constraints.imposition import Method
from nmm.constraints.supports import Supports
from nmm.formulation import CoverTable, Formulation, parse_formulation
from nmm.fracture.stress_intensity import stress_intensity
from nmm.materials.elastic import Elastic
from nmm.model.from_polygons import solid
from nmm.scene.read import parse_scene
from nmm.stepping.drive.linear_statics import body_force, equilibrium, hold, traction
from nmm.stepping.run import Run, run
from nmm.verification.continuum import pin

POISSONS = (0.4999, 0.4999999)


def formulation(
    kind: str, degree: int, volumetric: str, size: float, angle: float = 0.2, more: str = ""
) -> Formulation:
    return parse_formulation(
        f'[cover]\ntype = "{kind}"\nsize = {size}\nfunctions = "monomials"\ndegree = {degree}\n'
        f'angle = {angle}\nshift = [0.13, 0.41]\nvolumetric = "{volumetric}"\n{more}'
    )


def quarter_of_a_cylinder(nu: float, segments: int = 48) -> str:
    """Inner radius 1, outer 2, pressure 1 inside, E = 1, rollers on both axes."""
    angle = np.linspace(0, np.pi / 2, segments + 1)
    arc = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    arc[0], arc[-1] = [1.0, 0.0], [0.0, 1.0]
    ring = [*(2 * arc).tolist(), *arc[::-1].tolist()]
    loads = ""
    for n, (a, b) in enumerate(zip(arc[:-1].tolist(), arc[1:].tolist(), strict=True)):
        across = np.array([b[1] - a[1], a[0] - b[0]])
        push = (across / np.hypot(*across)).tolist()
        loads += f'[[loads]]\nname = "p{n}"\nkind = "edge"\nsegment = {[a, b]}\n'
        loads += f"traction = {push}\n"
    return (
        'plane = "strain"\n[materials.m]\nyoung_modulus = 1.0\n'
        f"poisson_ratio = {nu!r}\n[[blocks]]\nmaterial = 'm'\nvertices = {ring}\n"
        '[[supports]]\nname = "x"\nsegment = [[0, 1], [0, 2]]\nfix = ["x"]\n'
        '[[supports]]\nname = "y"\nsegment = [[1, 0], [2, 0]]\nfix = ["y"]\n'
        '[[monitors]]\nname = "m"\npoint = [1, 0]\n' + loads
    )


def lame(points: Floats) -> Floats:
    """Stresses of the cylinder, the same for every Poisson ratio."""
    r, t = np.hypot(*points.T), np.arctan2(points[:, 1], points[:, 0])
    radial, hoop, c, s = (1 - 4 / r**2) / 3, (1 + 4 / r**2) / 3, np.cos(t), np.sin(t)
    return np.stack(
        [
            radial * c**2 + hoop * s**2,
            radial * s**2 + hoop * c**2,
            (radial - hoop) * c * s,
        ],
        axis=1,
    )


def pressure_error(found: Run) -> float:
    """Relative error, in the root mean square over the area, of the mean stress in the plane."""
    elements = found.manifold.elements
    rule = polygon_rule(elements, 6)
    exact = np.bincount(rule.owner, rule.weights * lame(rule.points)[:, :2].mean(axis=1))
    miss = found.stress[:, :2].mean(axis=1) - exact / elements.areas
    return float(np.sqrt(elements.areas @ miss**2 / (exact**2 / elements.areas).sum()))


@pytest.mark.parametrize("nu", POISSONS)
@pytest.mark.parametrize(
    ("kind", "degree"),
    [("triangles", 1), ("triangles", 2), ("quads", 1), ("quads", 2), ("bspline", 1), ("mls", 1)],
)
def test_projected_pressures_of_a_thick_cylinder_are_lames_to_five_percent(
    kind: str, degree: int, nu: float
) -> None:
    size = 0.25 if kind != "mls" else 0.4
    found = run(
        parse_scene(quarter_of_a_cylinder(nu)), formulation(kind, degree, "projected", size)
    )
    # Cells of a quarter of the wall: 1 to 3 % with degree 1, without volumes projected 60 % and
    # more at 0.4999. The chords of the inner face take away 0.05 % of the widening.
    assert pressure_error(found) < 0.05
    widening = 4 / 3 * (1 + nu) * ((1 - 2 * nu) / 4 + 1)
    assert found.history["monitor:m:ux"][-1] == pytest.approx(widening, rel=1e-2)
    assert not found.summary.warnings


def test_errors_of_projected_pressures_do_not_grow_towards_one_half() -> None:
    errors = [
        pressure_error(
            run(parse_scene(quarter_of_a_cylinder(nu)), formulation("triangles", 2, kind, 0.25))
        )
        for nu, kind in ((0.3, "full"), (0.4999, "projected"), (0.4999999, "projected"))
    ]
    # 0.06, 0.08 and 0.08 % of the pressure.
    assert max(errors[1:]) < 2 * errors[0]


CAVITY = """
plane = "strain"
[materials.m]
young_modulus = 1.0
poisson_ratio = {nu!r}
{blocks}
[[supports]]
name = "left"
segment = [[0, 0], [0, 1]]
fix = ["x", "y"]
[[supports]]
name = "floor"
segment = [[0, 0], [1, 0]]
fix = ["x", "y"]
[[supports]]
name = "right"
segment = [[1, 0], [1, 1]]
fix = ["x", "y"]
[[loads]]
name = "lid"
kind = "edge"
segment = [[0, 1], [1, 1]]
traction = [1, 0]
"""
ONE = '[[blocks]]\nmaterial = "m"\nvertices = [[0, 0], [1, 0], [1, 1], [0, 1]]\n'
TWO = (
    "[interfaces.glue]\nbetween = 'any'\nfriction_angle = 0\nbonded = true\n"
    '[[blocks]]\nmaterial = "m"\nvertices = [[0, 0], [1, 0], [1, 0.45], [0, 0.6]]\n'
    '[[blocks]]\nmaterial = "m"\nvertices = [[0, 0.6], [1, 0.45], [1, 1], [0, 1]]\n'
)
# Work of the lid, twice the energy: pairs P3-P2 of Taylor and Hood on 40 x 40 x 2 graded triangles
# by scikit-fem, the last digit but one settled against 24 x 24.
LID = {0.3: 0.410736, 0.49: 0.350968, 0.4999: 0.345586, 0.4999999: 0.345530}


def lid(nu: float, blocks: str, how: Formulation) -> float:
    """Work of the lid over that of the reference, less 1."""
    found = run(parse_scene(CAVITY.format(nu=nu, blocks=blocks)), how)
    assert abs(found.history["support_energy"][-1]) < 0.05 * found.history["strain_energy"][-1]
    return float(2 * found.history["external_work"][-1] / LID[nu] - 1)


@pytest.mark.parametrize("nu", POISSONS)
@pytest.mark.parametrize(
    ("kind", "degree", "short"),
    # The corners where the lid meets the walls are singular: P2-P1 of Taylor and Hood on fitted
    # cells of the same size gives 3.9 % too little, on half the size 1.7 %. A quarter more is
    # allowed for nets that do not fit.
    [("triangles", 1, 0.049), ("triangles", 2, 0.03), ("quads", 1, 0.049), ("quads", 2, 0.03)],
)
def test_a_clamped_cavity_of_projected_volumes_gives_what_taylor_and_hood_give(
    kind: str, degree: int, short: float, nu: float
) -> None:
    found = lid(nu, ONE, formulation(kind, degree, "projected", 0.1))
    assert -short < found < 0


@pytest.mark.parametrize(("kind", "degree"), [("triangles", 1), ("quads", 2)])
def test_supports_by_nitsche_do_not_lock_what_the_volumes_leave_free(
    kind: str, degree: int
) -> None:
    how = formulation(kind, degree, "projected", 0.1)
    first, last = (lid(nu, ONE, how) for nu in POISSONS)
    # A penalty of the size of lambda at every point would part the two by tens of percent; what
    # supports share at corners parts them by 0.15 %.
    assert first == pytest.approx(last, abs=2e-3)


def test_glue_between_nearly_incompressible_blocks_locks_nothing() -> None:
    how = formulation("triangles", 1, "projected", 0.1)
    whole, glued = lid(0.4999999, ONE, how), lid(0.4999999, TWO, how)
    # Errors of 2.5 and 4.3 %, at nu = 0.3 0.43 and 0.78 %: Nitsche's terms cost cells beside them.
    assert glued > 2 * whole
    assert lid(0.4999, TWO, how) == pytest.approx(glued, abs=1e-3)


LAYERS = """
[materials.low]
young_modulus = {low[0]!r}
poisson_ratio = {low[1]!r}
[materials.top]
young_modulus = {top[0]!r}
poisson_ratio = {top[1]!r}
[interfaces.glue]
between = "any"
friction_angle = 0
bonded = true
[[blocks]]
material = "low"
vertices = [[0, 0], [1, 0], [1, 0.6], [0, 0.6]]
[[blocks]]
material = "top"
vertices = [[0, 0.6], [1, 0.6], [1, 1], [0, 1]]
"""


@pytest.mark.parametrize(
    ("low", "top", "work", "short"),
    # Twice the energy under the lid by P4 of scikit-fem on 25 x 25 x 2 graded triangles, settled to
    # 0.1 % against 15 x 15. Errors of two layers with nu = 0.3 are 0.6 % on these cells; where the
    # softer layer meets lid and walls they are those of the cavity above.
    [
        ((1.0, 0.4999), (2.0, 0.3), 0.205548, 0.01),
        ((1.0, 0.4999), (1000.0, 0.3), 0.000428329, 0.01),
        ((2.0, 0.3), (1.0, 0.4999), 0.34112, 0.06),
    ],
)
def test_layers_of_which_one_hardly_changes_its_volume_are_glued_as_any_others(
    low: tuple[float, float], top: tuple[float, float], work: float, short: float
) -> None:
    text = CAVITY.format(nu=0.3, blocks=LAYERS.format(low=low, top=top))
    found = [
        2 * run(parse_scene(text), how).history["external_work"][-1]
        for how in (
            formulation("triangles", 1, "projected", 0.1, more=f'[glue]\nmethod = "{method}"\n')
            for method in ("nitsche", "lagrange")
        )
    ]
    assert -short < found[0] / work - 1 < 0
    # Multipliers know nothing of penalties: they differ by 1e-4.
    assert found[0] == pytest.approx(found[1], rel=1e-3)


def test_slivers_have_the_pressure_of_what_lies_about_them() -> None:
    # A position of the net that leaves slivers: alone they were off by three times the pressure.
    how = formulation("triangles", 1, "projected", 0.25)
    cover = how.cover.model_copy(update={"shift": (0.3, 0.1)})
    scene = parse_scene(quarter_of_a_cylinder(0.4999999, 128))
    found = run(scene, how.model_copy(update={"cover": cover}))
    elements = found.manifold.elements
    assert elements.areas.min() < 1e-2 * elements.areas.max()
    rule = polygon_rule(elements, 6)
    exact = np.bincount(rule.owner, rule.weights * lame(rule.points)[:, :2].mean(axis=1))
    miss = found.stress[:, :2].mean(axis=1) - exact / elements.areas
    # With nu = 0.3 the worst element is off by 0.2 of the pressure, a third, as well.
    assert np.abs(miss).max() < 0.3 / 3


def test_sub_blocks_of_degree_two_gain_by_projected_volumes() -> None:
    text = '[cover]\ntype = "sub_blocks"\nsize = 0.1\nfunctions = "monomials"\ndegree = 2\n'
    full, projected = (
        lid(0.4999, ONE, parse_formulation(text + f'volumetric = "{kind}"\n'))
        for kind in ("full", "projected")
    )
    # -5.9 and -1.5 %; springs between blocks give a little.
    assert abs(projected) < 0.02 < abs(full)


@pytest.mark.parametrize("kind", ["full", "projected"])
def test_reactions_and_energies_balance_the_load(kind: str) -> None:
    text = CAVITY.format(nu=0.4999, blocks=ONE)
    found = run(parse_scene(text), formulation("triangles", 1, kind, 0.1))
    history = found.history
    force = [
        sum(values[-1] for name, values in history.items() if name.endswith(f":{axis}"))
        for axis in "xy"
    ]
    np.testing.assert_allclose(force, [-1.0, 0.0], atol=1e-8)
    stored = history["strain_energy"][-1] + history["support_energy"][-1]
    assert stored == pytest.approx(history["external_work"][-1], rel=1e-9)


def test_edges_held_on_both_axes_do_not_know_how_far_a_body_has_turned() -> None:
    cover = CoverTable.model_validate({"type": "triangles", "size": 0.3, "volumetric": "projected"})
    model = solid(SQUARE, cover, [Elastic(1.0, 0.4999)], "strain")
    place = on_edges(model.manifold, np.ones(len(model.manifold.boundary), dtype=bool), 6)
    held = hold(model, place, Method("nitsche", 0.3, 1))
    start = initial_state(model.manifold)
    turned = replace(start, frames=replace(start.frames, angle=np.array([0.7])))
    first, second = held.matrix(start), held.matrix(turned)
    assert abs(first - second).max() < 1e-12 * abs(first).max()


SQUARE = Polygons.from_vertices([np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])])


def without_divergence(nu: float, degree: int, size: float, volumetric: str) -> tuple[float, float]:
    """Errors in energy and displacement of a field that keeps the volume, under Nitsche."""
    cover = CoverTable.model_validate(
        {
            "type": "triangles",
            "size": size,
            "degree": degree,
            "angle": 0.3,
            "shift": (0.13, 0.41),
            "volumetric": volumetric,
        }
    )
    law = Elastic(1.0, nu)
    model = solid(SQUARE, cover, [law], "strain")
    shear, pi = law.stiffness("strain")[2, 2], np.pi

    def u(p: Floats) -> Floats:
        x, y = pi * p.T
        return np.stack([np.sin(x) * np.cos(y), -np.cos(x) * np.sin(y)], axis=1)

    def strain(p: Floats) -> Floats:
        x, y = pi * p.T
        along = pi * np.cos(x) * np.cos(y)
        return np.stack([along, -along, 0 * x], axis=1)

    place = on_edges(model.manifold, np.ones(len(model.manifold.boundary), dtype=bool), 12)
    force = body_force(model, lambda p: 2 * pi**2 * shear * u(p), 2 * degree + 6)
    found = equilibrium(model, [hold(model, place, Method("nitsche", size, degree), u), force])
    # The energy of shear: that of volume would be that of the pressure, multiplied by lambda.
    soft = solid(SQUARE, cover, [Elastic(1.0, 0.0)], "strain")
    errors = field_errors(soft, found.state.deformation, u, strain, 2 * degree + 6)
    return errors.energy, errors.displacement


@pytest.mark.parametrize("degree", [1, 2])
def test_a_field_without_divergence_is_as_good_at_one_half_as_at_a_third(degree: int) -> None:
    far = without_divergence(0.3, degree, 1 / 8, "full")
    near = without_divergence(0.4999999, degree, 1 / 8, "projected")
    # Without projection, and with penalties of lambda, by 168 times and more.
    assert near[0] < 3 * far[0]
    assert near[1] < 4 * far[1]


def test_errors_of_projected_volumes_fall_with_the_order_of_the_cover() -> None:
    sizes = np.array([1 / 6, 1 / 12])
    for degree in (1, 2):
        errors = [without_divergence(0.4999999, degree, size, "projected") for size in sizes]
        orders = np.log(np.array(errors[0]) / errors[1]) / np.log(2)
        # p + 1 in energy and p + 2 in displacement, scatter of two positions of the net aside.
        assert orders[0] > degree + 0.7
        assert orders[1] > degree + 1.5


def linear(p: Floats) -> Floats:
    return p @ np.array([[2.0, -1.0], [0.5, 3.0]])


@pytest.mark.parametrize("volumetric", ["full", "projected"])
@pytest.mark.parametrize(("degree", "nu"), [(0, 0.4999), (1, 0.45), (1, 0.4999), (2, 0.49)])
def test_linear_fields_are_exact_on_any_cut(degree: int, nu: float, volumetric: str) -> None:
    cover = CoverTable.model_validate(
        {
            "type": "triangles",
            "size": 0.15,
            "degree": degree,
            "angle": 0.3,
            "volumetric": volumetric,
        }
    )
    model = solid(SQUARE, cover, [Elastic(1.0, nu)], "strain")
    place = on_edges(model.manifold, np.ones(len(model.manifold.boundary), dtype=bool), 8)
    found = equilibrium(model, [hold(model, place, Method("nitsche", 0.15, degree), linear)])
    strain = np.array([2.0, 3.0, -0.5])
    expected = Elastic(1.0, nu).stiffness("strain") @ strain
    stress = model.mean_stress(found.state.deformation, found.pressure)
    # Rounding grows with the stiffness against volume, and on slivers.
    scale = np.abs(expected).max()
    assert np.abs(stress - expected).max() < 1e-7 * scale


def test_regions_of_other_degrees_share_pressures_and_hold_linear_fields() -> None:
    cover = CoverTable.model_validate(
        {
            "type": "triangles",
            "size": 0.15,
            "angle": 0.3,
            "volumetric": "projected",
            "regions": [{"point": [0.5, 0.5], "radius": 0.3, "degree": 2}],
        }
    )
    law = Elastic(1.0, 0.4999)
    model = solid(SQUARE, cover, [law], "strain")
    place = on_edges(model.manifold, np.ones(len(model.manifold.boundary), dtype=bool), 8)
    found = equilibrium(model, [hold(model, place, Method("nitsche", 0.15, 2), linear)])
    expected = law.stiffness("strain") @ np.array([2.0, 3.0, -0.5])
    stress = model.mean_stress(found.state.deformation, found.pressure)
    assert np.abs(stress - expected).max() < 1e-7 * np.abs(expected).max()


@pytest.mark.parametrize("nu", POISSONS)
def test_intensity_of_an_edge_crack_does_not_know_the_poisson_ratio(nu: float) -> None:
    ring = np.array([[0.0, -1.0], [1.0, -1.0], [1.0, 1.0], [0.0, 1.0]])
    cover = CoverTable.model_validate(
        {"type": "triangles", "size": 0.1, "angle": 0.4, "volumetric": "projected"}
    )
    crack = [[-0.1, 0.0], [0.5, 0.0]]
    law = Elastic(1.0, nu)
    model = solid(Polygons.from_vertices([ring]), cover, [law], "strain", cracks=[crack])
    edges = model.manifold.boundary
    ends = np.abs((edges.start + edges.end)[:, 1]) > 2 - 1e-9
    load = traction(model, on_edges(model.manifold, ends, 8), lambda p, n: n)
    pins = Supports(
        [pin(model, [1, 1]), pin(model, [1, -1], (True, False))],
        model.manifold.n_unknowns,
        initial_state(model.manifold),
    )
    found = equilibrium(model, [load, pins])
    k = stress_intensity(
        model,
        found.state.deformation,
        0,
        0.25,
        kappa=law.kolosov("strain"),
        pressure=found.pressure,
    )
    # Tractions alone: plane elasticity has the same stresses for every ratio, and the same K_I,
    # 2.82546 sqrt(pi a). Measured 1.0 %, and -0.2 % in another position of the net, where full
    # volumes give -20 and -33 %; at nu = 0.3 this net gives -0.4 %.
    assert k.opening == pytest.approx(2.82546 * np.sqrt(np.pi / 2), rel=2e-2)


def test_below_a_third_and_in_plane_stress_projection_changes_nothing() -> None:
    for nu, plane in ((0.33, "strain"), (0.4999, "stress")):
        full, projected = (
            solid(
                SQUARE,
                CoverTable.model_validate({"type": "triangles", "size": 0.3, "volumetric": kind}),
                [Elastic(1.0, nu)],
                plane,
            ).stiffness
            for kind in ("full", "projected")
        )
        assert (full != projected).nnz == 0


@pytest.mark.parametrize(
    ("kind", "degree", "nu", "told"),
    [
        ("triangles", 0, 0.46, "covers of degree 0 lock"),
        ("triangles", 1, 0.49, None),
        ("triangles", 1, 0.499, "covers that hold quadratic fields lock"),
        ("quads", 2, 0.499, None),
        ("quads", 2, 0.4999, "covers lock"),
    ],
)
def test_a_warning_says_how_much_locks_and_names_the_option(
    kind: str, degree: int, nu: float, told: str | None
) -> None:
    text = CAVITY.format(nu=nu, blocks=ONE)
    warnings = run(parse_scene(text), formulation(kind, degree, "full", 0.3)).summary.warnings
    if told is None:
        assert not warnings
        return
    (warning,) = warnings
    assert told in warning
    assert "% off" in warning
    assert 'volumetric = "projected"' in warning


@pytest.mark.parametrize(
    ("degree", "volumetric", "told"),
    [(1, "full", "45 to 75 %"), (1, "projected", "45 to 75 %"), (2, "full", "5 %")],
)
def test_sub_blocks_that_lock_are_told(degree: int, volumetric: str, told: str) -> None:
    how = parse_formulation(
        '[cover]\ntype = "sub_blocks"\nsize = 0.3\nfunctions = "monomials"\n'
        f'degree = {degree}\nvolumetric = "{volumetric}"\n'
    )
    for nu, count in ((0.49, 1), (0.3, 0)):
        warnings = run(parse_scene(CAVITY.format(nu=nu, blocks=ONE)), how).summary.warnings
        assert len(warnings) == count
        assert all(told in warning for warning in warnings)


def test_projected_pressures_on_covers_of_degree_zero_warn_that_they_oscillate() -> None:
    text = CAVITY.format(nu=0.4999, blocks=ONE)
    found = run(parse_scene(text), formulation("triangles", 0, "projected", 0.3))
    (warning,) = found.summary.warnings
    assert "degree 0 oscillate" in warning
