"""The loop of runs: what it leaves where a step ends it, and where its budget is spent."""

from dataclasses import dataclass
from types import SimpleNamespace

import pytest

from nmm.stepping.drive.until_verdict import until_verdict
from nmm.stepping.drive.verdict import CONVERGED, SPENT, RunVerdict
from nmm.stepping.step.budget import BudgetSpentError


@dataclass(frozen=True)
class At:
    state: SimpleNamespace
    contacts: str


def at(factor):
    return At(SimpleNamespace(load_factor=factor), f"contacts at {factor}")


class Recorder:
    def __init__(self, steps=3):
        self.lasts, self.steps = [], steps

    def last(self, state, stage, contacts):
        self.lasts.append((state.load_factor, stage, contacts))


def counting(end):
    """Raise the load factor by one a step; at three ``end`` returns or raises what ends the run."""

    def step(now):
        return end(now) if now.state.load_factor == 3 else at(now.state.load_factor + 1)

    return step


def spent(now):
    raise BudgetSpentError("3 steps")


def test_the_state_before_the_verdict_is_the_last():
    recorder, verdict = Recorder(), RunVerdict(CONVERGED, "done")
    state, found = until_verdict(at(0), counting(lambda now: verdict), recorder)
    assert found is verdict
    assert state.load_factor == 3
    assert recorder.lasts == [(3, "load", "contacts at 3")]


@pytest.mark.parametrize("stopped", ["stopped, last in equilibrium", "stopped"])
def test_a_spent_budget_leaves_the_last_state_and_says_so(stopped):
    recorder = Recorder()
    state, found = until_verdict(at(0), counting(spent), recorder, stopped)
    assert found.code == SPENT
    assert found.sentence == f"{stopped} at load factor 3: 3 steps"
    assert state.load_factor == 3
    assert recorder.lasts == [(3, "load", "contacts at 3")]


def test_a_budget_that_is_spent_before_any_step_leaves_no_equilibrium():
    _, found = until_verdict(at(0), spent, Recorder(steps=0))
    assert found.sentence == "stopped before the first equilibrium: 3 steps"


def test_a_run_that_ends_at_once_is_left_where_it_began():
    recorder = Recorder()
    state, _ = until_verdict(at(7), lambda now: RunVerdict(CONVERGED, "done"), recorder)
    assert state.load_factor == 7
    assert len(recorder.lasts) == 1
