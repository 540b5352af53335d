"""Reactions of supports by multipliers bear the weight of blocks that whole bonds hold together."""

import pytest

import nmm
from nmm.scene.read import parse_scene

SOFTENS = 'law = "linear_softening"\nfracture_energy = 7.1'


@pytest.mark.parametrize(
    ("law", "enforcement", "cover"),
    [
        ("", "penalty", "triangles"),
        ("", "lagrange", "bspline"),
        ("", "penalty", "bspline"),
        (SOFTENS, "penalty", "bspline"),
    ],
)
def test_reactions_of_multipliers_are_the_weight_of_bonded_blocks(law, enforcement, cover):
    run = nmm.run(
        parse_scene(f"""
plane = "stress"

[materials.rock]
density = 2000
young_modulus = 2.8e7
poisson_ratio = 0.2

[interfaces.joint]
bonded = true
friction_angle = 0.3
cohesion = 1.7e5
tensile_strength = 8.4e4
{law}

[[blocks]]
name = "low"
material = "rock"
vertices = [[0, 0.46], [3.14, 2.07], [3.14, 0], [0, 0]]

[[blocks]]
name = "high"
material = "rock"
vertices = [[3.14, 2.07], [0, 0.46], [0, 2.82], [3.14, 2.82]]

[gravity]
acceleration = [0.5, -3.2]

[contact]

[[supports]]
name = "held"
segment = [[0, 0], [3.14, 0]]
fix = ["x", "y"]

[formulation]
cover = {{ type = "{cover}", size = 1.2, degree = 1 }}
contact = {{ enforcement = "{enforcement}" }}
supports = {{ method = "lagrange" }}
""")
    )
    mass = 2000 * 3.14 * 2.82
    assert run.summary.status == "converged"
    found = [run.history[f"reaction:held:{axis}"][-1] for axis in "xy"]
    # Contact is solved to 1e-8.
    assert found == pytest.approx([-0.5 * mass, 3.2 * mass], rel=1e-7)
