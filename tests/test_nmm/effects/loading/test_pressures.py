"""Pressure that turns with its surface: no net force on closed bodies, work, even stress."""

import numpy as np
import pytest

import nmm
from nmm.testing import check_effect_of

SPIN = """
title = "a spinning square under pressure"
plane = "strain"
duration = "0.2 s"
[materials.rubber]
young_modulus = 1e6
poisson_ratio = 0.3
density = 1000
[[blocks]]
name = "square"
material = "rubber"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[loads]]
name = "water"
kind = "pressure"
block = "square"
pressure = 1e4
[[initial_velocities]]
block = "square"
angular_velocity = 10.0
[[monitors]]
name = "corner"
point = [1, 1]
[inertia]
[formulation.cover]
{cover}
[formulation.integrator]
type = "newmark"
step = 0.005
"""
COVERS = {
    "block": 'type = "block"',
    "triangles": 'type = "triangles"\nsize = 0.4\ndegree = 0',
    "quads": 'type = "quads"\nsize = 0.6\ndegree = 2',
}


@pytest.mark.parametrize("cover", COVERS)
def test_an_even_pressure_on_a_closed_body_gives_no_force_and_no_moment_in_any_place(cover):
    run = nmm.run(nmm.parse_scene(SPIN.format(cover=COVERS[cover])))
    model, pressures = run.stepper.model, run.stepper.plan.effects["pressures"]
    from nmm.effects.base import Instant

    force = pressures.force(run.state, Instant(0.2, 1.0))
    total = np.abs(model.manifold.rigid_modes.T @ force)
    assert total[:2].max() < 1e-8 * 1e4
    momentum = model.manifold.rigid_modes.T @ (model.mass @ run.state.velocity)
    assert np.abs(momentum[:2]).max() < 1e-8 * 1000
    angle = run.state.frames.angle[0]
    assert angle == pytest.approx(2.0, rel=0.05)


STILL = (
    SPIN.split("[[initial_velocities]]")[0].replace('duration = "0.2 s"\n', "")
    + """
[[supports]]
name = "corner"
point = [0, 0]
fix = ["x", "y"]
[[supports]]
name = "roller"
point = [1, 0]
fix = ["y"]
[[monitors]]
name = "far"
point = [1, 1]
[formulation.cover]
{cover}
"""
)


@pytest.mark.parametrize("cover", COVERS)
@pytest.mark.parametrize("increments", [1, 10])
def test_an_even_pressure_makes_an_even_stress_in_small_displacements(cover, increments):
    loading = "[loading]\nuntil = 1.0\n[formulation.loading]\nincrement = 0.1\n"
    text = STILL.format(cover=COVERS[cover]) + (loading if increments > 1 else "")
    run = nmm.run(nmm.parse_scene(text))
    assert len(run.history["time"]) == increments
    # Work is that of the surface as it was laid, and all of it is stored.
    assert (run.summary.status, run.summary.warnings) == ("converged", [])
    assert run.stress == pytest.approx(np.tile([-1e4, -1e4, 0], (len(run.stress), 1)), abs=1e-5)
    strain = -1e4 * 1.3 * 0.4 / 1e6
    assert run.history["monitor:far:ux"][-1] == pytest.approx(strain, rel=1e-9)
    assert run.history["monitor:far:uy"][-1] == pytest.approx(strain, rel=1e-9)


@pytest.mark.parametrize("cover", COVERS)
def test_pressures_keep_what_every_effect_promises(cover):
    check_effect_of(nmm.parse_scene(SPIN.format(cover=COVERS[cover])), "pressures")


def test_the_work_of_a_pressure_is_pressure_times_the_volume_swept():
    run = nmm.run(nmm.parse_scene(SPIN.format(cover=COVERS["triangles"])))
    before = run.manifold.elements

    swept = before.with_points(before.points + run.displacement).areas.sum() - 1.0
    assert run.history["external_work"][-1] == pytest.approx(-1e4 * swept, rel=1e-6)


def test_a_segment_pushes_against_the_surface_from_both_ways_of_drawing():
    found = []
    for segment in ("[[0, 1], [1, 1]]", "[[1, 1], [0, 1]]"):
        text = STILL.format(cover=COVERS["triangles"])
        text = text.replace('block = "square"\npressure', f"segment = {segment}\npressure")
        found.append(nmm.run(nmm.parse_scene(text)).history["monitor:far:uy"][-1])
    assert found[0] < 0
    assert found[0] == pytest.approx(found[1], rel=1e-12)
