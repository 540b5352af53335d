"""Matter that yields all along a mechanism has passed its limit load: no support is missing."""

import pytest

import nmm
from nmm.scene.read import parse_scene
from nmm.verification import text

YIELD, NET = 250e6, '[formulation.cover]\ntype = "triangles"\nsize = 0.1\n'
TOUCHES = '[contact]\n[interfaces.face]\nfriction_angle = "30 deg"\n'


def pulled(head: str, *tables: str, held: str = 'fix = ["x"]') -> "nmm.Run":
    """A bar of perfectly plastic steel is pulled by up to 400 MPa."""
    given = [
        '[materials.steel]\nyoung_modulus = 2e11\npoisson_ratio = 0.3\nlaw = "von_mises"\n'
        f"yield_stress = {YIELD}\n",
        text.block("bar", "steel", text.rectangle((0, 0), (1, 0.2))),
        f'[[supports]]\nname = "left"\nsegment = [[0, 0], [0, 0.2]]\n{held}\n',
        '[[supports]]\nname = "foot"\npoint = [0, 0]\nfix = ["y"]\n',
        '[[loads]]\nname = "pull"\nkind = "edge"\nsegment = [[1, 0], [1, 0.2]]\n'
        "traction = [1e6, 0]\n",
        '[loading]\nuntil = "failure"\nmaximum_factor = 400\n'
        "[formulation.loading]\nincrement = 50\n",
    ]
    return nmm.run(parse_scene(text.scene(f'plane = "stress"\n{head}', [*given, *tables])))


@pytest.mark.parametrize("net", ["", NET], ids=["block", "triangles"])
@pytest.mark.parametrize("head", ["", TOUCHES], ids=["alone", "contact"])
def test_a_bar_that_yields_all_along_has_passed_its_limit_load(head, net):
    """It asked for supports, and beside ``[contact]`` said that the solver gave up."""
    summary = pulled(head, net).summary
    assert summary.status == "failure_load"
    # Load steps end within 1 % of each other, the default tolerance.
    assert summary.failure_factor == pytest.approx(YIELD / 1e6, rel=0.01)
    assert "its limit load is passed" in summary.sentence
    assert "add supports" not in summary.sentence


def test_a_bar_of_matter_that_may_yield_and_that_nothing_holds_asks_for_supports():
    summary = pulled("", held='fix = ["y"]').summary
    assert summary.status == "collapsed"
    assert "add supports" in summary.sentence
