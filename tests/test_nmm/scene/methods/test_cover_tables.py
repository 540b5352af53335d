"""The table `[cover]`: parts of one's own, numbers among options, angles."""

import pytest

from nmm.errors import FormulationError, SceneError
from nmm.formulation import parse_formulation
from nmm.scene import parse_scene

from ..good_scene import GOOD


def test_a_part_of_ones_own_passes_with_its_options() -> None:
    text = '[cover]\ntype = "mine.covers:Hexagons"\nsize = "5 mm"\n[cover.options]\nangle = 0.3\n'
    cover = parse_formulation(text).cover
    assert (cover.type, cover.size, cover.options) == (
        "mine.covers:Hexagons",
        0.005,
        {"angle": 0.3},
    )


@pytest.mark.parametrize("number", ["9" * 500, "-" + "1" * 40])
def test_an_integer_among_options_that_no_float_holds_is_refused(number: str) -> None:
    text = f"[cover]\ntype = 'graded'\nsize = 0.3\noptions = {{ focus = [[{number}, 0.5]] }}\n"
    with pytest.raises(FormulationError, match=r"too many digits: expected a number up to 1e30"):
        parse_formulation(text)


@pytest.mark.parametrize(
    "more",
    [
        '[[joint_sets]]\nname = "j"\ndip = {angle}\nspacing = 1.0\n',
        '[[joint_sets]]\nname = "j"\ndip = 0.1\ndip_scatter = {angle}\nspacing = 1.0\n',
        '[formulation.cover]\ntype = "quads"\nsize = 1.0\nangle = {angle}\n',
    ],
)
def test_degrees_without_their_unit_are_no_angles(more):
    parse_scene(GOOD + more.format(angle='"30 deg"'))
    for angle in (30, 35.0, '"361 deg"'):
        with pytest.raises(SceneError, match="expected an angle within a whole turn.*30 deg"):
            parse_scene(GOOD + more.format(angle=angle))
