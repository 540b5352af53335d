"""Joints between blocks whose fields bend: no jump along them is free."""

import numpy as np
import pytest

from nmm.formulation import parse_formulation
from nmm.scene.read import parse_scene
from nmm.stepping.prepare import prepare

JOINED = """
plane = "stress"
[materials.m]
young_modulus = "1 GPa"
poisson_ratio = 0.2
[interfaces.i]
friction_angle = 0.5
bonded = true
cohesion = "1 GPa"
tensile_strength = "1 GPa"
normal_stiffness = "1 GPa/m"
shear_stiffness = "1 GPa/m"
[[blocks]]
name = "low"
material = "m"
vertices = [[0, -1], [2, -1], [2, 0], [0, 0]]
[[blocks]]
name = "high"
material = "m"
vertices = [[0, 0], [2, 0], [2, 1], [0, 1]]
[[supports]]
name = "foot"
segment = [[0, -1], [2, -1]]
fix = ["x", "y"]
[contact]
"""


@pytest.mark.parametrize("degree", [1, 2, 3])
def test_a_joint_feels_every_jump_that_blocks_of_a_degree_can_make(degree: int) -> None:
    cover = f'[cover]\ntype = "block"\nfunctions = "monomials"\ndegree = {degree}\n'
    rule = '[contact]\njoint_points = "gauss"\n'
    made = prepare(parse_scene(JOINED), parse_formulation(cover + rule))
    contact, start = made.stepper.plan.contact, made.start
    points = contact.candidates(start, 0.01).take(np.arange(degree + 1))
    assert points.is_joint.all()
    assert points.length.sum() == pytest.approx(2.0, rel=1e-14)
    # A polynomial of the degree along the joint vanishes at all points only where it vanishes.
    rows = contact.geometry.rows(points, start).normal.toarray()
    assert np.linalg.matrix_rank(rows, tol=1e-9) == degree + 1
