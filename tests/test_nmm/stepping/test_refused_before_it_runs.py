"""What a run would refuse in its midst is refused as it is prepared, so that a check tells it."""

from dataclasses import replace

import numpy as np
import pytest

from nmm.errors import NmmError
from nmm.interfaces.mohr_coulomb import MohrCoulomb
from nmm.materials.elastic import Elastic
from nmm.scene import parse_scene
from nmm.stepping.prepare import prepare

BEAM = """
plane = "strain"
[materials.m]
young_modulus = 1e9
poisson_ratio = 0.2
density = 2000.0
[[blocks]]
name = "b"
material = "m"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[blocks]]
name = "c"
material = "m"
vertices = [[0, 1], [1, 1], [1, 2], [0, 2]]
[[supports]]
name = "s"
segment = [[0, 0], [1, 0]]
fix = ["x", "y"]
[[monitors]]
name = "o"
point = [0.5, 1.5]
[[loads]]
name = "l"
kind = "edge"
segment = [[0, 2], [1, 2]]
traction = [0, 1e4]
[contact]
[interfaces.i]
friction_angle = 0.5
tensile_strength = 1e5
cohesion = 1e5
bonded = true
"""
EVENTS = """[loading]
until = "failure"
[loading.control]
type = "events"
"""
SPLITS = """[splitting.m]
tensile_strength = 1e6
cohesion = 1e6
friction_angle = 0.6
smallest_block = 0.1
"""
SOFTENS = """law = "exponential_softening"
fracture_energy = 1.0
normal_stiffness = 5e9
"""


def refusal(text: str) -> str:
    scene = parse_scene(text)
    assert scene.formulation is not None
    with pytest.raises(NmmError) as fault:
        prepare(scene, scene.formulation)
    return str(fault.value)


@pytest.mark.parametrize("part", ['enforcement = "cone"', 'enforcement = "lagrange"'])
def test_what_hinders_a_path(part):
    told = refusal(f"{BEAM}{EVENTS}[formulation.contact]\n{part}\n")
    assert told.startswith("scene:35: loading.control: [loading.control] ")
    assert "expected springs" in told


def test_blocks_that_split_beside_a_path_are_told_with_the_line_of_the_control():
    text = f"{BEAM}{SPLITS}{EVENTS}[formulation]\n"
    line = text.splitlines().index("[loading.control]") + 1
    assert refusal(text).startswith(f"scene:{line}: loading.control: splitting: expected blocks")


def test_a_spring_of_a_bond_that_is_too_soft_for_its_energy():
    """Strength squared over energy is 1e10 Pa/m: a softer spring's force falls at a standstill.

    The curve is one of straight pieces, whose steepest falls a little less.
    """
    told = refusal(f"{BEAM}{SOFTENS}[formulation.contact]\n")
    assert told.startswith("scene:28: interfaces.i: [interfaces.i] ")
    assert "expected above 9.6" in told


def test_cells_too_large_for_what_softens_name_the_material():
    """Modulus, energy and strength ask for cells of 33 micrometres: those here are 1 m."""
    soil = 'density = 2000.0\nlaw = "mohr_coulomb"\ncohesion = 1e5\nfriction_angle = 0.5\n'
    soft = BEAM.replace("density = 2000.0\n", f"{soil}softening_energy = 1e-3\n")
    told = refusal(f"{soft}[formulation]\n")
    assert told.startswith("scene:3: materials.m: [materials.m] softening_energy: 0.001: cells")


def one_sided(stiffness):
    return stiffness * [[1, 2, 1], [1, 1, 1], [1, 1, 1]]


@pytest.mark.parametrize(
    "change", [np.negative, one_sided, lambda one: one * np.nan, lambda one: one[:2]]
)
def test_a_stiffness_that_stores_no_energy(change, monkeypatch):
    plain = Elastic.stiffness
    monkeypatch.setattr(Elastic, "stiffness", lambda law, plane: change(plain(law, plane)))
    told = refusal(BEAM + "[formulation]\n")
    assert told.startswith("scene:3: materials.m: stiffness")
    assert "a symmetric matrix (3, 3) under which no strain gives energy" in told


@pytest.mark.parametrize("change", [np.negative, lambda one: one * np.nan, lambda one: one[:1]])
def test_limits_of_an_interface_that_no_contact_can_have(change, monkeypatch):
    plain = MohrCoulomb.response

    def changed(law, history, stiffness):
        found = plain(law, history, stiffness)
        limits = replace(found.limits, friction=change(found.limits.friction))
        return replace(found, limits=limits)

    monkeypatch.setattr(MohrCoulomb, "response", changed)
    told = refusal(BEAM + "[formulation]\n")
    assert "interfaces.i: law MohrCoulomb: friction of a bond and of a contact" in told
