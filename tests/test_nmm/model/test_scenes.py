"""One scene as DDA, finite elements, manifold, meshless method: the formulation alone changes."""

import numpy as np
import pytest
import skfem
from skfem.models.elasticity import linear_elasticity

from nmm.formulation import parse_formulation
from nmm.scene import parse_scene
from nmm.stepping.run import Run, run
from nmm.testing.scenes import roller_and_pin

MESHES = {
    "finite elements": '[cover]\ntype = "triangles"\nsize = 0.4\ndegree = 0\nangle = 0.3\n',
    "linear": '[cover]\ntype = "triangles"\nsize = 0.5\ndegree = 1\nangle = 0.3\n',
    "quadratic": '[cover]\ntype = "triangles"\nsize = 0.7\ndegree = 2\nangle = 0.3\n',
    "quads": '[cover]\ntype = "quads"\nsize = 0.5\ndegree = 1\nangle = 0.3\n',
    "graded": '[cover]\ntype = "graded"\nsize = 0.3\ndegree = 1\nangle = 0.3\n'
    "options = { focus = [[0, 0]] }\n",
    "splines": '[cover]\ntype = "bspline"\nsize = 0.4\ndegree = 0\nangle = 0.3\n',
    "meshless": '[cover]\ntype = "mls"\nsize = 0.4\ndegree = 0\nangle = 0.3\n',
}
DDA = '[cover]\ntype = "block"\n'

BAR = (
    """
plane = "stress"
duration = 20.0
[inertia]
[materials.m]
young_modulus = 1
poisson_ratio = 0.0
density = 1
[[blocks]]
name = "b"
material = "m"
vertices = [[0, 0], [10, 0], [10, 0.5], [0, 0.5]]
"""
    + roller_and_pin(0.5)
    + """[[loads]]
name = "pull"
kind = "edge"
segment = [[10, 0], [10, 0.5]]
traction = [1e-3, 0]
[[monitors]]
name = "end"
point = [10, 0.25]
[[monitors]]
name = "middle"
point = [5, 0.25]
"""
)

STACK = """
plane = "stress"
[gravity]
acceleration = [0, -10]
[materials.m]
young_modulus = 1e7
poisson_ratio = 0.0
density = 1000
[interfaces.dry]
friction_angle = "30 deg"
[contact]
[[blocks]]
name = "base"
material = "m"
vertices = [[-0.2, -0.5], [1.2, -0.5], [1.2, 0], [-0.2, 0]]
[[blocks]]
name = "low"
material = "m"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[blocks]]
name = "top"
material = "m"
vertices = [[0, 1], [1, 1], [1, 2], [0, 2]]
[[supports]]
name = "ground"
segment = [[-0.2, -0.5], [1.2, -0.5]]
fix = ["x", "y"]
[[monitors]]
name = "top"
point = [0.5, 2]
"""


def simulate(scene: str, formulation: str, extra: str = "") -> Run:
    found = run(parse_scene(scene, "scene"), parse_formulation(formulation + extra))
    assert found.summary.status == "converged", found.summary.sentence
    return found


@pytest.mark.parametrize("name", [*MESHES])
def test_a_projectile_flies_its_parabola_and_turns_exactly(name: str, projectile: str) -> None:
    stiff = projectile.replace("1e7", "1e10")
    found = simulate(stiff, MESHES[name], '[integrator]\ntype = "shi"\nstep = 0.02\n')
    frames = found.state.frames
    # Benchmark B13: constant acceleration is what Shi's rule integrates exactly.
    np.testing.assert_allclose(frames.centre[0], [3.5, 4.5 - 9.81 / 2], atol=1e-9)
    # It turns slower by twice its mean strain, (1 - nu) rho omega^2 a^2 / (12 E), of 4.7e-8; by a
    # quarter of that more where the strain may vary, and the rounding of that stiffness.
    assert frames.angle[0] == pytest.approx(2.0 - 9.3e-8, abs=4e-8)
    # Only the pull outwards strains: rho omega^2 a^2 / E = 4e-7 at most at a corner.
    assert np.abs(found.stepper.model.mean_strain(found.state.deformation)).max() < 4e-7
    assert found.summary.equilibrium_residual is not None
    assert found.summary.equilibrium_residual < 1e-10


def test_a_spinning_square_of_linear_covers_does_not_grow(projectile: str) -> None:
    spin = projectile.replace("[gravity]\n", "").replace(
        "velocity = [3, 4]", "velocity = [0, 0]", 1
    )
    spin = spin.replace("angular_velocity = 2.0", f"angular_velocity = {2 * np.pi}")
    stiff = spin.replace("1e7", "1e12")
    found = simulate(stiff, MESHES["linear"], '[integrator]\ntype = "shi"\nstep = 0.01\n')
    moved = found.manifold.elements.with_points(found.manifold.elements.points + found.displacement)
    # Benchmark B14: one turn in 100 steps; the linear update would grow by 48 %.
    assert moved.areas.sum() == pytest.approx(1.0, abs=1e-8)
    spin_rate = (found.stepper.model.rigid_projection @ found.state.velocity)[2]
    assert spin_rate == pytest.approx(2 * np.pi, rel=1e-6)
    # Mean stress of a turning square, rho omega^2 a^2 / 12, kept by Shi's damping.
    stress = found.stress * moved.areas[:, None]
    expected = 1000 * (2 * np.pi) ** 2 / 12
    assert stress.sum(axis=0)[:2] == pytest.approx([expected, expected], rel=1e-2)


@pytest.mark.parametrize("name", ["finite elements", "linear"])
def test_a_wave_in_a_bar_arrives_in_time_and_doubles_at_the_end(name: str) -> None:
    cover = MESHES[name].replace("0.4", "0.2").replace("0.5", "0.3")
    found = simulate(BAR, cover, '[integrator]\ntype = "newmark"\nstep = 0.05\n')
    time, end = found.history["time"], found.history["monitor:end:ux"]
    middle = found.history["monitor:middle:ux"]
    # Benchmark B16: u(L, 2 L / c) = 2 sigma L / E; the front passes the middle at t = 5, and the
    # displacement there grows by sigma c / E a second behind it.
    assert end[-1] == pytest.approx(2e-2, rel=0.02)
    behind = (time > 7) & (time < 12)
    slope, start = np.polyfit(time[behind], middle[behind], 1)
    assert -start / slope == pytest.approx(5.0, rel=0.02)


def top_of_one_body() -> float:
    """Displacement (m) of the top of the stack as one body, by quadratic elements of 0.05 m."""
    mesh = skfem.MeshQuad.init_tensor(np.linspace(-0.2, 1.2, 29), np.linspace(-0.5, 2, 51))
    x, y = mesh.p[:, mesh.t].mean(axis=1)
    mesh = mesh.restrict(np.flatnonzero((y < 0) | ((x > 0) & (x < 1))))
    basis = skfem.Basis(mesh, skfem.ElementVector(skfem.ElementQuad2()))
    stiffness = linear_elasticity(0.0, 1e7 / 2).assemble(basis)
    weight = skfem.LinearForm(lambda v, w: -1e4 * v[1]).assemble(basis)
    foot = basis.get_dofs(lambda x: np.isclose(x[1], -0.5))
    moved = skfem.solve(*skfem.condense(stiffness, weight, D=foot))
    top = np.flatnonzero(np.isclose(mesh.p.T, (0.5, 2)).all(axis=1))[0]
    return float(moved[basis.nodal_dofs[1, top]])


# Pressed everywhere and held by friction, the stack is as one body. Constant strains in triangles
# of 0.4 m leave out 2 % of the dent in the base, linear covers of 0.5 m a tenth of that.
@pytest.mark.parametrize(("name", "tolerance"), [("finite elements", 0.03), ("linear", 0.005)])
def test_bodies_of_meshes_rest_on_one_another_in_contact(name: str, tolerance: float) -> None:
    found = simulate(STACK, MESHES[name])
    column = found.history["monitor:top:uy"][-1]
    assert column == pytest.approx(top_of_one_body(), rel=tolerance)
    normal = found.contact_forces[:, 0]
    # Both interfaces together carry the upper block once and both once: 1e4 + 2e4 N.
    # The dents tilt a few contacts by 1e-3 against the weight.
    assert -normal.sum() == pytest.approx(3e4, rel=1e-3)
    reaction = found.history["reaction:ground:y"][-1]
    assert reaction == pytest.approx(1e4 * (2 + 0.7), rel=1e-4)


def test_the_summary_names_the_cures_and_how_many_they_act_on() -> None:
    found = simulate(BAR.replace("duration = 20.0", "duration = 0.1"), MESHES["quadratic"])
    cures = found.summary.cures
    assert cures["dependent functions, diagonal shift 1e-10"] == 16
    assert cures["covers that hold dependent functions"] == found.manifold.n_covers
    assert 0 < cures["covers in coordinates fitted to the cut"] <= found.manifold.n_covers
    tied = cures["covers tied to their neighbours beside supports (ghost)"]
    # The bar is 15 cells long: a support at its end reaches the first two columns of them.
    assert 0 < tied < found.manifold.n_covers / 3
    assert found.summary.covers == found.manifold.n_covers


def test_block_and_mesh_agree_on_a_uniform_stress() -> None:
    static = BAR.replace("[inertia]\n", "").replace("duration = 20.0\n", "")
    for name in ("finite elements", "linear", "quads", "splines"):
        found = simulate(static, MESHES[name])
        assert found.history["monitor:end:ux"][-1] == pytest.approx(1e-2, rel=1e-9)
    # A block on springs of 1000 E: 1e-3 A / (1000 E) more at the support.
    assert simulate(static, DDA).history["monitor:end:ux"][-1] == pytest.approx(1e-2, rel=1e-3)


CYLINDER = """
plane = "strain"
[materials.m]
young_modulus = 1
poisson_ratio = {nu}
[[blocks]]
name = "b"
material = "m"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[supports]]
name = "left"
segment = [[0, 0], [0, 1]]
fix = ["x", "y"]
[[loads]]
name = "pull"
kind = "edge"
segment = [[1, 0], [1, 1]]
traction = [1e-3, 0]
"""


@pytest.mark.parametrize(
    ("nu", "plane", "mesh", "warned"),
    [
        (0.49, "strain", "finite elements", True),
        (0.46, "strain", "meshless", True),
        (0.44, "strain", "finite elements", False),
        (0.49, "stress", "finite elements", False),
        (0.49, "strain", "linear", False),
        (0.49, "strain", "splines", False),
    ],
)
def test_constant_covers_of_a_nearly_incompressible_material_warn_that_they_lock(
    nu: float, plane: str, mesh: str, warned: bool, capsys: pytest.CaptureFixture[str]
) -> None:
    from nmm.cli.terminal import tell_run

    text = CYLINDER.format(nu=nu).replace('"strain"', f'"{plane}"')
    found = simulate(text, MESHES[mesh])
    assert len(found.summary.warnings) == warned
    tell_run(parse_scene(text, "scene"), found)
    assert capsys.readouterr().out.count("covers of degree 0 lock") == warned


def test_blocks_of_one_cover_each_do_not_warn() -> None:
    assert simulate(CYLINDER.format(nu=0.49), DDA).summary.warnings == []


SPIN = """
plane = "stress"
duration = {duration}
[inertia]
[materials.m]
young_modulus = 1e11
poisson_ratio = 0.3
density = 1000
[[blocks]]
name = "b"
material = "m"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[initial_velocities]]
block = "b"
velocity = [0, 0]
angular_velocity = 6.283185307179586
"""
RATE = 2 * np.pi


def test_every_registered_cover_is_among_the_meshes() -> None:
    from covers.mathematical.registry import COVERS

    named = {parse_formulation(text).cover.type for text in MESHES.values()}
    assert named >= set(COVERS)


def turned(name: str, turns: float, steps: int) -> Run:
    """A stiff square spun freely."""
    rule = f'[integrator]\ntype = "shi"\nstep = {turns / steps!r}\n'
    return simulate(SPIN.format(duration=turns), MESHES[name], rule)


def check_spin(found: Run) -> None:
    place = found.manifold.elements.points + found.displacement
    moved = found.manifold.elements.with_points(place)
    # Benchmark B14: classical updates grow by 48 % in a turn of 100 steps.
    pull = 1000 * RATE**2 / 12
    assert moved.areas.sum() == pytest.approx(1 + 2 * (1 - 0.3) * pull / 1e11, abs=1e-8)
    rate = (found.stepper.model.rigid_projection @ found.state.velocity)[2]
    assert rate == pytest.approx(RATE, rel=1e-6)
    # Mean stress rho omega^2 a^2 / 12 of a square that turns, after its vibrations are damped.
    mean = moved.areas @ found.stress
    np.testing.assert_allclose(mean, [pull, pull, 0.0], atol=0.02 * pull)


@pytest.mark.parametrize("name", [*MESHES])
def test_a_full_turn_changes_neither_size_nor_spin_under_any_cover(name: str) -> None:
    check_spin(turned(name, 1.0, 100))


@pytest.mark.slow
@pytest.mark.parametrize("name", ["finite elements", "linear", "splines", "meshless"])
def test_ten_turns_in_a_thousand_steps_do_not_drift(name: str) -> None:
    check_spin(turned(name, 10.0, 1000))


@pytest.mark.parametrize("name", [*MESHES])
def test_stress_turns_with_the_body_under_any_cover(name: str) -> None:
    from nmm.assembly.moving.motion import move
    from nmm.assembly.places import on_edges
    from nmm.constraints.imposition import Method
    from nmm.stepping.drive.linear_statics import equilibrium, hold
    from nmm.stepping.reports.framing import viewed

    still = simulate(SPIN.format(duration=0.001), MESHES[name], "[integrator]\nstep = 0.001\n")
    model, stepper = still.stepper.model, still.stepper
    every = np.ones(len(model.manifold.boundary), dtype=bool)
    strain = np.array([[1.0, 0.0], [0.0, -0.3]]) / 1e3
    size = parse_formulation(MESHES[name]).cover.size
    place = on_edges(model.manifold, every, 8)
    held = hold(model, place, Method("nitsche", size, 2), lambda p: p @ strain)
    state = equilibrium(model, [held]).state
    start = viewed(stepper, state, None).stress / 1e8
    # Least-squares covers miss uniform strains by their quadrature: 2e-3.
    near = 1e-2 if name == "meshless" else 1e-6
    area = model.element_area
    np.testing.assert_allclose(area @ start, [1.0, 0.0, 0.0], atol=near)
    quarter = np.zeros(3)
    quarter[2] = np.pi / 2 / 90
    for _ in range(90):
        state = move(model, state, model.manifold.rigid_modes @ quarter)
    after = viewed(stepper, state, None).stress / 1e8
    # Benchmark B14: xx and yy change places, shear its sign, element by element.
    np.testing.assert_allclose(after, start[:, [1, 0, 2]] * [1, 1, -1], atol=1e-6)


CRACKED = (
    CYLINDER.format(nu=0.3)
    + """
[[cracks]]
name = "edge"
points = [[0.5, 1.1], [0.5, 0.6]]
"""
)


def test_crack_tips_without_functions_are_told() -> None:
    plain = simulate(CRACKED, MESHES["linear"], "[cover.enrichment]\ntips = false\n")
    assert [text.split(":")[0] for text in plain.summary.warnings] == [
        "1 crack tips without tip functions, at [0.5, 0.6]"
    ]
    kinked = simulate(CRACKED.replace("[0.5, 0.6]]", "[0.5, 0.7], [0.6, 0.6]]"), MESHES["linear"])
    assert kinked.summary.warnings == []
    assert kinked.summary.cures["covers with singular functions"] > 0
    for options in ("", "[cover.enrichment]\n"):
        enriched = simulate(CRACKED, MESHES["linear"].replace("0.5", "0.2"), options)
        assert enriched.summary.warnings == []
        assert enriched.summary.cures["covers with singular functions"] > 0
