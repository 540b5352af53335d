"""Where on a step the first bond is at its limit: few trials, and the right bond."""

from dataclasses import dataclass
from types import SimpleNamespace

import numpy as np
import pytest

from nmm.stepping.control.locating import CLOSE, TriedStep, located, outward

CURVES = {
    "straight": lambda way: np.array([0.3 * way, 0.5 * way]),
    "bent": lambda way: np.array([0.2 * way**2, 0.1 * (np.exp(way) - 1)]),
    "kinked": lambda way: np.array([0.4 * way, max(0.1 * way, 4 * way - 8)]),
    "endless": lambda way: np.array([0.4 * way if way < 4 else np.inf]),
    "overtaken": lambda way: np.array([1.2 - 0.3 / (0.5 + way), 0.05 * way**3, -way]),
}


@pytest.mark.parametrize("name", CURVES)
@pytest.mark.parametrize("length", [3.0, 30.0])
def test_the_first_bond_at_its_limit_is_found_in_few_trials(name, length):
    tried = []

    def trial(way):
        loads = np.maximum(CURVES[name](way), 0.0)
        tried.append(way)
        return TriedStep(way, SimpleNamespace(converged=True), loads)

    found = located(trial, trial(0.0), trial(length))
    assert found.attempt.converged
    assert abs(found.load - 1) <= CLOSE
    # Nothing is over its strength before: brute force over the way to it.
    ways = np.linspace(0.0, found.way, 501)[:-1]
    assert max(CURVES[name](way).max() for way in ways) < 1
    # Straight loads need one; halving would take 33.
    most = {"straight": 1, "kinked": 8}.get(name, 12)
    if length == 3.0:
        assert len(tried) - 2 <= most


def test_a_trial_without_a_solution_is_told_from_loads_that_do_not_change():
    def trial(way, solved=True, slope=1.0):
        loads = np.array([0.5 + slope * way]) if solved else np.full(1, np.inf)
        return TriedStep(way, SimpleNamespace(converged=solved), loads)

    still = trial(0.0)
    assert outward(lambda way: trial(way, slope=0.0), still, 1.0) is None
    lost = outward(lambda way: trial(way, solved=False), still, 1.0)
    assert lost is not None
    assert not lost.attempt.converged
    found = outward(trial, still, 0.1)
    assert found is not None
    assert found.over >= 0


@dataclass(frozen=True)
class Answer:
    """What `located` reads and changes of an attempt."""

    converged: bool = True
    sentence: str = ""


def test_loads_that_pass_one_by_a_jump_are_no_event_and_are_told():
    def trial(way):
        return TriedStep(way, Answer(), np.array([0.9 if way < 1.7 else 1.2]))

    found = located(trial, trial(0.0), trial(3.0))
    assert not found.attempt.converged
    assert "jumps from 0.9 to 1.2 of its strength" in found.attempt.sentence


def test_a_trial_in_between_that_has_no_solution_is_returned_with_its_reason():
    def trial(way):
        if 0.5 < way < 3.5:
            return TriedStep(way, Answer(False, "no balance"), np.full(1, np.inf))
        return TriedStep(way, Answer(), np.array([0.4 * way]))

    found = located(trial, trial(0.0), trial(4.0))
    assert not found.attempt.converged
    assert found.attempt.sentence == "no balance"
