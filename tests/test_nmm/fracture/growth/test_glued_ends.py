"""Cracks that end where their body is glued to another: nothing comes free there."""

import pytest

import nmm
from nmm.formulation import parse_formulation
from nmm.scene.read import parse_scene
from nmm.testing.cracked_plates import HALVES_APART, PULLED_APART, turned_net

# Two squares, one glued on the other, pulled upwards; the crack runs towards the seam.
HALVES = """
title = "glued halves"
plane = "strain"
"""
HALVES += (
    HALVES_APART
    + """
[interfaces.seam]
between = ["left", "right"]
bonded = true
friction_angle = 0.5
cohesion = 1e9
tensile_strength = 1e9
[[cracks]]
name = "notch"
points = [[0, 0], [0.7, 0]]
[[supports]]
name = "pin"
point = [2, -1]
fix = ["x", "y"]
[[supports]]
name = "roller"
point = [2, 1]
fix = ["x"]
[fracture]
toughness = 1e6
increment = 0.1
control = "toughness"
"""
)
HALVES += PULLED_APART
OTHER = """
[[cracks]]
name = "far"
points = [[2, 0.6], [1.7, 0.6]]
[[supports]]
name = "pin"
"""


def test_a_crack_that_ends_on_glue_frees_no_piece_and_what_its_last_piece_takes() -> None:
    run = nmm.run(parse_scene(HALVES), parse_formulation(turned_net(0.1)))
    assert "every crack has come to an end" in run.summary.sentence
    assert run.history["fracture:notch:end:x"][-1] == pytest.approx(0.9)
    # It was at its toughness as long as it had a tip, which frees what is taken.
    assert run.summary.audits["growth_energy"] == pytest.approx(0.0, abs=1e-3)


def test_another_crack_grows_on_where_the_first_has_ended_on_glue() -> None:
    scene = HALVES.replace('[[supports]]\nname = "pin"\n', OTHER.lstrip("\n"))
    scene = scene.replace("increment = 0.1", "increment = 0.1\nmax_growth = 0.35")
    run = nmm.run(parse_scene(scene), parse_formulation(turned_net(0.1)))
    assert "no crack grows further" in run.summary.sentence
    assert run.history["fracture:far:end:growth"][-1] > 0.3
