"""Tables of members: what is read, and what is refused by line."""

import pytest

import nmm
from nmm.errors import NmmError
from nmm.formulation import Formulation
from nmm.stepping.prepare import prepare

SCENE = """plane = "strain"
[materials.rock]
young_modulus = "30 GPa"
poisson_ratio = 0.2
[[blocks]]
name = "rock"
material = "rock"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
"""
SPRING = '[[springs]]\nname = "s"\npoints = [[0, 0], [1, 0]]\nstiffness = "1 MN/m"\n'
BAR = '[[bars]]\nname = "b"\npoints = [[0, 0], [1, 1]]\nyoung_modulus = "200 GPa"\n'


@pytest.mark.parametrize(
    ("text", "line", "said"),
    [
        (SPRING.replace("1 MN/m", "-1 MN/m"), 12, "force over elongation in N/m, > 0"),
        (SPRING.replace("1 MN/m", "1 MN"), 12, "converts to N/m"),
        (SPRING.replace("[1, 0]]", "[0, 0]]"), 9, "two points apart"),
        (SPRING + SPRING, 14, "a name of its own"),
        (SPRING + 'blocks = ["rok", "ground"]', 13, 'did you mean "rock"'),
        (SPRING + 'blocks = ["ground", "ground"]', 9, "one end on a block"),
        (BAR, 9, "diameter or area"),
        (BAR + 'area = "490 mm^2"\nbond = { stiffness = 1e9 }', 9, "a perimeter"),
        (BAR + 'diameter = "25 mm"\nends = ["free", "fixed"]', 9, "a bar that is anchored"),
        (BAR + 'diameter = "25 mm"\nhardening_modulus = 1e9', 9, "a stress that it begins at"),
        (
            BAR + 'area = "2 mm^2"\nyield_stress = "5 MPa"\npretension = 10.1',
            9,
            "at most the force that it yields at, 10 N",
        ),
        (BAR + 'diameter = "25 mm"\nends = ["fre", "fixed"]', 14, 'expected "free", "fixed" or'),
        (
            '[[dashpots]]\nname = "d"\npoints = [[0, 0], [1, 0]]\nviscosity = 1',
            9,
            "a dynamic scene",
        ),
        ('[[masses]]\nname = "m"\npoint = [0, 0]\nmass = "2 t"', 9, "what acts on a mass"),
    ],
)
def test_a_table_that_is_wrong_is_told_by_line(text, line, said):
    with pytest.raises(NmmError) as caught:
        nmm.parse_scene(SCENE + text)
    told = str(caught.value)
    assert f"scene:{line}:" in told, told
    assert said in told


@pytest.mark.parametrize(
    "text",
    [
        SPRING.replace("[1, 0]]", "[3, 0]]"),
        BAR.replace("[1, 1]]", "[3, 0]]") + 'diameter = "25 mm"\n',
        '[[foundations]]\nname = "f"\nsegment = [[0, -1], [1, -1]]\nnormal_stiffness = 1e6\n',
        '[gravity]\n[[masses]]\nname = "m"\npoint = [0, 2]\nmass = "2 t"\n',
    ],
)
def test_an_end_on_no_block_is_told_by_line_and_name(text):
    scene = SCENE.replace("poisson", "density = 2000\npoisson") + text
    with pytest.raises(NmmError) as caught:
        prepare(nmm.parse_scene(scene), Formulation())
    told = str(caught.value)
    assert told.startswith("scene:1")
    assert "no block at [" in told
    assert "an end on a block" in told


def test_a_bond_that_lacks_a_constant_is_told():
    text = BAR + 'diameter = "25 mm"\n[bars.bond]\nlaw = "bilinear"\nstrength = "8 MPa"\n'
    with pytest.raises(NmmError, match="scene:9: bars.0.bond: .*expected strength, 2 slips"):
        prepare(nmm.parse_scene(SCENE + text), Formulation())


def test_a_scene_without_members_keeps_its_hash():
    from nmm.scene.read import canonical_text

    text = canonical_text(nmm.parse_scene(SCENE))
    assert "springs" not in text
    assert "bars" not in text
