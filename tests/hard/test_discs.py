"""Least-squares covers on random bodies: discs that hardly reach the material spoil nothing."""

from functools import cache

import numpy as np
import pytest

from covers.cutting.cut import cut
from covers.mathematical.meshless.disc_supports import fitted_discs, shares
from covers.mathematical.meshless.moving_least_squares import MovingLeastSquares
from integration.polygons import Polygons
from nmm.errors import FormulationError
from nmm.formulation import parse_formulation
from nmm.scene import parse_scene
from nmm.stepping.run import Run, run

HEAD = """
plane = "strain"
[materials.rock]
young_modulus = 1e9
poisson_ratio = 0.3
density = 2000
[gravity]
"""


def body(kind: str, random: np.random.Generator) -> tuple[str, float]:
    """A clamped body with a push in a corner and on its lower edge, and its smaller side."""
    w, h = random.uniform(0.8, 1.4, 2).round(2).tolist()
    ring = [[0, 0], [w, 0], [w, h], [0, h]]
    if kind == "angle":
        ring = [[0, 0], [w, 0], [w, h / 2], [0.4 * w, h / 2], [0.4 * w, h], [0, h]]
    crack = ""
    if kind == "cracked":
        crack = f'[[cracks]]\nname = "c"\npoints = [[{w / 2}, {h}], [{w / 2}, {0.55 * h}]]\n'
    scene = (
        f'{HEAD}[[blocks]]\nname = "b"\nmaterial = "rock"\nvertices = {ring}\n{crack}'
        f'[[supports]]\nname = "wall"\nsegment = [[0, 0], [0, {h}]]\nfix = ["x", "y"]\n'
        f'[[loads]]\nname = "push"\nkind = "point"\npoint = {ring[2]}\nforce = [520, -300]\n'
        f'[[loads]]\nname = "edge"\nkind = "edge"\nsegment = [[0, 0], [{w}, 0]]\n'
        f'traction = [0, -1e4]\n[[monitors]]\nname = "low"\npoint = [{w}, 0]\n'
    )
    return scene, min(w, h)


def simulate(scene: str, cover: str, method: str = "nitsche") -> Run:
    text = f'[cover]\n{cover}\n[supports]\nmethod = "{method}"\n'
    found = run(parse_scene(scene, "scene"), parse_formulation(text))
    assert found.summary.status == "converged", found.summary.sentence
    return found


def measured(found: Run) -> tuple[float, np.ndarray, float]:
    """Work of the loads, way (2,) of the lower corner and the largest displacement."""
    way = np.array([found.history[f"monitor:low:{axis}"][-1] for axis in ("ux", "uy")])
    return found.history["external_work"][-1], way, float(np.abs(found.displacement).max())


@cache
def fine(scene: str, side: float) -> tuple[float, np.ndarray, float]:
    """The same on fine triangles, once for each body."""
    return measured(simulate(scene, f'type = "triangles"\nsize = {side / 9}\ndegree = 1'))


# Degree, basis, method, largest error of the work of the loads and of the way of the lower corner,
# and largest condition, with cells of a fifth of the smaller side. Measured over 75 random bodies,
# 25 of each kind: 0.18, 0.22, 0.25, 0.08, 0.08 and 5e5, 2e6, 1e5, 5e12, 2e8. Functions of degree 1
# with a linear basis depend on one another, and the estimate is that of their shift.
CASES = {
    "linear basis": (0, 1, "nitsche", 0.25, 1e6),
    "linear basis on springs": (0, 1, "penalty", 0.25, 1e7),
    "linear basis, multipliers": (0, 1, "lagrange", 0.35, 1e6),
    "linear basis, degree 1": (1, 1, "nitsche", 0.12, 1e14),
    "Shepard, degree 1": (1, 0, "nitsche", 0.12, 1e9),
}


@pytest.mark.parametrize("kind", ["rectangle", "angle", "cracked"])
@pytest.mark.parametrize("case", list(CASES))
@pytest.mark.parametrize(
    "seed", [0, 1, *(pytest.param(seed, marks=pytest.mark.slow) for seed in (2, 3))]
)
def test_least_squares_on_random_bodies_move_as_triangles_do(
    seed: int, case: str, kind: str
) -> None:
    degree, basis, method, error, condition = CASES[case]
    random = np.random.default_rng([seed, len(kind)])
    scene, side = body(kind, random)
    fine_work, fine_way, fine_most = fine(scene, side)
    net = f"angle = {random.uniform(0, 1.5)}\nshift = {random.uniform(0, 1, 2).tolist()}\n"
    size = round(side / 5, 4)
    cover = f'type = "mls"\nsize = {size}\n{net}degree = {degree}\noptions = {{ degree = {basis} }}'
    found = simulate(scene, cover, method)
    work, way, most = measured(found)
    assert work == pytest.approx(fine_work, rel=error)
    assert np.abs(way - fine_way).max() < error * np.abs(fine_way).max()
    assert found.summary.equilibrium_residual is not None
    assert found.summary.equilibrium_residual < 1e-9
    assert found.summary.condition_estimate is not None
    assert found.summary.condition_estimate < condition
    # Nothing beyond the body moves more than it does: no corner of a disc's rim flies off.
    assert most < 1.3 * fine_most


def square(low: float, high: float) -> Polygons:
    return Polygons.from_vertices([np.array([[low, low], [high, low], [high, high], [low, high]])])


def test_shares_of_discs_are_those_of_their_quarters_and_halves() -> None:
    # Nodes at multiples of 0.5 and radius 1: discs in a square of side 6 centred on its corner,
    # the middle of an edge and its middle.
    cover = MovingLeastSquares.regular([[-3, -3], [3, 3]], 0.5)
    pieces = cut(cover, square(-3.0, 3.0))
    found = shares(cover, pieces)
    centre = cover.patch_centre[pieces.cover_patch]
    for point, share in (((3.0, 3.0), 0.25), ((3.0, 0.0), 0.5), ((0.0, 0.0), 1.0)):
        at = np.hypot(*(centre - point).T) < 1e-9
        assert at.sum() == 1
        # The kernel's rim is integrated to degree 8 in cells of half a radius.
        assert found[at][0] == pytest.approx(share, rel=2e-3)


@pytest.mark.parametrize("turn", [0.0, 0.3, 0.8])
def test_weights_hold_linear_fields_when_discs_are_left_out(turn: float) -> None:
    cover = MovingLeastSquares.regular([[0, 0], [1, 1]], 0.3, angle=turn, shift=(0.2, 0.7))
    region = square(0.0, 1.0)

    def again(other: MovingLeastSquares):
        return cut(other, region)

    kept, pieces = cover.settled(again(cover), again)
    assert kept.left_out > 0
    assert not np.isin(-1, pieces.covers.max(axis=1))
    points = pieces.elements.points
    cells = pieces.element_cell[pieces.elements.polygon_of_point]
    weights = kept.weights(cells, points)
    np.testing.assert_allclose(weights.sum(axis=1), 1.0, atol=1e-12)
    centre = kept.patch_centre[kept.cell_patches[cells]]
    np.testing.assert_allclose(np.einsum("mk,mkj->mj", weights, centre), points, atol=1e-12)
    # Discs that are left reach a fair part of the material.
    again_left, _ = fitted_discs(kept, pieces)
    assert again_left.left_out == kept.left_out or shares(kept, pieces).min() > 0.005


@pytest.mark.parametrize("thickness", [0.3, 0.03])
def test_strips_thinner_than_the_discs_bend_as_beams(thickness: float) -> None:
    t = thickness
    scene = (
        f'{HEAD.replace("[gravity]", "")}[[blocks]]\nname = "b"\nmaterial = "rock"\n'
        f"vertices = [[0, 0], [3, 0], [3, {t}], [0, {t}]]\n"
        f'[[supports]]\nname = "wall"\nsegment = [[0, 0], [0, {t}]]\nfix = ["x", "y"]\n'
        f'[[loads]]\nname = "edge"\nkind = "edge"\nsegment = [[3, 0], [3, {t}]]\n'
        f'traction = [0, {-1e3 * t**2}]\n[[monitors]]\nname = "end"\npoint = [3, 0]\n'
    )
    cover = 'type = "mls"\nsize = 0.3\nangle = 0.3\nshift = [0.4, 0.3]\ndegree = 0\n'
    found = simulate(scene, cover + "options = { degree = 2 }")
    # P L^3 / (3 E' I) with P = 1e3 t^3, I = t^3 / 12 and E' = E / (1 - nu^2); shear is 1e-2 of it.
    end = -1e3 * 27 * 12 / (3 * 1e9 / 0.91)
    assert found.history["monitor:end:uy"][-1] == pytest.approx(end, rel=0.08)


def test_weights_and_functions_that_hold_constants_only_are_refused() -> None:
    scene, _ = body("rectangle", np.random.default_rng(0))
    cover = 'type = "mls"\nsize = 0.35\ndegree = 0\noptions = { degree = 0 }'
    with pytest.raises(FormulationError, match="constants only"):
        simulate(scene, cover)
