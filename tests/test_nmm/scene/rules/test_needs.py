"""What effects need of a scene."""

import pytest

from nmm.scene import Scene, parse_scene
from nmm.scene.actions import GravityTable
from nmm.scene.matter.materials import Material
from nmm.scene.solids import Block

from ..good_scene import GOOD, fault_of, faults_of


def test_effects_that_lack_what_they_need_are_refused() -> None:
    text = GOOD.replace("[contact]", "[inertia]\n[contact]").replace("[interfaces.crack]", "[x]")
    report = "\n".join(faults_of(text))
    assert "duration missing" in report
    assert "density missing" in report
    assert "at least one interface" in report
    assert "a static scene" in report  # [loading] in a dynamic scene


def test_motion_after_failure_needs_densities() -> None:
    assert "density missing" in fault_of(GOOD + 'motion_after_failure = "5 ms"\n')


def test_a_scene_built_in_python_is_checked_like_a_file() -> None:
    rock = Material(young_modulus=1e9, poisson_ratio=0.2)
    block = Block(material="rock", vertices=((0, 0), (1, 0), (0, 1)))
    scene = Scene(plane="strain", materials={"rock": rock}, blocks=(block,), gravity=None)
    assert scene.blocks[0].vertices[1] == (1.0, 0.0)
    with pytest.raises(ValueError, match="a density in kg/m3"):
        Scene(plane="strain", materials={"rock": rock}, blocks=(block,), gravity=GravityTable())


def test_an_opening_between_a_point_and_itself_is_refused() -> None:
    monitor = '[[monitors]]\nname = "lip"\npoint = [0.2, 0.1]\n'
    control = '[loading.control]\ntype = "opening"\nincrement = "1 um"\n'
    line = fault_of(GOOD + control + 'monitors = ["lip", "lip"]\n' + monitor)
    assert 'loading.control: "lip" twice: expected monitors of two points' in line


def test_openings_are_asked_of_cracks_or_bonds() -> None:
    asked = '[output]\nquantities = ["crack_opening"]\n'
    plain = (
        GOOD.replace("bonded = true", "")
        .replace("tensile_strength", "# ")
        .replace("cohesion", "# ")
    )
    assert '"crack_opening" without cracks or bonds' in "\n".join(faults_of(plain + asked))
    crack = '[[cracks]]\nname = "c"\npoints = [[0.1, 0.1], [0.2, 0.1]]\n'
    for opens in (GOOD + asked, plain + asked + crack):
        assert parse_scene(opens).output is not None
