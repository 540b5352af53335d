"""A wedge whose toe stands in the kink of slope and flat slides on the flat as friction lets it."""

import numpy as np
import pytest
from scipy.optimize import brentq

import nmm

SCENE = """
plane = "strain"
[materials.rock]
young_modulus = 1e9
poisson_ratio = 0.2
density = 2500
[interfaces.joint]
friction_angle = %s
%s
[[blocks]]
name = "wedge"
material = "rock"
vertices = [[0, 0], [0, 2], [-2, 2]]
%s
[gravity]
[contact]
"""
HELD = '[[blocks]]\nname = "%s"\nmaterial = "rock"\nvertices = %s\n'
HELD += '[[supports]]\nname = "%s"\nblock = "%s"\nfix = ["x", "y"]\n'
ONE = {"ground": [[-4, 4], [-4, -2], [6, -2], [6, 0], [0, 0]]}
TWO = {
    "slope": [[-4, 4], [-4, -2], [0, -2], [0, 0]],
    "flat": [[0, 0], [0, -2], [6, -2], [6, 0]],
}


def wedge(friction, ground, cohesion=""):
    held = "".join(HELD % (name, outline, name, name) for name, outline in ground.items())
    return SCENE % (friction, cohesion, held)


def least_friction():
    """Return the angle at which slope and flat just hold the wedge (rad).

    Weight acts along x = -2/3. The flat's force leaves the toe at the angle of friction from the
    vertical, the slope's acts at its upper end, [-2, 2], at that angle from the slope's normal,
    and all three meet in one point.
    """

    def too_high(angle):
        return 2 / 3 / np.tan(angle) - 2 - 4 / 3 / np.tan(np.pi / 4 - angle)

    return brentq(too_high, 0.05, 0.5)


@pytest.mark.parametrize(
    ("ground", "cohesion"),
    [(ONE, ""), (TWO, ""), (TWO, "cohesion = 1.0")],
    ids=["one body", "two bodies", "joints"],
)
def test_a_wedge_in_a_kink_is_as_safe_as_three_forces_in_one_point_say(ground, cohesion):
    expected = np.tan(np.pi / 6) / np.tan(least_friction())
    text = (
        wedge(np.pi / 6, ground, cohesion) + "[strength_reduction]\nlowest = 3.3\nhighest = 3.5\n"
    )
    found = nmm.run(nmm.parse_scene(text)).summary
    # The cohesion of 1 Pa holds 3 N of 49 kN, and the wedge shortens by 1e-5.
    assert found.factor_of_safety <= expected * (1 + 1e-4)
    assert found.factor_that_fails >= expected * (1 - 1e-4)
    assert found.factor_that_fails - found.factor_of_safety <= 0.01
