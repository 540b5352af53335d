"""Cracks that are pressed shut where no contact holds their faces apart: told, with how deep."""

import re

import pytest

import nmm

HALF, A, LOAD, MODULUS = 1.0, 0.2, 1e6, 1e10
PLATE = """
plane = "stress"
[materials.m]
young_modulus = {modulus}
poisson_ratio = 0.2
[[blocks]]
name = "b"
material = "m"
vertices = [[-1, -1], [1, -1], [1, 1], [-1, 1]]
[[cracks]]
name = "c"
points = {crack}
{more}
[[loads]]
name = "top"
kind = "edge"
segment = [[-1, 1], [1, 1]]
traction = [0, {pull}]
[[loads]]
name = "bottom"
kind = "edge"
segment = [[-1, -1], [1, -1]]
traction = [0, {push}]
[[supports]]
name = "p"
point = [-1, -1]
fix = ["x", "y"]
[[supports]]
name = "q"
point = [1, -1]
fix = ["y"]
[formulation.cover]
type = "quads"
size = 0.11
degree = 1
angle = 0.2
"""
FLAT, INCLINED = [[-A, 0.0], [A, 0.0]], [[-A, -A], [A, A]]
GROWTH = "[fracture]\ntoughness = 1e3\nincrement = 0.05\nmax_growth = 0.1\nradius = 0.25\n"


def told(crack, pull, more=""):
    text = PLATE.format(modulus=MODULUS, crack=crack, pull=pull, push=-pull, more=more)
    summary = nmm.run(nmm.parse_scene(text)).summary
    return [one for one in summary.warnings if "faces_overlap" in one]


def test_faces_that_lie_in_each_other_are_told_with_how_deep():
    (words,) = told(FLAT, -LOAD)
    deep = float(re.search(r"by up to (\S+) m", words)[1])
    # 4 sigma a / E in an infinite plate; that one is ten half lengths wide, and few cells long.
    assert deep == pytest.approx(4 * LOAD * A / MODULUS, rel=0.05)
    assert "add [contact]" in words


@pytest.mark.parametrize(("crack", "pull"), [(FLAT, LOAD), (INCLINED, LOAD)])
def test_cracks_that_open_have_nothing_to_say(crack, pull):
    assert told(crack, pull) == []


def test_a_tip_that_grows_while_it_is_pressed_shut_is_told():
    words = told(INCLINED, -LOAD, GROWTH)
    # K_I = -K_II of a crack at 45 degrees: -K_I is 1 / sqrt(2) of both together.
    (share,) = [re.search(r"K_I was -(\S+) %", one)[1] for one in words if "K_I" in one]
    assert float(share) == pytest.approx(100 / 2**0.5, rel=0.05)
