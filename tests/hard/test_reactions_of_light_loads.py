"""Reactions keep their digits where a load moves a support by less than coordinates are rounded."""

import numpy as np
import pytest

from nmm.formulation import parse_formulation
from nmm.scene import parse_scene
from nmm.stepping.run import run

COVERS = {
    "block": "",
    "triangles": '[cover]\ntype = "triangles"\nsize = {size}\ndegree = 1\nangle = 0.3\n',
}


def slab(length: float, modulus: float, contact: bool) -> str:
    """A slab held as a whole with a block on it, a fortieth as long, all times a length."""
    a = length

    def box(x: float, y: float, w: float, h: float) -> list[list[float]]:
        return [
            [a * x, a * y],
            [a * (x + w), a * y],
            [a * (x + w), a * (y + h)],
            [a * x, a * (y + h)],
        ]

    bonded = "" if contact else "bonded = true\n"
    return (
        f'plane = "strain"\n[materials.m]\nyoung_modulus = {modulus}\npoisson_ratio = 0.2\n'
        f"density = 1.0\n[interfaces.i]\nfriction_angle = 0.6\n{bonded}"
        f'[[blocks]]\nname = "slab"\nmaterial = "m"\nvertices = {box(0, 0, 40, 1)}\n'
        f'[[blocks]]\nname = "top"\nmaterial = "m"\nvertices = {box(10, 1, 1, 1)}\n'
        '[[supports]]\nname = "s"\nblock = "slab"\nfix = ["x", "y"]\n[gravity]\n'
        + ("[contact]\n" if contact else "")
    )


@pytest.mark.parametrize("contact", [True, False], ids=["contact", "glue"])
@pytest.mark.parametrize("cover", list(COVERS))
@pytest.mark.parametrize("modulus", [1e6, 2e11, 1e16])
@pytest.mark.parametrize("length", [1e-3, 1.0, 1e3])
def test_a_held_slab_carries_its_weight_to_the_last_digits(
    length: float, modulus: float, cover: str, contact: bool
) -> None:
    method = '[supports]\nmethod = "penalty"\n' if cover != "block" else ""
    text = COVERS[cover].format(size=5.0 * length) + method
    found = run(parse_scene(slab(length, modulus, contact), "scene"), parse_formulation(text))
    assert found.summary.status == "converged", found.summary.sentence
    # 40 + 1 squares of 1 kg/m3; the reaction is in balance with what the step solves.
    weight = 9.81 * 41 * length**2
    assert found.history["reaction:s:y"][-1] == pytest.approx(weight, rel=1e-8)
    assert abs(found.history["reaction:s:x"][-1]) < 1e-8 * weight


def test_ways_of_turned_bodies_are_differences_of_places() -> None:
    from dataclasses import replace

    from nmm.assembly.material_points import vertex_points
    from nmm.assembly.moving.motion import move
    from nmm.assembly.state import initial_state

    found = run(parse_scene(slab(1.0, 1e9, True), "scene"), parse_formulation(""))
    model = found.stepper.model
    start, points = initial_state(model.manifold), vertex_points(model.manifold)
    random = np.random.default_rng(1)
    state = start
    for _ in range(5):
        state = move(model, state, 0.1 * random.normal(size=model.manifold.n_unknowns))
    way = points.place(state.frames, state.deformation) - points.place(
        start.frames, start.deformation
    )
    # Coordinates of 40 m are rounded to 7e-15.
    np.testing.assert_allclose(
        points.moved(state.frames, state.deformation), way, rtol=0, atol=1e-12
    )
    still = replace(state.frames, way=None)
    with pytest.raises(AssertionError):
        points.moved(still, state.deformation)
