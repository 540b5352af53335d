"""Where bodies meet within a step: roots of gaps, and steps that end there."""

import numpy as np
import pytest

import nmm
from nmm.stepping.adaptive.meeting import _soonest
from nmm.verification.problems.motion.steps_by_error import REBOUNDS, StrainingBounce


@pytest.mark.parametrize(
    ("gap", "rate", "gained", "time"),
    [
        (1.0, -2.0, 0.0, 0.5),
        (0.5, 0.0, -4.0, 0.5),  # from rest
        (1.0, 1.0, -4.0, 1.0),  # first apart
        (1.0, -1.0, 4.0, np.inf),  # turns back before
        (1e-9, -1.0, -9.81, 1e-9),
    ],
)
def test_a_gap_closes_at_its_first_root(gap, rate, gained, time):
    given = (np.array([one]) for one in (gap, rate, gained))
    assert _soonest(*given) == pytest.approx(time, rel=1e-7)


def test_the_first_of_several_gaps_counts():
    gap, rate = np.array([1.0, 0.5, 3.0]), np.array([-1.0, -1.0, 2.0])
    assert _soonest(gap, rate, np.zeros(3)) == pytest.approx(0.5)


def test_a_fall_ends_a_step_as_it_ends():
    """``sqrt(2 h / g)``, exactly in Newmark's rule, to a millionth of the step."""
    case = StrainingBounce(1e8, 0.1)
    time = nmm.run(nmm.parse_scene(case.scene())).history["time"]
    assert abs(time - np.sqrt(2 * 0.5 / 9.81)).min() < 1e-7


def test_a_rebound_comes_nearer_as_the_error_asked_for_falls():
    case = StrainingBounce(1e8, 0.1)
    scenes = [StrainingBounce(1e8, error).scene() for error in (0.1, 0.01)]
    runs = [nmm.run(nmm.parse_scene(scene)) for scene in scenes]
    coarse, fine = (abs(_height(run) - REBOUNDS[case.stiffness]) / 0.5 for run in runs)
    assert coarse < 0.02
    assert fine < 0.1 * coarse


def _height(run):
    way = run.history["monitor:middle:uy"]
    return way[int(way.argmin()) :].max()
