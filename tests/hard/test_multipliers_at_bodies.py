"""Edges held by multipliers across bodies of other stiffness: columns side by side."""

import itertools

import numpy as np
import pytest

from nmm.formulation import parse_formulation
from nmm.scene import parse_scene
from nmm.stepping.run import run

COVERS = [("triangles", 0), ("triangles", 1), ("triangles", 2), ("quads", 1), ("bspline", 0)]


def columns(widths: list[float], moduli: list[float]) -> str:
    """Columns without lateral strain, pressed together by 1e-3 of their height of 1 m."""
    ends = np.concatenate([[0.0], np.cumsum(widths)]).round(6).tolist()
    parts = ['plane = "stress"\n[interfaces.glue]\nfriction_angle = 0\nbonded = true\n']
    for number, (a, b) in enumerate(itertools.pairwise(ends)):
        parts.append(
            f"[materials.m{number}]\nyoung_modulus = {moduli[number]}\npoisson_ratio = 0.0\n"
            f'[[blocks]]\nname = "b{number}"\nmaterial = "m{number}"\n'
            f"vertices = [[{a}, 0], [{b}, 0], [{b}, 1], [{a}, 1]]\n"
        )
    wide = ends[-1]
    return "".join(parts) + (
        f'[[supports]]\nname = "floor"\nsegment = [[0, 0], [{wide}, 0]]\nfix = ["y"]\n'
        f'[[supports]]\nname = "roof"\nsegment = [[0, 1], [{wide}, 1]]\nfix = ["y"]\n'
        "displacement = [0, -1e-3]\n"
        '[[supports]]\nname = "wall"\nsegment = [[0, 0], [0, 1]]\nfix = ["x"]\n'
    )


@pytest.mark.parametrize("glue", ["nitsche", "lagrange"])
@pytest.mark.parametrize(("cover", "degree"), COVERS)
@pytest.mark.parametrize("ratio", [1.0, 1e3, 1e9])
def test_columns_of_any_stiffness_are_strained_alike_between_held_edges(
    ratio: float, cover: str, degree: int, glue: str
) -> None:
    # Two columns, and ten that are narrower than the two cells a multiplier otherwise takes.
    for widths in ([0.83, 1.17], [0.2] * 10):
        moduli = [ratio if number % 2 else 1.0 for number in range(len(widths))]
        text = (
            f'[cover]\ntype = "{cover}"\nsize = 0.3\ndegree = {degree}\nangle = 0.3\n'
            f'shift = [0.21, 0.37]\n[supports]\nmethod = "lagrange"\n[glue]\nmethod = "{glue}"\n'
        )
        found = run(parse_scene(columns(widths, moduli), "scene"), parse_formulation(text))
        assert found.summary.status == "converged", found.summary.sentence
        own = np.array(moduli)[found.manifold.element_region]
        # A linear field, exact on every cover; measured 1e-12.
        np.testing.assert_allclose(found.stress[:, 1] / own, -1e-3, atol=1e-13)
        energy = 0.5e-6 * np.dot(moduli, widths)
        assert found.history["strain_energy"][-1] == pytest.approx(energy, rel=1e-10)
        weight = 1e-3 * np.dot(moduli, widths)
        assert found.history["reaction:floor:y"][-1] == pytest.approx(weight, rel=1e-10)


@pytest.mark.parametrize("hard", ["left", "right"])
def test_a_held_floor_does_not_sink_under_the_softer_of_two_blocks(hard: str) -> None:
    moduli = [1e3, 1.0] if hard == "left" else [1.0, 1e3]
    scene = columns([1.0, 1.0], moduli).split('[[supports]]\nname = "roof"')[0]
    low = "[1, 1], [2, 1]" if hard == "right" else "[0, 1], [1, 1]"
    scene += (
        '[[supports]]\nname = "wall"\npoint = [0, 0]\nfix = ["x"]\n'
        f'[[loads]]\nname = "top"\nkind = "edge"\nsegment = [{low}]\ntraction = [0, -1000]\n'
    )
    text = (
        '[cover]\ntype = "triangles"\nsize = 0.3\ndegree = 1\nangle = 0.3\n'
        'shift = [0.21, 0.37]\n[supports]\nmethod = "lagrange"\n'
    )
    found = run(parse_scene(scene, "scene"), parse_formulation(text))
    place = found.manifold.elements.points
    floor = np.abs(place[:, 1]) < 1e-9
    moved = found.displacement[floor, 1] if len(found.displacement) == len(place) else None
    assert moved is not None
    # Held in the mean over two cells: the roof goes down by 1; a rigid slip would be of its size.
    assert np.abs(moved).max() < 0.06
