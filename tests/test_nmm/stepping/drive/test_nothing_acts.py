"""Where nothing acts the motion is rounding, and no force is there to measure it by."""

import numpy as np
import pytest

import nmm
from nmm.scene.read import parse_scene


def pieces_beside_a_prop(shift):
    """Return pieces of a wall that touch along slanting joints, one with a prop at its corner."""
    x, y = shift

    def places(*points):
        return [[x + a, y + b] for a, b in points]

    return f"""
plane = "stress"
thickness = 0.3

[materials.rock]
density = 2000
young_modulus = 6.2778e8
poisson_ratio = 0.45

[[blocks]]
name = "wedge"
material = "rock"
vertices = {places((0.6539, 0), (0.6950, 0.2389), (0.9324, 0))}

[[blocks]]
name = "left"
material = "rock"
vertices = {places((0.6950, 0.2389), (0.6539, 0), (0, 0), (0, 0.9381))}

[[blocks]]
name = "right"
material = "rock"
vertices = {places((0.6950, 0.2389), (0.8849, 1.3427), (1.2147, 1.3427), (1.2147, 0), (0.9324, 0))}

[contact]

[interfaces.joint]
friction_angle = 0.6
bonded = true
cohesion = 6e8
tensile_strength = 6e8

[[springs]]
name = "prop"
points = {places((1.2147, 1.3427), (1.8220, 1.6112))}
blocks = ["right", "ground"]
stiffness = 6.2778e6
carries = "compression"

[[supports]]
name = "held"
segment = {places((0, 0), (1.2147, 0))}
fix = ["x", "y"]

[[stages]]
name = "one"

[formulation.cover]
type = "triangles"
degree = 2
functions = "monomials"
size = 0.8
"""


@pytest.mark.parametrize("shift", [(0.0, 0.0), (1e4, 0.0), (-7e3, 1.3e4), (3e5, -1e5)])
def test_blocks_on_which_nothing_acts_are_in_equilibrium_wherever_they_stand(shift):
    run = nmm.run(parse_scene(pieces_beside_a_prop(shift)))
    assert run.summary.status == "converged", run.summary.sentence
    assert np.abs(run.frames[-1].points - run.frames[0].points).max() <= 1e-9
