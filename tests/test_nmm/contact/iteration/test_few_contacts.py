"""Contacts that are few beside the unknowns, as those of a crack in a body."""

import math

import pytest

import nmm
from nmm.scene.read import parse_scene

HALF, LOAD, ANGLE, YOUNG, POISSON = 0.1 * math.sqrt(2), 1e6, 0.29, 1e10, 0.2
PLATE = f"""
plane = "strain"
materials.rock = {{ young_modulus = {YOUNG}, poisson_ratio = {POISSON} }}
interfaces.any = {{ friction_angle = {ANGLE} }}
blocks = [{{ name = "plate", material = "rock", vertices = [[-1, -1], [1, -1], [1, 1], [-1, 1]] }}]
cracks = [{{ name = "flaw", points = [[-0.1, -0.1], [0.1, 0.1]] }}]
loads = [
    {{ name = "top", kind = "edge", segment = [[-1, 1], [1, 1]], traction = [0, -{LOAD}] }},
    {{ name = "bottom", kind = "edge", segment = [[-1, -1], [1, -1]], traction = [0, {LOAD}] }},
]
supports = [
    {{ name = "pin", point = [-1, -1], fix = ["x", "y"] }},
    {{ name = "roller", point = [1, -1], fix = ["y"] }},
]
contact = {{}}
formulation.cover = {{ type = "triangles", size = 0.05, degree = 1 }}
"""


def test_a_crack_that_is_pressed_shut_slides_in_a_solution_of_few_passes():
    # In an infinite plate its faces slip by 4 (1 - nu^2) t sqrt(a^2 - x^2) / E, t the shear that
    # friction leaves; friction grows with the load, so half of its end value does the work.
    found = nmm.run(parse_scene(PLATE)).history
    friction = LOAD / 2 * math.tan(ANGLE)
    slipped = 4 * (1 - POISSON**2) * (LOAD / 2 - friction) / YOUNG * math.pi * HALF**2 / 2
    # The plate is 14 times as wide as the crack, the net 6 cells a half.
    assert found["friction_loss"][0] == pytest.approx(friction * slipped / 2, rel=0.02)
    # Solves worth one factorisation, 20, and the steps of Newton's method, two of them here.
    assert found["passes"][0] <= 40
