"""What a path ends in is audited by the forces on all bodies, whatever its equations say."""

import nmm
from nmm.scene.read import parse_scene

# Two blocks and a bond that softens under a path by dissipation, drawn from random scenes.
SCENE = """
title = "A wedge on a wedge"
plane = "stress"

[materials.rock]
density = 2000
young_modulus = 3.27e8
poisson_ratio = 0.0

[interfaces.joint]
law = "linear_softening"
bonded = true
cohesion = 1.96e5
tensile_strength = 9.8e4
friction_angle = 0.3
fracture_energy = 84.3

[[blocks]]
name = "b0"
material = "rock"
vertices = [[0, 0.2289], [4.252, 1.6294], [4.252, 0], [0, 0]]

[[blocks]]
name = "b1"
material = "rock"
vertices = [[4.252, 1.6294], [0, 0.2289], [0, 2.8645], [4.252, 2.8645]]

[contact]

[[supports]]
name = "held"
segment = [[0, 0], [4.252, 0]]
fix = ["x", "y"]

[[loads]]
name = "corner"
kind = "point"
point = [4.252, 2.8645]
force = [-653.3, -1079.4]

[[loads]]
name = "body"
kind = "body"
block = "b0"
density = [3846.8, -10263.2]

[loading]
until = "failure"

[loading.control]
type = "dissipation"
energy = 2.68
end_energy = 13.4

[formulation.loading]
max_steps = 40
increment = 1.0
"""


def test_a_path_whose_reactions_do_not_bear_its_loads_is_unbalanced() -> None:
    run = nmm.run(parse_scene(SCENE))
    history, factor = run.history, run.history["load_factor"][-1]
    area = 4.252 * (0.2289 + 1.6294) / 2
    asked = [(653.3 - 3846.8 * area) * factor, (1079.4 + 10263.2 * area) * factor]
    given = [history[f"reaction:held:{axis}"][-1] for axis in "xy"]
    off = sum((a - b) ** 2 for a, b in zip(asked, given, strict=True)) ** 0.5
    wrong = off > 1e-2 * max(map(abs, given))
    assert (run.summary.status == "unbalanced") == wrong
    assert ("loads and reactions" in " ".join(run.summary.warnings)) == wrong
