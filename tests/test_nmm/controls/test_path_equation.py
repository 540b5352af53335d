"""The equation beside balance where nothing that is controlled moves."""

from typing import Any

import numpy as np
import pytest

from nmm.controls.base import PathState
from nmm.controls.dissipation import Dissipation
from nmm.controls.path_equation import PathEquation
from nmm.errors import SolveError


def test_a_load_that_moves_nothing_controlled_is_told_in_words():
    row = np.array([1.0, 0.0])
    path = PathEquation(np.array([0.0, 1.0]), row, 0.0, 1e-3)
    with pytest.raises(SolveError, match="moves nothing that is controlled"):
        path.change(np.array([0.0, 2.0]), np.zeros(2), 0.0)
    assert path.change(np.array([2.0, 0.0]), np.zeros(2), 0.0) == 5e-4


class UnderLoad:
    """A state of which a dissipation asks the load factor alone."""

    load_factor = 4.0


def test_a_correction_by_dissipation_does_not_unload():
    # A spring of 5 N/m under 4 times 2 N has gone 1.6 m. Unloading it dissipates nothing, however
    # far: zero dissipation says nothing of it. Normal to the step, a residual of 0.1 N is met by
    # the load alone.
    state: Any = UnderLoad()
    at = PathState(state, np.array([2.0]), np.zeros(1), {}, np.array([1.6]))
    control, along, still = Dissipation(1.0), np.array([2 / 5]), np.array([0.1 / 5])
    with pytest.raises(SolveError, match="moves nothing that is controlled"):
        control.path(at, 0.0).change(along, still, 0.0)
    change = control.correction(at, np.array([0.3])).change(along, still, 0.0)
    assert still[0] + change * along[0] == pytest.approx(0.0, abs=1e-15)
