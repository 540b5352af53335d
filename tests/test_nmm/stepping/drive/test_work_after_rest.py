"""Work where loose blocks were brought to rest before the load grew: it counts from there."""

import pytest

import nmm
from nmm.scene.read import parse_scene

WEIGHT, GAP = 2e4, 1e-3
"""Of the loose block (N), and how far it hangs above the slab (m)."""


@pytest.mark.parametrize("driven", [-5e-4, 5e-4])
def test_a_support_driven_as_loose_blocks_come_to_rest_does_no_more_work_than_their_fall(driven):
    """Weight times way is 5 to 15 J; a spring of the ground drawn out by the way held 1e4 J."""
    run = nmm.run(
        parse_scene(f"""
plane = "stress"
[materials.rock]
density = 2000
young_modulus = 1e10
poisson_ratio = 0.0
[interfaces.joint]
friction_angle = 0.3
[[blocks]]
name = "slab"
material = "rock"
vertices = [[0, -1], [2, -1], [2, 0], [0, 0]]
[[blocks]]
name = "loose"
material = "rock"
vertices = [[0.5, {GAP}], [1.5, {GAP}], [1.5, {1 + GAP}], [0.5, {1 + GAP}]]
[[supports]]
name = "ground"
segment = [[0, -1], [2, -1]]
fix = ["x", "y"]
displacement = [0, {driven}]
history = [[0, 0], [1, 1]]
[gravity]
acceleration = [0, -10]
[contact]
[[monitors]]
name = "middle"
point = [1, 0.5]
block = "loose"
""")
    )
    assert "brought to rest" in run.summary.sentence
    # It stands on the slab, but for strains of 1e-5.
    assert run.history["monitor:middle:uy"][-1] == pytest.approx(driven - GAP, abs=1e-4)
    assert run.history["reaction:ground:y"][-1] == pytest.approx(3 * WEIGHT, rel=1e-6)
    assert abs(run.history["external_work"][-1]) <= WEIGHT * (GAP - driven)
    # Forces of contacts that are there from the rest on count from there: 2.3e-2 without.
    assert abs(run.summary.energy_balance) < 3e-3
