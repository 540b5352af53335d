"""A limit point is foretold from one equilibrium near it, and from none far away."""

import re

import pytest

import nmm
from nmm.stepping.drive.equilibrium.vanishing_stiffness import vanishing_stiffness
from nmm.verification.problems.finite.truss import LIMIT, SnappedTruss


def below(load):
    """Run of the truss under a given load."""
    text = SnappedTruss().scene()
    text = text.replace("[0, -0.5]", f"[0, {-load / 2!r}]")
    start, end = text.index("[loading]"), text.index("[formulation.rotation]")
    return nmm.run(nmm.parse_scene(text[:start] + text[end:]))


@pytest.mark.parametrize("share", [0.99, 0.999, 0.9999])
def test_the_load_of_a_limit_point_is_foretold_from_below(share):
    found = below(share * LIMIT)
    # Of the loads here the factor counts: 1 is the share.
    said = vanishing_stiffness(found.stepper, found.state, 1.02)
    limit = float(re.search(r"load factor ([\d.]+)", said)[1])
    # The square of the stiffness is straight but for its next term, the root of the way left.
    assert limit * share == pytest.approx(1, abs=0.2 * (1 - share) + 3e-5)


def test_far_below_a_limit_a_failure_is_the_solvers():
    found = below(0.5 * LIMIT)
    assert vanishing_stiffness(found.stepper, found.state, 1.02) is None


def test_a_structure_that_bends_linearly_has_no_limit():
    scene = nmm.parse_scene(
        SnappedTruss()
        .scene()
        .replace('update = "finite"', 'update = "small"')
        .replace('[loading]\nuntil = "failure"\n', "")
    )
    found = nmm.run(scene)
    assert vanishing_stiffness(found.stepper, found.state, 2.0) is None


ARCH = """
plane = "stress"
[materials.m]
young_modulus = 1e9
poisson_ratio = 0.3
[[blocks]]
name = "arch"
material = "m"
vertices = [[-1, 0], [0, 0.12], [1, 0], [1, 0.02], [0, 0.14], [-1, 0.02]]
[[supports]]
name = "left"
segment = [[-1, 0], [-1, 0.02]]
fix = ["x", "y"]
[[supports]]
name = "right"
segment = [[1, 0], [1, 0.02]]
fix = ["x", "y"]
[[loads]]
name = "weight"
kind = "body"
density = [1e3, -1e5]
[loading]
until = "failure"
[formulation.cover]
type = "quads"
size = 0.1
degree = 1
[formulation.rotation]
update = "finite"
[formulation.loading]
increment = 0.5
tolerance = 1e-2
"""


def test_functions_that_depend_on_one_another_hide_no_limit_point():
    found = nmm.run(nmm.parse_scene(ARCH)).summary
    assert found.status == "failure_load"
    assert "vanishes at load factor" in found.sentence
