"""The tables `[fracture]` and `[fracture.nucleation]`: what says nothing sound is refused."""

import pytest

from nmm.errors import NmmError
from nmm.scene.read import parse_scene
from nmm.testing.cracked_plates import notched_plate

BEGINS = "toughness = 1.0\nincrement = 0.1\n[fracture.nucleation]\n"


@pytest.mark.parametrize(
    ("fracture", "said"),
    [
        ("toughness = -1.0\nincrement = 0.1", "toughness"),
        ("energy = 0.0\nincrement = 0.1", "energy"),
        ("toughness = 1.0\nenergy = 1.0\nincrement = 0.1", "toughness or energy"),
        ("increment = 0.1", "toughness or energy"),
        ("toughness = 1.0\nincrement = 0.0", "increment"),
        ("toughness = 1.0", "increment"),
    ],
)
def test_growth_that_says_nothing_sound_is_refused(fracture: str, said: str) -> None:
    with pytest.raises(NmmError, match=said):
        parse_scene(notched_plate(fracture))


@pytest.mark.parametrize(
    ("nucleation", "said"),
    [
        ("tensile_strength = -1.0", "tensile_strength"),
        ("tensile_strength = 0.0", "tensile_strength"),
        ("length = 0.1", "tensile_strength"),
        ("tensile_strength = 3.0\nlength = 0.0", "length"),
        ("tensile_strength = 3.0\ncrack_length = -1.0", "crack_length"),
        ("tensile_strength = 3.0\nnumber = 0", "number"),
        ("tensile_strength = 3.0\nstrength = 2.0", "strength"),
    ],
)
def test_nucleation_that_says_nothing_sound_is_refused(nucleation: str, said: str) -> None:
    with pytest.raises(NmmError, match=said):
        parse_scene(notched_plate(BEGINS + nucleation))
