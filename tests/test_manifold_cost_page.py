"""The page on what the manifold costs says what its records say."""

import sys
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[1]


@pytest.fixture
def cost_tables(monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT / "benchmarks"))
    import cost_tables

    yield cost_tables
    for name in ("cost_tables", "smooth_costs"):
        sys.modules.pop(name, None)


def test_tables_of_the_page_are_those_of_its_records(cost_tables):
    page = (ROOT / "docs/manifold_cost.md").read_text()
    assert cost_tables.tables(page, ROOT / "docs/manifold_cost") == page


def test_ratio_at_equal_error_follows_the_power_law_between_sizes(cost_tables):
    def cost(unknowns, error, seconds):
        phases = dict.fromkeys(cost_tables.PHASES, 0.0) | {"superlu": seconds, "cholesky": seconds}
        return cost_tables.Cost("p", "m", 1, 0, unknowns, error, phases)

    # Error falls with the square root of unknowns, seconds grow like unknowns^1.5.
    baseline = [cost(100, 1e-1, 0.1), cost(10_000, 1e-2, 100.0)]
    mine = [cost(500, 10**-1.5, 1.0)]
    assert cost_tables.ratio(mine, baseline, "unknowns")[0] == pytest.approx(0.5, rel=1e-12)
    assert cost_tables.ratio(mine, baseline, "best")[0] == pytest.approx(1 / 10**0.5, rel=1e-12)


def test_no_ratio_is_given_beyond_the_sizes_solved(cost_tables):
    phases = dict.fromkeys(cost_tables.PHASES, 1.0)
    known = ((10, 0.1), (20, 0.05))
    baseline = [cost_tables.Cost("p", "m", 1, 0, *one, phases) for one in known]
    mine = [cost_tables.Cost("p", "m", 1, 0, 1, 0.01, phases)]
    assert np.isnan(cost_tables.ratio(mine, baseline, "unknowns")).all()
