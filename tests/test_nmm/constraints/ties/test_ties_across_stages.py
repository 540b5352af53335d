"""Springs between bodies exert what they did when a stage makes them stiffer or softer."""

import numpy as np
import pytest

import nmm
from integration.arrays import Floats
from nmm.verification import text

MODULUS, HIGH, PRESSED, FACTOR = 50e6, 8.0, 1e5, 100.0
ROUNDING = 1e-12
SUB_BLOCKS = (
    '[formulation.cover]\ntype = "sub_blocks"\nsize = 1.0\nfunctions = "monomials"\n'
    'degree = {}\noptions = {{ mesh = "{}", glue = "springs", stiffness = {} }}\n'
)
GLUED = (
    "[interfaces.seam]\nfriction_angle = 0.5\nbonded = true\n"
    f'[formulation.glue]\nmethod = "spring"\nstiffness = {FACTOR}\n'
)
LOAD = '[[loads]]\nname = "top"\nkind = "edge"\nsegment = [[0, 8], [2, 8]]\ntraction = [0, -1e5]\n'


def pressed(blocks: dict[str, float], materials: str, more: str) -> nmm.Run:
    """A column of blocks, each from its height to the next one, that is pressed on its top."""
    heights = [*blocks.values(), HIGH]
    boxes = [
        text.box(name, (0, low), (2, high - low)).replace('"rock"', '"one"')
        for name, low, high in zip(blocks, heights[:-1], heights[1:], strict=True)
    ]
    base = '[[supports]]\nname = "base"\nsegment = [[0, 0], [2, 0]]\nfix = ["x", "y"]\n'
    laws = text.material("one", MODULUS, 0.0, 1000.0) + materials
    return nmm.run(
        nmm.parse_scene(text.scene('plane = "strain"\n', [laws, *boxes, base, LOAD, more]))
    )


def stages(names: str) -> str:
    return f'[[stages]]\nname = "first"\n[[stages]]\nname = "second"\nmaterials = {{ {names} }}\n'


def settled(run: nmm.Run) -> Floats:
    assert run.summary.status == "converged", run.summary.sentence
    return run.displacement


@pytest.mark.parametrize("factor", [0.5, 4.0])
@pytest.mark.parametrize(("mesh", "degree"), [("quads", 1), ("quads", 2), ("voronoi", 1)])
def test_sub_blocks_stand_still_when_their_material_changes_under_load(mesh, degree, factor):
    """Seven joints of a modulus of 100 E / 1 m closed by as much again when E was halved."""
    other = text.material("two", factor * MODULUS, 0.0, 1000.0)
    cover = SUB_BLOCKS.format(degree, mesh, FACTOR)
    before = settled(pressed({"soil": 0.0}, other, cover))
    after = settled(pressed({"soil": 0.0}, other, stages('soil = "two"') + cover))
    assert np.abs(after - before).max() < ROUNDING
    # The column's own, and that of joints.
    least = PRESSED * HIGH / MODULUS
    assert least * 1.005 < -before[:, 1].min() < least * 1.015


@pytest.mark.parametrize("factor", [0.5, 4.0])
def test_blocks_glued_by_springs_stand_still_when_their_material_changes_under_load(factor):
    other = text.material("two", factor * MODULUS, 0.0, 1000.0)
    column, both = {"low": 0.0, "high": 4.0}, 'low = "two", high = "two"'
    before = settled(pressed(column, other, GLUED))
    after = settled(pressed(column, other, stages(both) + GLUED))
    assert np.abs(after - before).max() < ROUNDING
