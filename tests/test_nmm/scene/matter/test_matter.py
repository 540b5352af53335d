"""Materials, and interfaces between pairs of them."""

import pytest

from nmm.errors import SceneError
from nmm.scene import parse_scene

from ..good_scene import GOOD, fault_of


def test_incompressible_material_is_refused_in_plane_strain_only() -> None:
    text = GOOD.replace("= 0.2\n[", "= 0.5\n[")
    assert parse_scene(text).materials["concrete"].poisson_ratio == 0.5
    assert "0.4999" in fault_of(text.replace('"stress"', '"strain"'))


def test_two_interfaces_for_one_pair_are_refused() -> None:
    text = GOOD.replace("[[blocks]]", "[interfaces.other]\nfriction_angle = 0.1\n[[blocks]]")
    assert "a pair of its own" in fault_of(text)


def test_the_interface_of_a_pair_goes_before_the_general_one() -> None:
    text = GOOD.replace(
        "[[blocks]]",
        "[materials.steel]\nyoung_modulus = 2e11\npoisson_ratio = 0.3\n[interfaces.bond]\n"
        'between = ["steel", "concrete"]\nfriction_angle = 0.1\n[[blocks]]',
    )
    scene = parse_scene(text, "s.toml")
    assert scene.interface("concrete", "steel").friction_angle == 0.1
    assert scene.interface("steel", "steel").cohesion == 4.7e6
    only = parse_scene(text.replace("bonded", 'between = ["steel", "steel"]\nbonded'), "s.toml")
    with pytest.raises(SceneError, match=r'between = \["concrete", "concrete"\]'):
        only.interface("concrete", "concrete")
