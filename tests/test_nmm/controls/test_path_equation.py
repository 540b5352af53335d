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


def at(losing: float) -> PathState:
    """Return a spring of 5 N/m under a load of 2 N a factor, with a bond's loss by its motion."""
    state: Any = None
    load, none = np.array([2.0]), np.zeros(1)
    return PathState(state, load, none, {}, none, lambda: np.full(1, losing))


@pytest.mark.parametrize("losing", [0.7, 0.0])
def test_a_correction_by_dissipation_moves_no_bond_that_loses_energy(losing: float) -> None:
    # A residual of 0.1 N is met by the load alone: jumps that lose energy stand still, and where
    # none does the correction is normal to the step.
    along, still = np.array([2 / 5]), np.array([0.1 / 5])
    path = Dissipation(1.0).correction(at(losing), np.array([0.3]))
    change = path.change(along, still, 0.0)
    assert still[0] + change * along[0] == pytest.approx(0.0, abs=1e-15)


def test_a_step_by_dissipation_goes_as_far_as_bonds_lose_its_energy() -> None:
    path = Dissipation(1.0).path(at(0.7), 0.35)
    change = path.change(np.array([2 / 5]), np.zeros(1), 0.0)
    assert change * 2 / 5 == pytest.approx(0.5)
    with pytest.raises(SolveError, match="moves nothing that is controlled"):
        Dissipation(1.0).path(at(0.0), 0.35).change(np.array([2 / 5]), np.zeros(1), 0.0)
