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


@pytest.mark.parametrize(
    ("method", "increment"), [("nitsche", 1.0), ("penalty", 0.25), ("lagrange", 0.25)]
)
def test_a_support_driven_in_a_later_stage_stretches_no_spring_where_loose_blocks_rest(
    method, increment
):
    """All that the rest adds is the strain of a column; springs drawn out by 3 mm held 1.8e5 J."""
    scene = parse_scene("""
plane = "stress"
[materials.rock]
density = 2000
young_modulus = 1e9
poisson_ratio = 0.0
[interfaces.joint]
friction_angle = 0.3
[[blocks]]
name = "driven"
material = "rock"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[blocks]]
name = "loose"
material = "rock"
vertices = [[0, 1.02], [1, 1.02], [1, 2.02], [0, 2.02]]
[[supports]]
name = "ground"
segment = [[0, 0], [1, 0]]
fix = ["x", "y"]
displacement = [0, 3e-3]
history = [[0, 0], [1, 0], [2, 1]]
[gravity]
acceleration = [0, -10]
[contact]
[[stages]]
name = "alone"
remove = ["loose"]
[[stages]]
name = "both"
add = ["loose"]
""")
    table = {
        "cover": {"type": "quads", "size": 1.0, "degree": 1},
        "supports": {"method": method},
        "loading": {"increment": increment},
    }
    run = nmm.run(scene, nmm.Formulation.model_validate(table))
    assert run.summary.status == "converged", run.summary.sentence
    assert "brought to rest" in run.summary.sentence
    # A bar of 1 m2 under its own weight w: w^2 h / (6 E), eight times as much of two such bars.
    alone = WEIGHT**2 / 6e9
    # Springs of contact (10 E) hold 5 mJ, those of the ground 8 mJ of their own, and increments
    # that end where blocks rest move by what the mass of the relaxation left.
    assert run.history["change_energy"][-1] == pytest.approx(7 * alone, abs=2e-2)
    assert run.history["external_work"][-1] == pytest.approx(alone, abs=1e-2)
    assert abs(run.summary.energy_balance) < 1e-6
