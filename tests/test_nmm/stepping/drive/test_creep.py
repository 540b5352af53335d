"""Scenes with a duration and no inertia: equilibrium at all times, and matter that creeps."""

import numpy as np
import pytest

import nmm
from nmm.scene import parse_scene
from nmm.testing.resumed.stopping import check_goes_on
from nmm.testing.scenes import salt_block

SCENE = (
    salt_block("maxwell", 'viscosity = "4e14 Pa s"', {"press": -1}, 'duration = "{duration}"')
    + """[output]
checkpoint.every_steps = 3
[formulation.integrator]
step = {step}
"""
)


def ran(duration="2e4 s", step="1000", out=None):
    return nmm.run(parse_scene(SCENE.format(duration=duration, step=step), "creep"), out=out)


def sinks(run):
    """Settlement of the top from the foot, which springs hold (m)."""
    return run.history["monitor:foot:uy"] - run.history["monitor:top:uy"]


def test_the_load_comes_on_at_once_and_time_passes_after_it():
    run = ran()
    times, top = run.history["time"], sinks(run)
    np.testing.assert_allclose(times[-21:], 1000 * np.arange(21), atol=1e-6)
    # Elastic at once, (1 - nu^2) s / E; after 1e4 s by Laplace transform.
    assert top[times == 0][-1] == pytest.approx((1 - 0.25**2) * 1e-4, rel=1e-6)
    assert top[np.isclose(times, 1e4)][0] == pytest.approx(1.004997224e-4, rel=1e-4)
    assert run.summary.status == "converged"
    assert abs(run.summary.energy_balance) < 1e-3


def test_nothing_has_velocity_without_inertia():
    assert not ran("3000 s").state.velocity.any()


def test_one_long_step_is_stable():
    # Flow at constant stress is exact whatever the step: s / 4 t / eta and the long-term volume.
    run = ran("1e9 s", "1e9")
    bulk, shear = 20e9 / 3, 4e9
    expected = 1e6 / 4 * (1 / shear + 1e9 / 4e14 + 1 / bulk)
    assert sinks(run)[-1] == pytest.approx(expected, rel=1e-4)


@pytest.mark.parametrize("law", ["maxwell", "kelvin"])
def test_a_run_goes_on_bit_by_bit(tmp_path, law):
    text = SCENE.format(duration="9000 s", step="1000").replace("maxwell", law)
    whole = check_goes_on(parse_scene(text, "creep"), tmp_path, 6)
    assert whole.history["time"][-1] == pytest.approx(9000)


@pytest.mark.parametrize(
    ("more", "said"),
    [
        ('[loading]\nuntil = "failure"\n', "duration with \\[loading\\]"),
    ],
)
def test_another_clock_is_refused(more, said):
    text = SCENE.format(duration="1 s", step="1").replace("[output]", more + "[output]")
    with pytest.raises(nmm.errors.SceneError, match=said):
        parse_scene(text, "creep")


BESIDE = """[[blocks]]
name = "beside"
material = "salt"
vertices = [[1, 0], [2, 0], [2, 1], [1, 1]]
[interfaces.any]
between = "any"
friction_angle = 0.0
[contact]
"""


def test_a_block_that_nothing_holds_is_told_in_neutral_equilibrium_though_time_passes():
    """No friction, no weight, no support: its place is any, and its monitors say nothing."""
    text = SCENE.format(duration="3000 s", step="1000")
    alone = nmm.run(parse_scene(text)).summary
    beside = nmm.run(parse_scene(text.replace("[output]", BESIDE + "[output]"))).summary
    assert alone.status == beside.status == "converged"
    assert "block beside is in neutral equilibrium" in beside.sentence
    assert "block block" not in beside.sentence
    assert "neutral" not in alone.sentence
