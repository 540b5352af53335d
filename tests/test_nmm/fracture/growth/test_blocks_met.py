"""Cracks that come to another block end there, whatever holds the two together."""

import numpy as np
import pytest

import nmm
from nmm.formulation import parse_formulation
from nmm.scene.read import parse_scene
from nmm.testing.cracked_plates import HALVES_APART, turned_net

# The left square is torn by what holds it above and below; the right one stands beside it.
HALVES = """
plane = "strain"
"""
HALVES += (
    HALVES_APART
    + """
[interfaces.faces]
between = ["left", "left"]
friction_angle = 0.5
[interfaces.seam]
between = ["left", "right"]
friction_angle = 0.5
HELD
[[cracks]]
name = "notch"
points = [[0, 0], [0.73, 0]]
[[supports]]
name = "up"
segment = [[0, 1], [1, 1]]
fix = ["x", "y"]
displacement = [0, 4e-3]
[[supports]]
name = "down"
segment = [[0, -1], [1, -1]]
fix = ["x", "y"]
[[supports]]
name = "beside"
segment = [[2, -1], [2, 1]]
fix = ["x", "y"]
[fracture]
criterion = "straight_ahead"
toughness = 1e6
increment = 0.1
"""
)
BOND = "bonded = true\ncohesion = {0}\ntensile_strength = {0}\n"
WAYS = {
    "glued": BOND.format(1e9),
    "touching": "[contact]\n",
    "bonded": BOND.format(2e7) + "[contact]\n",
    # Breaks at once all along as the crack meets it: friction was not brought to its balance.
    "weak": BOND.format(1e5) + "[contact]\n",
}


SLOW = {"weak": pytest.mark.slow}  # 10 s


@pytest.mark.parametrize(
    "held", [pytest.param(WAYS[one], id=one, marks=SLOW.get(one, ())) for one in WAYS]
)
def test_a_crack_ends_where_its_block_meets_another(held: str) -> None:
    run = nmm.run(parse_scene(HALVES.replace("HELD", held)), parse_formulation(turned_net(0.15)))
    assert run.summary.status == "converged"
    # The second piece would end 0.07 short of the seam, less than a quarter of a piece beyond it.
    assert run.history["fracture:notch:end:x"][-1] == pytest.approx(1.0, abs=1e-9)
    assert len(run.stepper.model.cut.tips) == 0
    told = [one for one in run.summary.changes if "where its block meets" in one]
    assert len(told) == 1
    assert "notch:end ends where its block meets right" in told[0]
    # It is the left block alone that is parted, into its halves.
    area = np.bincount(run.manifold.element_body, run.manifold.elements.areas)
    assert sorted(area) == pytest.approx([1.0, 1.0, 2.0], abs=1e-9)
