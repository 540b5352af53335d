"""Glued blocks: the same answer in any order of blocks and vertices, with slivers or without."""

import itertools

import numpy as np
import pytest

from nmm.formulation import parse_formulation
from nmm.scene import parse_scene
from nmm.stepping.run import Run, run

HEAD = """
plane = "strain"
[materials.rock]
young_modulus = 1e9
poisson_ratio = 0.2
density = 2000
[interfaces.glue]
friction_angle = 0.5
bonded = true
[gravity]
[[supports]]
name = "floor"
segment = [[0, 0], [2, 0]]
fix = ["x", "y"]
"""
PULL = """
[[loads]]
name = "side"
kind = "edge"
segment = [[2, 0], [2, 1.3]]
traction = [0, -1e4]
[[monitors]]
name = "corner"
point = [2, 1.3]
"""

COVERS = {
    "block": 'type = "block"',
    "rigid": 'type = "block"\nfunctions = "rigid"',
    "block degree 2": 'type = "block"\nfunctions = "monomials"\ndegree = 2',
    "sub-blocks": 'type = "sub_blocks"\nsize = 0.5\n'
    'options = {mesh = "triangles", glue = "nitsche"}',
    "triangles": 'type = "triangles"\nsize = 0.4\nangle = 0.3\ndegree = 1',
    "triangles degree 0": 'type = "triangles"\nsize = 0.4\nangle = 0.3\ndegree = 0',
}


def bricks(seed: int) -> list[list[list[float]]]:
    """Two courses of rectangles of random lengths with joints that do not meet."""
    random, rings = np.random.default_rng(seed), []
    for low, high in ((0.0, 0.7), (0.7, 1.3)):
        # At least 0.05 m long: a sliver of 1e-8 of a cell would bring rounding over its width.
        between = 0.2 + 0.4 * np.arange(4) + random.uniform(0.05, 0.35, 4)
        ends = [0.0, *between.round(3).tolist(), 2.0]
        for a, b in itertools.pairwise(ends):
            rings.append([[a, low], [b, low], [b, high], [a, high]])
    return rings


def simulate(
    blocks: list[tuple[str, list[list[float]]]], more: str, formulation: str, ratio: float = 0.2
) -> Run:
    tables = "".join(
        f'[[blocks]]\nname = "{name}"\nmaterial = "rock"\nvertices = {ring}\n'
        for name, ring in blocks
    )
    head = HEAD.replace("poisson_ratio = 0.2", f"poisson_ratio = {ratio}")
    found = run(parse_scene(head + tables + more, "scene"), parse_formulation(formulation))
    assert found.summary.status == "converged", found.summary.sentence
    return found


def answer(found: Run) -> np.ndarray:
    """Displacement of a corner, work of the loads and strain energy."""
    corner = np.array([found.history[f"monitor:corner:{axis}"][-1] for axis in ("ux", "uy")])
    work = found.history["external_work"][-1]
    return np.array([*corner, work, found.history["strain_energy"][-1]])


@pytest.mark.parametrize("method", ["auto", "spring", "lagrange"])
@pytest.mark.parametrize("cover", list(COVERS))
@pytest.mark.parametrize("seed", [0, 1])
def test_glued_bricks_do_not_know_the_order_they_are_written_in(
    seed: int, cover: str, method: str
) -> None:
    rings, random = bricks(seed), np.random.default_rng(seed + 10)
    names = [f"b{number}" for number in range(len(rings))]
    text = f'[cover]\n{COVERS[cover]}\n[glue]\nmethod = "{method}"\n'
    first = answer(simulate(list(zip(names, rings, strict=True)), PULL, text))
    for _ in range(2):
        turn = random.integers(4, size=len(rings))
        blocks = [(names[i], rings[i][turn[i] :] + rings[i][: turn[i]]) for i in range(len(rings))]
        other = simulate([blocks[i] for i in random.permutation(len(rings))], PULL, text)
        # Springs of glue, 1e4 E a metre against blocks, have a condition of 1e6: 1e-16 times it.
        # Dependent functions of triangles leave the rounding of a shift of 1e-10: measured 1e-11.
        exact = method != "spring" and not cover.startswith("triangles")
        tolerance = 2e-12 if exact else 1e-10
        size = np.concatenate([np.full(2, np.abs(first[:2]).max()), np.full(2, first[2])])
        # Displacements are differences of places of up to 2 m.
        rounding = np.array([4e-16, 4e-16, 0.0, 0.0])
        assert (np.abs(answer(other) - first) <= tolerance * size + rounding).all()


@pytest.mark.parametrize("ratio", [0.4, 0.49])
@pytest.mark.parametrize("cover", ["block degree 2", "triangles", "triangles degree 0"])
def test_nearly_incompressible_bricks_do_not_either(cover: str, ratio: float) -> None:
    """Pressures see the gaps of all joints of a brick, those where it is listed second too."""
    rings = bricks(2)
    blocks = [(f"b{number}", ring) for number, ring in enumerate(rings)]
    text = f'[cover]\n{COVERS[cover]}\n[glue]\nmethod = "nitsche"\n'
    first = answer(simulate(blocks, PULL, text, ratio))
    for seed in (0, 1):
        order = np.random.default_rng(seed).permutation(len(rings))
        other = answer(simulate([blocks[i] for i in order], PULL, text, ratio))
        # As above; 1e-7 to 5e-3 where either side had pressures of its own.
        assert np.abs(other - first).max() <= 1e-10 * np.abs(first).max()


@pytest.mark.parametrize("method", ["auto", "lagrange"])
@pytest.mark.parametrize("side", ["top", "left", "right", "all"])
@pytest.mark.parametrize("thickness", [1e-3, 1e-6])
def test_a_sliver_without_weight_glued_on_does_not_soften_a_block(
    thickness: float, side: str, method: str
) -> None:
    t = thickness
    block = ("block", [[0, 0], [2, 0], [2, 1.3], [0, 1.3]])
    slivers = {
        "top": [[0, 1.3], [2, 1.3], [2, 1.3 + t], [0, 1.3 + t]],
        "left": [[-t, 0], [0, 0], [0, 1.3], [-t, 1.3]],
        "right": [[2, 0], [2 + t, 0], [2 + t, 1.3], [2, 1.3]],
    }
    chosen = slivers if side == "all" else {side: slivers[side]}
    monitor = '[[monitors]]\nname = "corner"\npoint = [2, 1.3]\nblock = "block"\n'
    text = f'[glue]\nmethod = "{method}"\n'
    alone = simulate([block], monitor, text)
    more = simulate([block, *chosen.items()], monitor, text)
    # The slivers' own weight and stiffness are a share of at most 3 t.
    one, two = answer(alone), answer(more)
    assert np.abs(two[:2] - one[:2]).max() <= 3 * t * np.abs(one[:2]).max()
    assert two[2:] == pytest.approx(one[2:], rel=6 * t)
