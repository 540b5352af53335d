"""Joints of Goodman and glue between blocks, under block covers and meshes."""

from pathlib import Path

import numpy as np
import pytest

from nmm.assembly.state import initial_state
from nmm.contact.detection.joints import Joints, find_joints
from nmm.contact.points.boundary_points import sides
from nmm.errors import FormulationError
from nmm.formulation import parse_formulation
from nmm.scene import parse_scene
from nmm.stepping.run import Run, run
from nmm.testing.scenes import pulled_bar
from nmm.verification import text


def bars(modulus: float = 1e4, joint: float = 1) -> str:
    """A soft bar that holds a bar of a modulus (Pa), glued at a place (m)."""
    between = ("soft", "hard")
    scene = pulled_bar(
        [text.material("soft", 1.0, 0.0, None), text.material("hard", modulus, 0.0, None)],
        [("one", "soft"), ("two", "hard")],
        text.interface("joint", 0.0, between, {"bonded": True}),
        ends=(joint, 2),
    )
    return scene + text.monitor("near", (joint, 0.5), "one")


MESH = '[cover]\ntype = "triangles"\nsize = 0.4\ndegree = 1\nangle = 0.3\n'


def simulate(scene: str, formulation: str) -> Run:
    found = run(parse_scene(scene, "scene"), parse_formulation(formulation))
    assert found.summary.status == "converged", found.summary.sentence
    return found


COVERS = {
    "block": '[cover]\ntype = "block"\n',
    "block2": '[cover]\ntype = "block"\nfunctions = "monomials"\ndegree = 2\n',
    **{
        f"{kind}{p}": f'[cover]\ntype = "{kind}"\nsize = 0.4\ndegree = {p}\nangle = 0.3\n'
        for kind in ("triangles", "quads")
        for p in (0, 1, 2)
    },
}


@pytest.mark.parametrize("method", ["nitsche", "lagrange"])
@pytest.mark.parametrize("cover", list(COVERS))
def test_glued_bars_carry_one_stress_whatever_their_stiffness(cover: str, method: str) -> None:
    # Benchmark A9a: stress 1 in both to 1e-8. The displacement of the hard bar, 1, times its
    # stiffness, 1e9, has 1e-7 of the load in its roundings: rigid motions must be kept apart.
    for ratio in (1.0, 1e4, 1e9):
        scene = bars(ratio)
        found = simulate(scene, COVERS[cover] + f'[glue]\nmethod = "{method}"\n')
        np.testing.assert_allclose(
            found.stress, np.tile([1.0, 0, 0], (len(found.stress), 1)), atol=1e-8
        )
        assert found.summary.equilibrium_residual is not None
        assert found.summary.equilibrium_residual < 1e-8
        # The springs of a block's support give by 1 / 3000.
        give = 1 / 3000 if "block" in cover else 0.0
        end = found.history["monitor:end:ux"][-1]
        assert end == pytest.approx(1 + 1 / ratio + give, abs=1e-8)


def test_springs_of_glue_open_by_stress_over_their_stiffness() -> None:
    scene = bars(1e9)
    found = simulate(scene, MESH + '[glue]\nmethod = "spring"\nstiffness = 1e3\n')
    longest = max(np.hypot(*(joint.end - joint.start).T).max() for joint in [joints_of(found)])
    end = found.history["monitor:end:ux"][-1]
    assert end - 1 - 1e-9 == pytest.approx(longest / 1e3, rel=1e-8)
    np.testing.assert_allclose(found.stress[:, 0], 1.0, atol=1e-8)
    assert found.summary.equilibrium_residual is not None
    assert found.summary.equilibrium_residual < 1e-8


def joints_of(found: Run) -> Joints:
    model = found.stepper.model
    start = initial_state(model.manifold)
    return find_joints(sides(model.manifold).surface(start.frames, start.deformation))


KINKED = """
plane = "stress"
[materials.m]
young_modulus = 1000
poisson_ratio = 0.3
[interfaces.glue]
friction_angle = 0
bonded = true
[[blocks]]
name = "one"
material = "m"
vertices = [[0, 0], [1.03, 0], [1.13, 0.45], [0.98, 0.7], [1.03, 1], [0, 1]]
[[blocks]]
name = "two"
material = "m"
vertices = [[1.03, 0], [2, 0], [2, 1], [1.03, 1], [0.98, 0.7], [1.13, 0.45]]
[[supports]]
name = "left"
segment = [[0, 0], [0, 1]]
fix = ["x"]
[[supports]]
name = "below one"
segment = [[0, 0], [1.03, 0]]
fix = ["y"]
[[supports]]
name = "below two"
segment = [[1.03, 0], [2, 0]]
fix = ["y"]
[[loads]]
name = "pull"
kind = "edge"
segment = [[2, 0], [2, 1]]
traction = [1, 0]
[[monitors]]
name = "one"
point = [1.03, 1]
block = "one"
[[monitors]]
name = "two"
point = [1.03, 1]
block = "two"
"""


@pytest.mark.parametrize("method", ["nitsche", "lagrange"])
@pytest.mark.parametrize("cover", [name for name in COVERS if "block" not in name])
def test_a_patch_split_along_a_kinked_line_and_glued_is_whole(cover: str, method: str) -> None:
    # Benchmark A1c: the linear field of one material, no jump.
    found = simulate(KINKED, COVERS[cover] + f'[glue]\nmethod = "{method}"\n')
    exact = np.tile([1.0, 0.0, 0.0], (len(found.stress), 1))
    np.testing.assert_allclose(found.stress, exact, atol=1e-10)
    for axis in ("ux", "uy"):
        one, two = (found.history[f"monitor:{name}:{axis}"][-1] for name in ("one", "two"))
        assert two - one == pytest.approx(0.0, abs=1e-13)


@pytest.mark.parametrize("method", ["nitsche", "lagrange"])
@pytest.mark.parametrize("degree", [0, 1, 2])
@pytest.mark.parametrize("ratio", [1.0, 1e9])
def test_glue_is_conditioned_alike_however_small_the_cuts(
    degree: int, method: str, ratio: float
) -> None:
    bounds = []
    for sliver in (0.3, 1e-3, 1e-6, 1e-9, 1e-12, -1e-6, -1e-12):
        # Quads of 0.25 shifted by 0.13 of a cell have a line at 0.7825.
        scene = bars(ratio, 0.7825 + 0.25 * sliver)
        cover = f'[cover]\ntype = "quads"\nsize = 0.25\ndegree = {degree}\nshift = [0.13, 0.29]\n'
        found = simulate(scene, cover + f'[glue]\nmethod = "{method}"\n')
        # A sliver's stress is as good as its energy, which goes with the root of its area:
        # measured 5e-8 on slivers 1e9 times as stiff as their neighbours, degree 2.
        area = found.manifold.elements.areas / 0.25**2
        assert (np.sqrt(area) * np.abs(found.stress[:, 0] - 1)).max() < 2e-7
        factor = found.stepper.factor
        assert factor is not None
        dense = factor.scale[:, None] * factor.matrix.toarray() * factor.scale
        size = np.sort(np.abs(np.linalg.eigvalsh(dense)))
        kept = size[size > 1e-11 * size[-1]]
        if method == "nitsche":
            assert np.linalg.eigvalsh(dense)[0] > -1e-12
        bounds.append(kept[-1] / kept[0])
    # The first is a cut of 0.3 of a cell; measured at most 1.0 of its condition in those smaller.
    # (With 1e9 between the materials soft motions cannot be told from dependent functions.)
    assert ratio > 1 or max(bounds[1:]) < 1.5 * bounds[0]


@pytest.mark.parametrize(
    ("method", "said"),
    [
        ("spring", "springs at"),
        ("auto", "Nitsche's method at"),
        ("lagrange", "Lagrange multipliers"),
    ],
)
def test_explain_says_how_blocks_are_glued(method: str, said: str, tmp_path: Path) -> None:
    from typer.testing import CliRunner

    from nmm.cli.app import app

    scene, formulation = tmp_path / "bars.toml", tmp_path / "mesh.toml"
    scene.write_text('title = "bars"\n' + bars(), encoding="utf-8")
    formulation.write_text(MESH + f'[glue]\nmethod = "{method}"\n', encoding="utf-8")
    told = CliRunner().invoke(app, ["explain", str(scene), "-f", str(formulation)])
    assert told.exit_code == 0, told.output
    line = next(line for line in told.output.splitlines() if line.startswith("bonded interfaces: "))
    assert said in line


def test_functions_without_strain_cannot_be_glued_by_nitsche() -> None:
    rigid = '[cover]\ntype = "block"\nfunctions = "rigid"\n'
    with pytest.raises(FormulationError, match="neither side has functions with strain"):
        simulate(bars(), rigid + '[glue]\nmethod = "nitsche"\n')
    found = simulate(bars(), rigid)
    # Springs of 1e4 E over the edge, and those of the support, 1e3 E.
    end = found.history["monitor:end:ux"][-1]
    assert end == pytest.approx(1e-4 + 1 / 3000, rel=1e-6)


def test_a_hard_block_that_tilts_on_a_soft_one_keeps_its_digits() -> None:
    def stress(young: float, method: str) -> tuple[np.ndarray, float]:
        scene = bars(young)
        scene = scene.replace("segment = [[2, 0], [2, 1]]", "segment = [[1.5, 1], [2, 1]]")
        cover = MESH.replace("0.4", "0.3")
        found = simulate(scene, cover + f'[glue]\nmethod = "{method}"\n')
        hard = found.manifold.element_region == 1
        area = found.manifold.elements.areas[hard]
        assert found.summary.equilibrium_residual is not None
        return area @ found.stress[hard] / area.sum(), found.summary.equilibrium_residual

    for method in ("nitsche", "lagrange"):
        soft, _ = stress(1e6, method)
        hard, residual = stress(1e9, method)
        # What the hard block's own strain does to the stress falls as 1 / E: 1e-6.
        np.testing.assert_allclose(hard, soft, atol=1e-6)
        assert residual < 1e-8


@pytest.mark.parametrize("method", ["spring", "nitsche", "lagrange"])
@pytest.mark.parametrize("cover", ["block", "triangles1"])
def test_two_glued_blocks_spin_as_one(cover: str, method: str) -> None:
    scene = """
plane = "stress"
duration = 0.2
[inertia]
[materials.m]
young_modulus = 1e6
poisson_ratio = 0.2
density = 1000
[interfaces.joint]
friction_angle = 0
bonded = true
[[blocks]]
name = "one"
material = "m"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[blocks]]
name = "two"
material = "m"
vertices = [[1, 0], [2, 0], [2, 1], [1, 1]]
[[initial_velocities]]
block = "one"
velocity = [1, -1]
angular_velocity = 2
[[initial_velocities]]
block = "two"
velocity = [1, 1]
angular_velocity = 2
"""
    chosen = COVERS[cover] + f'[glue]\nmethod = "{method}"\n[integrator]\nstep = 0.002\n'
    found = simulate(scene, chosen)
    # Stretched by rho omega^2 a^2 / 12 along sides of 2 m and 1 m, they have 2.05e-3 more moment of
    # inertia; a swing of the stretch and its bend between and in the blocks are a tenth of that.
    np.testing.assert_allclose(found.state.frames.angle, 0.4 * (1 - 2.05e-3), rtol=4e-4)
    # rho A v^2 / 2 + I omega^2 / 2 of a plate 2 x 1: 1000 + 0.5 * 833.3 * 4; the rest is
    # the integrator's, which is of first order.
    history = found.history
    total = sum(history[name][-1] for name in ("kinetic_energy", "strain_energy", "support_energy"))
    assert total == pytest.approx(1000 + 0.5 * 1000 * 2 * 5 / 12 * 4, rel=5e-3)


@pytest.mark.parametrize("method", ["nitsche", "lagrange"])
def test_meshes_that_do_not_match_are_glued_alike(method: str) -> None:
    net = '[[cover.nets]]\nblock = "two"\nsize = 0.17\nangle = 1.0\n'
    scene = bars(1e9)
    found = simulate(scene, MESH + net + f'[glue]\nmethod = "{method}"\n')
    exact = np.tile([1.0, 0.0, 0.0], (len(found.stress), 1))
    np.testing.assert_allclose(found.stress, exact, atol=1e-8)
    assert found.summary.equilibrium_residual is not None
    assert found.summary.equilibrium_residual < 1e-8
