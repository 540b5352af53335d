"""Forces that follow bodies through a step: tangents are their slopes, by finite differences."""

import pytest

import nmm
from nmm.effects.base import defines
from nmm.stepping.prepare import prepare
from nmm.testing import check_effect

BODY = """
title = "two blocks"
plane = "strain"
{time}
[materials.m]
young_modulus = 1e6
poisson_ratio = 0.3
density = 2000.0
hydraulic_conductivity = 1e-6
conductivity = 2.0
heat_capacity = 800.0
thermal_expansion = 1e-5
{law}
[interfaces.seam]
friction_angle = 0.5
bonded = true
{seam}
[[blocks]]
name = "left"
material = "m"
vertices = [[0.0, 0.0], [1.2, 0.1], [1.0, 1.0], [0.0, 0.9]]
[[blocks]]
name = "right"
material = "m"
vertices = [[1.2, 0.1], [2.1, 0.2], [2.0, 1.1], [1.0, 1.0]]
[[supports]]
name = "pin"
{pin}
fix = ["x", "y"]
"""
LOADED = """
[[initial_stresses]]
block = "all"
stress = [-2e3, -3e3, 5e2]
[[loads]]
name = "gas"
kind = "pressure"
block = "right"
pressure = 1e4
[[water_pressures]]
name = "pool"
block = "left"
level = 1.5
[heat]
[[temperatures]]
name = "warm"
segment = [[0, 0], [0, 0.9]]
temperature = 30.0
[[temperatures]]
name = "cold"
segment = [[2.1, 0.2], [2.0, 1.1]]
temperature = 10.0
[seepage]
[[heads]]
name = "reservoir"
segment = [[0, 0], [0, 0.9]]
head = 3.0
[[heads]]
name = "drain"
segment = [[2.1, 0.2], [2.0, 1.1]]
head = 1.0
[formulation.rotation]
update = "finite"
[formulation.cover]
type = "triangles"
size = 0.6
"""
MOVING = """
[inertia]
[[springs]]
name = "spring"
points = [[0.1, 0.1], [2.0, 1.0]]
blocks = ["left", "right"]
stiffness = 1e4
[[dashpots]]
name = "damper"
points = [[0.1, 0.8], [2.0, 0.3]]
blocks = ["left", "right"]
viscosity = 1e3
"""
EDGE, POINT = "segment = [[0.0, 0.0], [0.0, 0.9]]", 'block = "left"\npoint = [0.5, 0.5]'
STIFF = "normal_stiffness = 1e7\nshear_stiffness = 4e6"
BENDING = BODY.format(time="", law='law = "neo_hookean"', seam="", pin=EDGE) + LOADED
TURNING = {
    seam: BODY.format(time="duration = 0.1", law="", seam=one, pin=POINT) + MOVING
    for seam, one in {"joints": STIFF, "glue": ""}.items()
}


def tangents(text: str) -> set[str]:
    """Hold effects whose force a step is solved for to their tangents; return their names."""
    scene = nmm.parse_scene(text)
    made = prepare(scene, scene.formulation or nmm.Formulation())
    stepper, found = made.stepper, set()
    for name, effect in stepper.plan.effects.items():
        if defines(effect, "step_force") and effect.nonlinear:
            check_effect(effect, stepper.model, made.start, kinematics=stepper.kinematics)
            found.add(name)
    return found


def test_forces_in_finite_strain_have_the_tangents_of_their_slopes():
    fields = {"heat", "seepage", "initial stress"}
    assert tangents(BENDING) == {"pressures", "water pressures", *fields}


@pytest.mark.parametrize("seam", TURNING)
def test_forces_of_ties_and_members_have_the_tangents_of_their_slopes(seam):
    assert tangents(TURNING[seam]) == {"supports", "bonded interfaces", "springs", "dashpots"}
