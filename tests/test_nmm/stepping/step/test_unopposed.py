"""Blocks told to be in neutral equilibrium: those that friction lets go one way or the other."""

import pytest

import nmm

# Weight spreads the lower block, so that both of its corners slide outwards at the limit of
# friction; 9.81 kN/m stand on each.
SCENE = """plane = "strain"
[materials.rock]
young_modulus = 1e10
poisson_ratio = 0.2
density = 2000.0
[materials.ice]
young_modulus = 1e9
poisson_ratio = 0.3
density = 2000.0
[materials.soft]
young_modulus = 1e9
poisson_ratio = 0.3
density = 2000.0
[interfaces.rough]
friction_angle = {friction}
[interfaces.wet]
between = ["soft", "ice"]
friction_angle = 0.0
[[blocks]]
name = "floor"
material = "rock"
vertices = [[-1, -1], [2, -1], [2, 0], [-1, 0]]
[[blocks]]
name = "lower"
material = "soft"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[supports]]
name = "ground"
block = "floor"
fix = ["x", "y"]
[gravity]
[contact]
"""
UPPER = (
    '[[blocks]]\nname = "upper"\nmaterial = "ice"\nvertices = [[0, 1], [1, 1], [1, 2], [0, 2]]\n'
)
PUSH = '[[loads]]\nname = "p"\nkind = "body"\nblock = "lower"\ndensity = [{push}, 0.0]\n'


def solved(enforcement: str, friction: str = '"20 deg"', more: str = "") -> nmm.Run:
    scene = nmm.parse_scene(SCENE.format(friction=friction) + more)
    return nmm.run(scene, nmm.Formulation.model_validate({"contact": {"enforcement": enforcement}}))


@pytest.mark.parametrize("enforcement", ["penalty", "cone", "lagrange"])
def test_a_block_both_of_whose_corners_slide_outwards_is_held_by_friction(enforcement):
    assert "neutral" not in solved(enforcement).summary.sentence
    for push in (-1e3, 1e3):  # of 7.1 kN that friction carries
        pushed = solved(enforcement, more=PUSH.format(push=push))
        assert pushed.summary.status == "converged"
        # Springs of 10 E and the block itself give way by 1e-7 m.
        shift = pushed.frames[-1].displacement[4:8, 0].mean()
        assert abs(shift) < 1e-5


@pytest.mark.parametrize("enforcement", ["penalty", "cone"])
def test_a_block_without_friction_is_told_and_so_is_one_on_a_block_that_friction_holds(enforcement):
    smooth = solved(enforcement, friction="0.0").summary.sentence
    assert "block lower is in neutral equilibrium: it moves along (1.00, " in smooth
    above = solved(enforcement, more=UPPER).summary.sentence
    assert "block upper is in neutral equilibrium" in above
    assert "block lower" not in above
