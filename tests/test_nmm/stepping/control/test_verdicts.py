"""How paths end: what their sentences blame must have happened."""

from dataclasses import replace

import numpy as np
import pytest

from nmm.assembly.state import Frames, State
from nmm.errors import SolveError
from nmm.stepping.control.position import OnPath
from nmm.stepping.control.verdicts import no_balance
from nmm.stepping.step.trial import Attempt


@pytest.mark.parametrize("events", [0, 1])
def test_a_path_that_nothing_holds_blames_bonds_only_where_some_broke(events):
    state = State(0.0, 0.0, Frames(np.zeros((1, 2)), np.zeros(1)), *np.zeros((3, 4)))
    at = replace(OnPath.at_start(state, 1.0), events=events)
    loose = Attempt.failed(state, SolveError("its tangent is singular", singular=True))
    assert ("bonds broke" in no_balance(at, loose).sentence) == bool(events)
