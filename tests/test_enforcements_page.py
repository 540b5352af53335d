"""The page on enforcements says what its records say, and rows are cut, kept and judged soundly."""

import json
import sys
from dataclasses import replace
from pathlib import Path
from time import process_time

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[1]
OURS = [path.stem for path in (ROOT / "benchmarks").glob("*.py")]


@pytest.fixture(autouse=True)
def _benchmarks(monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT / "benchmarks"))
    yield
    for name in OURS:
        sys.modules.pop(name, None)


def step_row(size, seconds, **fields):
    import step_rows

    given = {
        "scene": "wall",
        "enforcement": "penalty 1 E",
        "status": "converged",
        "asked": 12,
        "done": 12,
        "left_out": 3,
        "elapsed": seconds,
        "phases": dict.fromkeys(step_rows.PHASES, seconds / 5),
    }
    row = step_rows.StepRow(size=size, blocks=size, seconds=seconds, used=20 * seconds, **given)
    return replace(row, **fields)


def test_the_page_is_what_its_records_say():
    from enforcement_page import page

    text = (ROOT / "docs/enforcements.md").read_text()
    assert page(ROOT / "docs/enforcements") == text


def test_every_scene_and_enforcement_of_the_records_is_on_the_page():
    text = (ROOT / "docs/enforcements.md").read_text()
    for name in ("steps", "enforcement"):
        lines = (ROOT / f"docs/enforcements/{name}.jsonl").read_text().splitlines()
        for row in map(json.loads, lines):
            if row["status" if name == "steps" else "sentence"] not in ("converged", ""):
                assert row["sentence"] in text
            assert f"| {row['enforcement']} |" in text


def test_growth_is_the_exponent_between_sizes():
    from step_rows import growth

    rows = [step_row(100, 0.01), step_row(1000, 0.01 * 10**1.2), step_row(10_000, 5.0)]
    assert growth(rows[1], rows) == pytest.approx(1.2, rel=1e-12)
    assert np.isnan(growth(rows[0], rows))


def test_rows_of_different_commits_do_not_grow():
    from step_rows import growth

    rows = [step_row(100, 0.1, commit="a"), step_row(1000, 0.5, commit="b")]
    assert np.isnan(growth(rows[1], rows))


def test_rows_that_did_not_converge_take_no_part_in_growth():
    from step_rows import growth

    cut = step_row(1000, 1.0, status="cut", cut=3)
    rows = [step_row(100, 0.01), cut, step_row(10_000, 1.0)]
    assert np.isnan(growth(cut, rows))
    # from 100 to 10 000 blocks in a hundred times the seconds, the cut row passed over
    assert growth(rows[2], rows) == pytest.approx(1.0, rel=1e-12)


def test_a_size_is_expected_to_cost_what_the_last_two_sizes_grow_to():
    from step_rows import expected

    rows = [step_row(100, 0.01), step_row(1000, 0.2)]  # twenty times for ten: N^1.301
    seconds, sentence = expected(step_row(10_000, 0.0), rows, 5)
    assert seconds == pytest.approx(5 * 4.0, rel=1e-12)
    assert "N^1.30" in sentence


def test_a_size_without_a_smaller_one_is_always_run():
    from step_rows import expected

    assert expected(step_row(100, 0.0), [step_row(1000, 9.0)], 5) == (0.0, "")


def test_what_failed_at_a_smaller_size_is_expected_to_take_all_it_took_and_more():
    from step_rows import expected

    failed = step_row(100, 0.0, status="failed", done=0, used=10.0)
    seconds, sentence = expected(step_row(1000, 0.0), [failed], 5)
    assert seconds == pytest.approx(10.0 * 10**1.3, rel=1e-12)
    assert "failed at 100 blocks" in sentence


@pytest.mark.parametrize(
    ("fields", "sound"),
    [
        ({}, True),
        ({"status": "cut", "cut": 1}, False),
        ({"status": "failed"}, False),
        ({"status": "stopped", "unfinished": 0.5}, True),
        ({"status": "stopped", "unfinished": 2.5}, False),  # a step that hangs
        ({"status": "stopped", "done": 1, "left_out": 0}, False),  # the first step alone
    ],
)
def test_only_steps_that_converged_as_asked_count(fields, sound):
    row = step_row(100, 1.0, **fields)
    assert row.sound is sound


def test_missed_aims_are_told_by_their_factor_and_met_ones_too():
    from enforcement_summary import aims, short

    rows = [step_row(100, 6e-3), step_row(1000, 30e-3)]  # aims 5 and 40 ms
    text = short([], rows)
    assert "1 of 6 met" in text
    assert "wall of 100 (6.0 ms, 1.2 times the aim, penalty 1 E)" in text
    assert "| **1.2** |" in aims(rows)
    assert "| 0.75 |" in aims(rows)


def test_a_quick_row_that_did_not_converge_meets_no_aim():
    from enforcement_summary import aims, short

    rows = [step_row(100, 1e-3, status="cut", cut=2)]
    assert "0 of 6 met" in short([], rows)
    assert "cut (0.2)" in aims(rows)


def test_a_row_replaces_the_one_with_its_key_and_no_other(tmp_path):
    from records import keep, read
    from step_rows import StepRow

    path = tmp_path / "steps.jsonl"
    for row in (step_row(100, 1.0), step_row(1000, 2.0), step_row(100, 3.0)):
        keep(path, row)
    assert [(r.size, r.seconds) for r in read(path, StepRow)] == [(100, 3.0), (1000, 2.0)]


def test_resuming_passes_over_rows_of_this_commit_unless_they_had_less_budget(monkeypatch):
    import records

    monkeypatch.setattr(records, "commit", lambda: "abc")
    row = step_row(100, 1.0, commit="abc", budget=10.0)
    assert records.standing(row, "same", 10.0, True)
    assert not records.standing(replace(row, commit="old"), "same", 10.0, True)
    assert records.standing(replace(row, commit="old"), "any", 10.0, True)
    assert not records.standing(row, None, 10.0, True)
    assert not records.standing(row, "any", 20.0, False)


def test_work_over_its_budget_is_stopped():
    from budget import Overtime, limit

    began = process_time()

    def work():
        with limit(0.05):
            while process_time() - began < 5.0:
                pass

    with pytest.raises(Overtime):
        work()
    # looked at every 0.05 s of the clock; a machine shared by ten takes that long as well
    assert process_time() - began < 2.0


def test_an_error_ends_its_process_and_is_told():
    from budget import apart

    assert apart(divmod, 7, 2) == ((3, 1), "")
    assert apart(divmod, 7, 0)[0] is None
    assert "ZeroDivisionError" in apart(divmod, 7, 0)[1]


@pytest.mark.parametrize("n_blocks", [100, 400])
def test_cells_of_the_pile_have_three_to_six_contacts_each(n_blocks):
    from whole_scenes import pile

    from nmm.formulation import Formulation
    from nmm.stepping.simulation import prepare

    simulation = prepare(pile(n_blocks, 1.0), Formulation())
    found = simulation.stepper.candidates(simulation.start, 1e-6, 1e-3)
    # an edge between two cells has two contacts; by Euler a cell has six edges in the mean, less
    # those of the open top
    assert 3 <= len(found.gap) / n_blocks <= 6
    assert len(simulation.regions) == n_blocks + 3


def test_cells_with_a_gap_are_the_touching_ones_shrunk():
    from whole_scenes import pile

    from nmm.geometry.regions import regions

    touching = regions(pile(30, 1.0)).polygons.areas
    loose = regions(pile(30, 1.0, gap=0.1)).polygons.areas
    np.testing.assert_allclose(loose[:3], touching[:3], rtol=1e-12)  # the box
    np.testing.assert_allclose(loose[3:], 0.81 * touching[3:], rtol=1e-9)


def test_a_row_of_whole_steps_adds_up(monkeypatch):
    from steps import measure

    row = measure("pile", 20, "penalty 1 E", 5, 60.0)
    assert (row.status, row.done, row.blocks) == ("converged", 5, 23)
    assert sum(row.phases.values()) == pytest.approx(row.elapsed, rel=1e-9)
    assert 0 < row.seconds < row.used


def test_a_row_that_spends_its_budget_says_how_far_it_came():
    from steps import measure

    row = measure("pile", 60, "penalty 100 E", 1000, 0.8)
    assert row.status == "stopped"
    assert f"stopped after {row.done} of 1000 steps" in row.sentence


def test_forces_are_held_to_nothing_that_did_not_converge():
    from block_scenes import Motion, pile
    from enforcement import _error

    from nmm.contact.enforcement.base import make_enforcement
    from nmm.solvers.linear import make_solver

    problem = Motion(pile(20, 1.0)).problem
    answer = make_enforcement("penalty").solve(problem, make_solver())
    hasty = ("penalty", {"iteration": "open_close", "max_passes": 1})
    error, said = _error(problem, answer, (hasty,), 10.0)
    assert error == -1.0
    assert "no force error" in said[0]
    error, said = _error(problem, answer, (hasty, ("penalty", {"tolerance": 1e-12})), 10.0)
    # settled to 1e-8 of the load, so is its error
    assert 0 <= error < 1e-6
    assert "did not converge with iteration" in said[0]
