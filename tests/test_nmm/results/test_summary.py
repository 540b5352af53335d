"""The summary: JSON there and back, and words for the terminal."""

import io

import numpy as np
import pytest

from nmm.errors import NmmError
from nmm.results.summary import Summary
from nmm.results.summary_lines import failure_line, render
from nmm.results.versions import installed_versions


def text_of(summary):
    from rich.console import Console

    console = Console(file=io.StringIO(), width=100)
    console.print(render(summary))
    return console.file.getvalue()


def test_json_reads_back_as_the_same_summary(memory_run):
    assert Summary.from_json(memory_run.summary.to_json()) == memory_run.summary


def test_numbers_json_cannot_hold_become_none():
    summary = Summary(energy_balance=float("nan"), condition_estimate=float("inf"))
    read = Summary.from_json(summary.to_json())
    assert (read.energy_balance, read.condition_estimate) == (None, None)


def test_numpy_numbers_are_written_as_numbers():
    summary = Summary(blocks=np.int64(3), largest_penetration=np.float64(1e-6))
    assert Summary.from_json(summary.to_json()).largest_penetration == 1e-6


def test_an_unknown_field_is_named():
    with pytest.raises(NmmError, match="unknown field 'speed'"):
        Summary.from_json('{"speed": 1}')


def test_text_that_is_no_json_is_named_by_line():
    with pytest.raises(NmmError, match="line 2: not JSON"):
        Summary.from_json('{"a":\nb}')


def test_versions_name_what_a_result_depends_on():
    assert {"python", "nmm-framework", "numpy", "scipy"} <= set(installed_versions())


def test_the_failure_load_comes_with_its_tolerance(memory_run):
    line = failure_line(memory_run.summary)
    assert line == "failure load 9.24 kN, load factor 1.5; none 0.5 % above it is in equilibrium"
    assert failure_line(Summary()) is None


def test_the_table_lists_what_was_measured_only(memory_run):
    text = text_of(memory_run.summary)
    assert "9.24 kN" in text
    assert "broken" in text
    assert "0 open" not in text
    assert "condition" not in text


def test_a_run_that_failed_names_no_failure_load():
    assert failure_line(Summary(status="failed", failure_factor=0.0)) is None
    found = failure_line(Summary(status="failure_load", failure_factor=1.5))
    assert found == "failure load factor 1.5"
