"""The equation beside balance where nothing that is controlled moves."""

import numpy as np
import pytest

from nmm.controls.path_equation import PathEquation
from nmm.errors import SolveError


def test_a_load_that_moves_nothing_controlled_is_told_in_words():
    row = np.array([1.0, 0.0])
    path = PathEquation(np.array([0.0, 1.0]), row, 0.0, 1e-3)
    with pytest.raises(SolveError, match="moves nothing that is controlled"):
        path.change(np.array([0.0, 2.0]), np.zeros(2), 0.0)
    assert path.change(np.array([2.0, 0.0]), np.zeros(2), 0.0) == 5e-4
