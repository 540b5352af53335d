"""Graphs of a run: what their curves hold, in which units, and which are drawn together."""

from dataclasses import replace

import numpy as np
import pytest

from nmm import plots
from nmm.errors import NmmError
from nmm.results import MemorySink


def test_no_curve_of_a_page_hides_another(memory_run):
    axes = plots.history(memory_run, ["bonded", "broken"])
    one, other = axes.get_lines()
    assert one.get_linewidth() > other.get_linewidth()
    assert one.get_linestyle() != other.get_linestyle()


def test_a_curve_holds_the_columns_in_readable_units(memory_run):
    axes = plots.curve(memory_run, "monitor:middle:uy", x_factor=-1)
    x, y = axes.lines[0].get_data()
    assert axes.get_xlabel() == "-uy of middle  (µm)"
    assert axes.get_title(loc="left") == "load factor against -uy of middle"
    assert np.allclose(x, -1e6 * memory_run.history["monitor:middle:uy"])
    assert np.array_equal(y, memory_run.history["load_factor"])


def test_columns_of_different_units_are_not_drawn_together(memory_run):
    with pytest.raises(NmmError, match="expected one"):
        plots.history(memory_run, ["load_factor", "monitor:middle:uy"])


def test_an_unknown_column_is_named_with_those_that_exist(memory_run):
    with pytest.raises(NmmError, match="column 'speed': expected one of time, load_factor"):
        plots.curve(memory_run, "speed")


def test_the_overview_draws_what_changed_only(memory_run):
    titles = [axes.get_title(loc="left") for axes in plots.overview(memory_run)]
    assert titles == ["load factor", "contact points", "residual", "uy of middle"]


def test_contacts_of_one_state_are_counted_in_whole_numbers_and_named():
    run = MemorySink()
    for step in range(3):
        run.row({"time": 0.1 * step, "slide": 2})
    (axes,) = plots.overview(run)
    assert axes.get_title(loc="left") == "contact points"
    assert [text.get_text() for text in axes.get_legend().get_texts()] == ["slide"]
    assert all(tick == round(tick) for tick in axes.get_yticks())


def test_the_overview_leaves_out_energies_that_lie_on_the_axis():
    run = MemorySink()
    for step in (0.0, 1.0, 2.0):
        energies = {
            "external_work": step,
            "kinetic_energy": 0.9 * step,
            "contact_loss": 1e-3 * step,
        }
        run.row({"time": step, "step": step, **energies})
    (axes,) = plots.overview(run)
    names = [entry.get_text() for entry in axes.get_legend().get_texts()]
    assert names == ["external work", "kinetic energy"]


def test_contact_points_are_counted_from_zero(memory_run):
    axes = plots.history(memory_run, ["bonded", "broken"])
    assert axes.get_ylim()[0] == 0.0


def test_an_overview_of_nothing_is_empty():
    assert plots.overview(MemorySink()) == []


def test_load_against_displacement_begins_at_rest_without_load(memory_run):
    whole = plots.load_displacement(memory_run).lines[0].get_data()
    first, sink = memory_run.frames[0], MemorySink()
    still = replace(first, load_factor=0.0, displacement=0 * first.displacement)
    sink.topologies, sink.frames = memory_run.topologies, [still, *memory_run.frames[1:]]
    for step in range(1, len(whole[0])):
        sink.row({name: column[step] for name, column in memory_run.history.items()})
    x, y = plots.load_displacement(sink).lines[0].get_data()
    assert (x[0], y[0]) == (0.0, 0.0)
    assert x[1:] == pytest.approx(whole[0][1:])
    assert y[1:] == pytest.approx(whole[1][1:])


def test_load_against_displacement_takes_what_moved_most(memory_run):
    x, y = plots.load_displacement(memory_run).lines[0].get_data()
    assert x[-1] > 0  # downwards counts as positive when the point went down
    assert np.array_equal(y, memory_run.history["load_factor"])
    with pytest.raises(NmmError, match="monitor:roof: expected a displacement"):
        plots.load_displacement(memory_run, "roof")
