"""Springs of dry contact exert what they did when a stage makes them stiffer or softer."""

import numpy as np
import pytest

import nmm
from integration.arrays import Floats
from nmm.verification import text

MODULUS, PENALTY, PRESSED, BACK = 5e9, 10.0, 1e5, 0.75
WIDE, TALL, BESIDE = 2.0, 4.0, 1.0
# Of 1.2e-4 m in all; springs are closed by 2e-6 m.
ROUNDING = 1e-12
COVERS = {"blocks": 'type = "block"\n', "meshes": 'type = "quads"\nsize = 1.0\n'}
FIRST = '[[stages]]\nname = "first"\nloads = ["top"]\n'
SECOND = FIRST + '[[stages]]\nname = "second"\nmaterials = { low = "two", high = "two" }\n'
THIRD = SECOND + '[[stages]]\nname = "third"\nloads = ["top", "back"]\n'


def solved(factor: float, tables: list[str]) -> nmm.Run:
    """Run with two materials, the second ``factor`` times as stiff."""
    materials = [
        text.material(name, modulus, 0.0, 1000.0)
        for name, modulus in (("one", MODULUS), ("two", factor * MODULUS))
    ]
    head = 'plane = "stress"\n[contact]\n'
    return nmm.run(nmm.parse_scene(text.scene(head, [*materials, *tables])))


def pressed(
    factor: float, stages: str, cover: str = "blocks", shear: float = 0.0, beside: float = BESIDE
) -> nmm.Run:
    """A block on one that is wider by ``beside`` (m) on both sides; friction alone holds it."""
    top = ((0, 2 * TALL), (WIDE, 2 * TALL))
    tables = [
        text.box("low", (-beside, 0), (WIDE + 2 * beside, TALL), "one"),
        text.box("high", (0, TALL), (WIDE, TALL), "one"),
        text.interface("seam", 40.0),
        text.fixed_edge("base", ((-beside, 0), (WIDE + beside, 0))),
        text.pulled_edge("top", top, (shear, -PRESSED)),
        text.pulled_edge("back", top, (0.0, BACK * PRESSED)),
        f"[formulation.contact]\nnormal_penalty = {PENALTY}\n",
        f"[formulation.cover]\n{COVERS[cover]}",
    ]
    return solved(factor, [*tables, stages])


def on_its_tip(factor: float, stages: str) -> nmm.Run:
    """A wedge whose tip stands on a block: no joint, but a contact of a law with a stiffness."""
    top = ((0, 2 * TALL), (WIDE, 2 * TALL))
    tables = [
        text.box("low", (0, 0), (WIDE, TALL), "one"),
        text.block("high", "one", [(WIDE / 2, TALL), top[1], top[0]]),
        text.interface("seam", 40.0, more={"normal_stiffness": 1e10}),
        text.fixed_edge("base", ((0, 0), (WIDE, 0))),
        text.fixed_edge("guide", top, "x"),
        text.pulled_edge("top", top, (0.0, -PRESSED)),
        f"[formulation.cover]\n{COVERS['blocks']}",
    ]
    return solved(factor, [*tables, stages])


def settled(run: nmm.Run) -> Floats:
    assert run.summary.status == "converged", run.summary.sentence
    return run.displacement


@pytest.mark.parametrize("factor", [0.5, 4.0])
@pytest.mark.parametrize(
    ("cover", "shear", "beside"),
    [("blocks", 0.0, BESIDE), ("blocks", 1e4, BESIDE), ("blocks", 0.0, 0.0), ("meshes", 0.0, 0.0)],
)
def test_blocks_stand_still_when_their_material_changes_under_load(cover, shear, beside, factor):
    """Springs closed by 2e-6 m more when the modulus was halved, and by 1.5e-6 m less at x 4."""
    before = settled(pressed(factor, FIRST, cover, shear, beside))
    after = settled(pressed(factor, SECOND, cover, shear, beside))
    assert np.abs(after - before).max() < ROUNDING


@pytest.mark.parametrize("factor", [0.5, 4.0])
def test_a_corner_whose_law_has_a_stiffness_stands_still_too(factor):
    before, after = (settled(on_its_tip(factor, stages)) for stages in (FIRST, SECOND))
    assert np.abs(after - before).max() < ROUNDING


@pytest.mark.parametrize("factor", [0.5, 4.0])
def test_springs_of_another_stiffness_come_apart_by_it(factor):
    """All that is elastic goes with 1 / E; at half of E springs push while sides are apart."""
    before, after = (settled(pressed(factor, stages)) for stages in (FIRST, THIRD))
    assert after == pytest.approx((1 - BACK / factor) * before, abs=ROUNDING)


@pytest.mark.parametrize("factor", [0.5, 4.0])
def test_what_springs_store_more_when_they_get_softer_is_told(factor):
    """``F^2 / (4 k)`` of two corners and ``F^2 H / (2 E A)`` of both blocks, all with 1 / E."""
    force = PRESSED * WIDE
    springs = force**2 / (4 * PENALTY * MODULUS)
    blocks = sum(force**2 * TALL / (2 * MODULUS * wide) for wide in (WIDE, WIDE + 2 * BESIDE))
    run = pressed(factor, SECOND)
    # The support is 1e4 times as stiff as a block: 1.1e-4 of all. Springs are 1.6e-2.
    expected = (1 / factor - 1) * (springs + blocks)
    assert run.history["change_energy"][-1] == pytest.approx(expected, rel=2e-4)
    assert abs(run.summary.energy_balance) < 1e-9
