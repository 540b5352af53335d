"""How paths end: what their sentences blame must have happened."""

from dataclasses import replace

import numpy as np
import pytest

from nmm.assembly.state import Frames, State
from nmm.errors import SolveError
from nmm.stepping.control.position import OnPath, PathEnd
from nmm.stepping.control.verdicts import arrived, no_balance
from nmm.stepping.drive.verdict import CONVERGED, FAILURE
from nmm.stepping.step.trial import Attempt

STILL = State(0.0, 0.0, Frames(np.zeros((1, 2)), np.zeros(1)), *np.zeros((3, 4)))


@pytest.mark.parametrize("events", [0, 1])
def test_a_path_that_nothing_holds_blames_bonds_only_where_some_broke(events):
    at = replace(OnPath.at_start(STILL, 1.0), events=events)
    loose = Attempt.failed(STILL, SolveError("its tangent is singular", singular=True))
    assert ("bonds broke" in no_balance(at, loose).sentence) == bool(events)


@pytest.mark.parametrize(("fall", "status"), [(1e-8, CONVERGED), (1e-5, FAILURE)])
def test_what_balance_leaves_of_a_load_on_a_plateau_is_no_limit_point(fall, status):
    """A block that slides is dragged by one load; a residual of 1e-6 is told by no audit."""
    there = replace(STILL, load_factor=3.5 * (1 - fall))
    at = replace(OnPath.at_start(there, 1.0), gone=1.0, peak=3.5)
    verdict = arrived(at, length=1.0, end=PathEnd(factor=1e9, fall=0.1))
    assert verdict is not None
    assert verdict.code == status
