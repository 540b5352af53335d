"""In which order a search tries its ways."""

from functools import partial
from types import SimpleNamespace

import numpy as np
import pytest

from nmm.contact.iteration import cut_spring_solver
from nmm.contact.iteration.cut_spring_solver import _WaysToForces
from nmm.contact.iteration.options import DEFAULT
from nmm.contact.iteration.options.budgets import IterationBudget
from nmm.contact.iteration.ways import Ways
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


def ways_in_time(monkeypatch, start, tangent=None, chord=3e-8):
    """Names of the ways of a step in time whose alternation from a residual is cut short.

    Steps with the ``tangent`` of the last solution end at the residual ``chord``.
    """
    taken = []

    def way(name, size):
        def found(self, *given, **told):
            taken.append(name)
            return IterationResult(None, np.zeros(1), size, 108, 1, "")

        return found

    monkeypatch.setattr(_WaysToForces, "alternated", way("alternation", 3e-8))
    monkeypatch.setattr(_WaysToForces, "polished", way("Newton", 1e-14))
    monkeypatch.setattr(_WaysToForces, "inside", way("interior point", 1e-14))
    monkeypatch.setattr(cut_spring_solver, "chords", partial(way("last tangent", chord), None))
    springs = SimpleNamespace(
        residual=lambda increment: SimpleNamespace(size=start), problem=SimpleNamespace()
    )
    kept = [tangent]
    memory = SimpleNamespace(
        ways=Ways(), last_tangent=lambda problem: kept.pop(), keep_tangent=kept.append
    )
    tools = SimpleNamespace(options=DEFAULT, memory=memory)
    _WaysToForces(springs, tools, 1e-8).by_cost(np.zeros(1), BUDGET)
    return taken


def test_newton_ends_in_time_what_was_cut_short_near_its_end(monkeypatch):
    assert ways_in_time(monkeypatch, NEAR) == ["alternation", "Newton"]


def test_it_does_not_where_the_search_began_far_away(monkeypatch):
    assert ways_in_time(monkeypatch, FAR) == ["alternation", "interior point"]


def test_the_tangent_of_the_last_solution_comes_first_where_the_search_begins_near(monkeypatch):
    assert ways_in_time(monkeypatch, NEAR, "tangent", 1e-9) == ["last tangent"]
    assert ways_in_time(monkeypatch, NEAR, "tangent") == ["last tangent", "alternation", "Newton"]
    assert ways_in_time(monkeypatch, FAR, "tangent") == ["alternation", "interior point"]
