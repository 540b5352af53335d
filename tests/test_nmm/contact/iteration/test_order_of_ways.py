"""In which order a search in statics tries its ways."""

from types import SimpleNamespace

import numpy as np
import pytest

from nmm.contact.iteration.cut_spring_solver import _WaysToForces
from nmm.contact.iteration.options import DEFAULT
from nmm.contact.iteration.options.budgets import IterationBudget
from nmm.contact.problem.cut_springs import IterationResult

BUDGET = IterationBudget()
NEAR, FAR = 2e-3, 0.3


def ways_taken(monkeypatch, size, solves):
    """Names of the ways after an alternation that left a residual after so many solves."""
    taken = []

    def found(size, solves):
        return IterationResult(None, np.zeros(1), size, solves, 6, "")

    def alternated(self, increment, budget):
        taken.append("alternation")
        return found(size if len(taken) == 1 else 1e-10, solves)

    def inside(self, found, goals, rest):
        taken.append("interior point")
        return found

    monkeypatch.setattr(_WaysToForces, "alternated", alternated)
    monkeypatch.setattr(_WaysToForces, "inside", inside)
    search = _WaysToForces(None, SimpleNamespace(options=DEFAULT), 1e-8)
    search.in_order(np.zeros(1), BUDGET)
    return taken


def test_an_alternation_cut_short_near_its_end_goes_on_before_the_interior_point(monkeypatch):
    assert ways_taken(monkeypatch, NEAR, BUDGET.solves) == ["alternation", "alternation"]


@pytest.mark.parametrize(("size", "solves"), [(FAR, BUDGET.solves), (NEAR, 188)])
def test_one_far_from_its_end_or_out_of_factors_does_not(monkeypatch, size, solves):
    assert ways_taken(monkeypatch, size, solves) == ["alternation", "interior point"]
