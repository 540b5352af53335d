"""Keys of a formulation that the part it names has no use of are refused by line."""

import pytest

from nmm.errors import NmmError
from nmm.formulation import parse_formulation
from nmm.model.parts import check_parts
from nmm.scene import parse_scene

SCENE = parse_scene(
    """plane = "strain"
[materials.m]
young_modulus = 1e9
poisson_ratio = 0.2
[[blocks]]
name = "b"
material = "m"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[supports]]
name = "s"
block = "b"
fix = ["x", "y"]
"""
)


@pytest.mark.parametrize(
    ("table", "key"),
    [
        ('[supports]\nmethod = "lagrange"\ngamma = 3.0', "supports.gamma: 3"),
        ('[supports]\nmethod = "penalty"\nghost = 0.1', "supports.ghost: 0.1"),
        ('[glue]\nmethod = "lagrange"\nstiffness = 3', "glue.stiffness: 3"),
        ('[glue]\nmethod = "nitsche"\nstiffness = 3', "glue.stiffness: 3"),
        ('[glue]\nmethod = "spring"\ngamma = 3', "glue.gamma: 3"),
        ('[contact]\nenforcement = "cone"\nmax_passes = 3', "contact.max_passes: 3"),
        ('[cover]\ntype = "block"\nsize = 3', "cover.size: 3"),
    ],
)
def test_a_key_that_its_part_has_no_use_of_is_refused_by_line(table, key):
    with pytest.raises(NmmError, match=f"file:3: {key}.*no such key"):
        check_parts(SCENE, parse_formulation(table, "file"))


@pytest.mark.parametrize(
    "table",
    [
        # Points are held by springs whatever holds edges.
        '[supports]\nmethod = "lagrange"\nstiffness = 3.0',
        '[supports]\nmethod = "nitsche"\nghost = 0.1\ngamma = 30.0',
        "[supports]\ngamma = 30.0",  # "auto" may be Nitsche's method
        # Files of a run name all keys, with what they are by default.
        '[supports]\nmethod = "penalty"\nghost = 0.5',
        '[contact]\nmax_passes = 20\nenforcement = "cone"',
    ],
)
def test_keys_that_some_part_reads_or_that_say_nothing_are_taken(table):
    check_parts(SCENE, parse_formulation(table, "file"))
