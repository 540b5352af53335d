"""Contact of meshes: the same answer whichever corner a list starts with, and in either order."""

import numpy as np
import pytest

from nmm.formulation import parse_formulation
from nmm.scene import parse_scene
from nmm.stepping.run import run

BLOCKS = {
    "base": [[0, 0], [2, 0], [2, 0.5], [0, 0.5]],
    "top": [[0.7, 0.5], [1.3, 0.5], [1.3, 1.1], [0.7, 1.1]],
}
COVERS = {
    "triangles": 'type = "triangles"\nsize = 0.3\nangle = 0.3\ndegree = 1',
    "triangles degree 0": 'type = "triangles"\nsize = 0.3\nangle = 0.3\ndegree = 0',
    "quads": 'type = "quads"\nsize = 0.3\nangle = 0.3\ndegree = 1',
    "block": 'type = "block"',
}
# Rounding of coordinates of 1 m, 1e-16, over ways of 1e-6 m. Quads are dependent in many functions:
# what the shift of their system leaves moves with rounding, measured 2e-6 under friction.
ROUNDING = {"triangles": 1e-9, "triangles degree 0": 1e-9, "quads": 1e-5, "block": 1e-9}


def answer(
    order: list[str], turns: int, cover: str, enforcement: str, friction: float, update: str
) -> np.ndarray:
    """Way of a corner and strain energy of a block pressed and pushed along on a held one."""
    tables = "".join(
        f'[[blocks]]\nname = "{name}"\nmaterial = "m"\n'
        f"vertices = {BLOCKS[name][turns:] + BLOCKS[name][:turns]}\n"
        for name in order
    )
    push = 3000 if friction else 0
    held = '[[supports]]\nname = "w"\npoint = [0.7, 1.1]\nfix = ["x"]\n'
    scene = (
        'plane = "strain"\n[materials.m]\nyoung_modulus = 1e10\npoisson_ratio = 0.2\n'
        f"density = 2000\n[interfaces.i]\nfriction_angle = {friction}\n[gravity]\n[contact]\n"
        f'{tables}[[supports]]\nname = "f"\nsegment = [[0, 0], [2, 0]]\nfix = ["x", "y"]\n'
        f'[[loads]]\nname = "l"\nkind = "edge"\nsegment = [[0.7, 1.1], [1.3, 1.1]]\n'
        f"traction = [{push}, -1e4]\n"
        f'{"" if friction else held}[[monitors]]\nname = "m"\npoint = [1, 1.1]\nblock = "top"\n'
    )
    text = f'[cover]\n{COVERS[cover]}\n[contact]\nenforcement = "{enforcement}"\n'
    found = run(
        parse_scene(scene, "scene"), parse_formulation(f'{text}[rotation]\nupdate = "{update}"\n')
    )
    assert found.summary.status == "converged", found.summary.sentence
    history = found.history
    way = np.array([history[f"monitor:m:{axis}"][-1] for axis in ("ux", "uy")])
    return np.array([*way / np.abs(way).max(), np.abs(way).max(), history["strain_energy"][-1]])


@pytest.mark.parametrize("friction", [0.0, 1.3])
@pytest.mark.parametrize("enforcement", ["penalty", "cone"])
@pytest.mark.parametrize("cover", list(COVERS))
def test_contact_does_not_know_the_first_vertex_of_a_list(
    cover: str, enforcement: str, friction: float
) -> None:
    first = answer(["base", "top"], 0, cover, enforcement, friction, "auto")
    for turns in (1, 2, 3):
        other = answer(["base", "top"], turns, cover, enforcement, friction, "auto")
        np.testing.assert_allclose(other, first, rtol=0, atol=ROUNDING[cover])


@pytest.mark.parametrize("friction", [0.0, 1.3])
@pytest.mark.parametrize("enforcement", ["penalty", "cone"])
@pytest.mark.parametrize("cover", list(COVERS))
def test_contact_does_not_know_the_order_of_blocks(
    cover: str, enforcement: str, friction: float
) -> None:
    # Where bodies' axes stay; with corrections for the moved place see below.
    one, other = (
        answer(order, 0, cover, enforcement, friction, "small")
        for order in (["base", "top"], ["top", "base"])
    )
    np.testing.assert_allclose(other, one, rtol=0, atol=ROUNDING[cover])


@pytest.mark.parametrize("enforcement", ["penalty", "cone"])
@pytest.mark.parametrize("cover", list(COVERS))
def test_friction_after_corrections_does_not_know_the_order_of_blocks(
    cover: str, enforcement: str
) -> None:
    one, other = (
        answer(order, 0, cover, enforcement, 1.3, "auto")
        for order in (["base", "top"], ["top", "base"])
    )
    # Points that divide in the step have slid as far as moved places say: 2e-6 m beside sides of
    # 0.6 m that turn by as little.
    np.testing.assert_allclose(other, one, rtol=2e-6, atol=2e-6)
