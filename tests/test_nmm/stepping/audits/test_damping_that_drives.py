"""Local damping whose signs come a step late gives energy: coarse steps say so, fine ones not."""

import nmm
from nmm.scene.read import parse_scene


def column(step):
    """Return a column of 1 m, a period of 4 / 100 s, under weight for two of these."""
    return parse_scene(f"""
plane = "stress"
duration = 0.08

[materials.rock]
density = 2000
young_modulus = 2e7
poisson_ratio = 0.3

[[blocks]]
name = "column"
material = "rock"
vertices = [[0, 0], [0.5, 0], [0.5, 1], [0, 1]]

[[supports]]
name = "held"
segment = [[0, 0], [0.5, 0]]
fix = ["x", "y"]

[[loads]]
name = "side"
kind = "edge"
segment = [[0, 1], [0.5, 1]]
traction = [1e3, 0]

[gravity]
[inertia]
[damping]
local = 0.3

[formulation.integrator]
type = "newmark"
step = {step}
""")


def test_coarse_steps_of_local_damping_are_told_to_drive_the_motion():
    told = nmm.run(column(0.01)).summary
    assert told.audits["energy_made_by_damping"] > 1e-2
    assert told.status == "unbalanced"
    assert "came from local damping" in told.sentence


def test_damping_that_takes_energy_is_not_told():
    run = nmm.run(column(2e-4))
    assert run.history["damping_loss:local damping"][-1] > 0
    assert run.summary.audits["energy_made_by_damping"] == 0
