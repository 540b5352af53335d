"""What the static theorem may say of blocks that members hold."""

import pytest

import nmm
from nmm.formulation import Formulation
from nmm.stepping.bounds.static_theorem import load_bound
from nmm.stepping.prepare import prepare

SLIDING = """
plane = "stress"
[materials.rock]
young_modulus = "10 GPa"
poisson_ratio = 0.0
density = 1000
[interfaces.joint]
friction_angle = "30 deg"
[[blocks]]
name = "base"
material = "rock"
vertices = [[-3, -1], [5, -1], [5, 0], [-3, 0]]
[[blocks]]
name = "block"
material = "rock"
vertices = [[0, 0], [2, 0], [2, 1], [0, 1]]
[[supports]]
name = "base"
block = "base"
fix = ["x", "y"]
[[loads]]
name = "push"
kind = "point"
point = [0, 0.5]
block = "block"
force = ["1 kN", 0]
[gravity]
[contact]
[loading]
until = "failure"
"""
TIE = """
[[springs]]
name = "tie"
points = [[0, 0.5], [-2, 0.5]]
blocks = ["block", "ground"]
stiffness = "10 MN/m"
"""


@pytest.mark.parametrize("member", ["", TIE, TIE + 'yield_force = "1 kN"\n'])
def test_a_bound_is_told_where_friction_alone_holds(member):
    made = prepare(nmm.parse_scene(SLIDING + member), Formulation())
    found = load_bound(made.stepper, made.start)
    if "yield_force" in member:  # 1 kN more than friction, which the programme does not know
        assert found is None
    elif not member:
        friction = 2 * 1000 * 9.81 * 0.5773502691896257
        assert found.factor == pytest.approx(friction / 1e3, rel=1e-6)
    else:
        assert found is None or not found.motion.any()
