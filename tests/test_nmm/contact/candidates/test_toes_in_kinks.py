"""A wedge whose toe stands in the kink of slope and flat slides on the flat as friction lets it."""

import numpy as np
import pytest
from scipy.optimize import brentq

import nmm
from nmm.verification import text
from nmm.verification.reading import last_way

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


def shapes(slope, lean):
    """Return the wedge with a side that leans over the flat, and what it stands on."""
    back, over, far = 2 / np.tan(slope), 2 * np.tan(lean), -6 / np.tan(slope)
    held = {"slope": [[far, 6], [far, -2], [0, -2], [0, 0]], "flat": TWO["flat"]}
    return [[0, 0], [over, 2], [-back, 2]], held


def acceleration(friction, slope, outline):
    """Return that of the toe along the flat, as the wedge slides on it and on the slope (m/s2).

    While the toe moves by t the upper corner moves by t cos(slope) down the slope, and the wedge
    turns by t sin(slope)^2 / 2; forces act at both, at the angle of friction from the normals.
    """
    corners = np.array(outline)
    sides = corners - np.roll(corners, 1, axis=0)
    mass, centre = 2500.0 * (corners[1, 0] - corners[2, 0]), corners.mean(axis=0)
    inertia, turn = mass * (sides**2).sum() / 36, np.sin(slope) ** 2 / 2
    rub = np.tan(friction)
    out, up = (np.sin(slope), np.cos(slope)), (-np.cos(slope), np.sin(slope))
    flat, upper = np.array([-rub, 1.0]), np.add(out, np.multiply(rub, up))
    arms = -centre, corners[2] - centre
    moments = [
        arm[0] * force[1] - arm[1] * force[0]
        for arm, force in zip(arms, (flat, upper), strict=True)
    ]
    motion = np.array([mass * (1 - turn * centre[1]), mass * turn * centre[0], inertia * turn])
    columns = [[*flat, moments[0]], [*upper, moments[1]], -motion]
    weight = [0.0, mass * text.G, 0.0]
    return np.linalg.solve(np.transpose(columns), weight)[2]


BED = [[0, -3], [6, -3], [6, -2], [0, -2]]


def foundation(flat, mirror):
    """Return the outlines of what bears the flat, and what holds the ground."""
    if flat == "held at its base":
        base = f"segment = [[0, -2], [{6 * mirror}, -2]]"
        return [], [text.fixed_block("slope"), text.fixed_block("flat") + base]
    bed = [("bed", BED)] if flat == "on a bed" else []
    return bed, [text.fixed_block(name) for name in ("slope", bed[0][0] if bed else "flat")]


@pytest.mark.parametrize("points", ["vertices", "faces"])
@pytest.mark.parametrize(
    ("mirror", "wedge_first", "slope", "lean", "flat"),
    [
        (1, False, 45, 0, "held"),
        (-1, True, 45, 0, "held"),
        (1, False, 20, 20, "held"),
        (-1, True, 20, 40, "held"),
        (1, True, 20, 30, "held"),
        (-1, False, 20, 20, "held at its base"),
        (1, True, 20, 40, "held at its base"),
        (1, False, 20, 30, "on a bed"),
        (-1, True, 20, 40, "on a bed"),
    ],
)
def test_a_wedge_in_the_kink_of_two_bodies_slides_as_two_forces_say(
    mirror, wedge_first, slope, lean, flat, points
):
    """Its side may lean over the flat as the slope is inclined, and further.

    On its bed the flat, which is heavier, stays where it is.
    """
    outline, ground = shapes(np.radians(slope), np.radians(lean))
    bed, held = foundation(flat, mirror)
    outlines = [("wedge", outline), *ground.items(), *bed][:: 1 if wedge_first else -1]
    parts = [text.block(name, "rock", np.multiply(at, [mirror, 1])) for name, at in outlines]
    stiff = text.material("rock", modulus=1e12, density=2500.0)
    monitor = text.monitor("toe", np.zeros(2), "wedge")
    general = text.weighty(2e-3, duration=0.05)
    general = general.replace("normal_penalty = 100.0", f'points = "{points}"')
    scene = text.scene(general, [stiff, text.interface("any", 2.0), *parts, *held, monitor])
    found = nmm.run(nmm.parse_scene(scene))
    way = last_way(found, "toe")
    way_of_toe = acceleration(np.radians(2.0), np.radians(slope), outline) * 0.05**2 / 2
    # 1 % for what the springs give as weight comes on at once.
    assert way[0] * mirror == pytest.approx(way_of_toe, rel=0.01)
    assert found.summary.audits["energy_made_in_run"] < 1e-6


@pytest.mark.parametrize("joint", [-2.0, -1.0])
@pytest.mark.parametrize(("floor", "speed"), [(False, 0.0), (True, 1.0)])
def test_a_block_passes_an_inclined_joint_of_a_wall_that_it_falls_along_or_a_floor(
    floor, speed, joint
):
    """Wall or floor are two bodies, which supports hold at parts: no corner there catches it."""
    axes = np.array([[0.0, 1.0], [-1.0, 0.0]]) if floor else np.eye(2)
    ends = np.array([[-2.0, 3.0], [-2.0, joint], [-2.0, -4.0]]) @ axes
    outlines = {
        "first": [[0, 0], [0, 3], [-2, 3], [-2, joint]],
        "second": [[0, 0], [-2, joint], [-2, -4], [0, -4]],
        "block": [[0, 0.02], [1, 0.02], [1, 1.02], [0, 1.02]],
    }
    parts = [text.block(name, "rock", np.array(at) @ axes) for name, at in outlines.items()]
    at = zip(("first", "second"), ends, ends[1:], strict=False)
    held = [f"{text.fixed_block(name)}segment = {[a.tolist(), b.tolist()]}\n" for name, a, b in at]
    stiff = text.material("rock", modulus=1e12, density=2500.0)
    start = f'[[initial_velocities]]\nblock = "block"\nvelocity = [{speed}, 0.0]\n'
    monitor = text.monitor("block", np.array([0.5, 0.52]) @ axes, "block")
    parts = [stiff, text.interface("any", 0.0), *parts, *held, monitor, start if speed else ""]
    found = nmm.run(nmm.parse_scene(text.scene(text.weighty(2e-3, duration=0.1), parts)))
    way = last_way(found, "block") @ axes.T
    # 1e-6 m is what the springs of walls give.
    expected = -speed * 0.1 if floor else -text.G * 0.1**2 / 2
    np.testing.assert_allclose(way, [0.0, expected], rtol=0.0, atol=1e-6)
