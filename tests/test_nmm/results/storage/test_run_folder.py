"""Run folders: what goes in comes out, and a kill at any moment leaves a readable run."""

import json
import re
from dataclasses import fields, replace
from pathlib import Path

import numpy as np
import pytest

from nmm.errors import DamageError, NmmError, NmmWarning
from nmm.quantity import Quantity
from nmm.results import Frame, RunFolder, Summary, read_run
from nmm.results.sink import MemorySink
from nmm.results.storage import files
from nmm.testing.resumed.killing import killed


def fill(sink, run):
    """Hand everything of a run in memory to another sink."""
    sink.begin(run.topologies[0])
    for frame, row in zip(run.frames, run.rows, strict=True):
        sink.frame(frame)
        sink.row(row)
    sink.finish(run.summary)
    return sink


def same_frame(one, other):
    return all(
        np.array_equal(getattr(one, item.name), getattr(other, item.name)) for item in fields(Frame)
    )


def test_a_run_reads_back_exactly_as_written(tmp_path, memory_run):
    fill(RunFolder(tmp_path / "run", scene="title = 'a'\n", formulation="x = 1\n"), memory_run)
    stored = read_run(tmp_path / "run")
    assert (stored.scene, stored.formulation) == ("title = 'a'\n", "x = 1\n")
    assert stored.summary == memory_run.summary
    assert len(stored.frames) == 4
    assert all(map(same_frame, stored.frames, memory_run.frames))
    assert isinstance(stored.frames[-1].stage, str)
    assert isinstance(stored.frames[-1].time, float)
    assert list(stored.history) == list(memory_run.history)
    for name, column in memory_run.history.items():
        assert np.array_equal(stored.history[name], column)  # repr of a float reads back exactly
    elements = stored.topologies[0].elements
    assert np.array_equal(elements.points, memory_run.topologies[0].elements.points)
    assert stored.topologies[0].region_names[3] == "cell 3"
    assert set(stored.topologies[0].element_material) == {0, 1}


def test_a_run_without_a_step_has_the_columns_of_every_step_and_no_rows(tmp_path, memory_run):
    folder, memory = RunFolder(tmp_path / "run", scene="a = 1\n", formulation=""), MemorySink()
    for sink in (folder, memory):
        sink.begin(memory_run.topologies[0])
        sink.finish(Summary(status="budget_spent"))
    for history in (memory.history, read_run(tmp_path / "run").history):
        assert {"time", "load_factor", "step", "passes", "residual"} == set(history)
        assert all(column.shape == (0,) for column in history.values())


def test_the_same_run_gives_the_same_bytes(tmp_path, memory_run):
    for name in ("one", "two"):
        fill(RunFolder(tmp_path / name), memory_run)
    files = sorted(
        path.relative_to(tmp_path / "one")
        for path in (tmp_path / "one").rglob("*")
        if path.is_file()
    )
    assert len(files) == 4 + 6  # four frames; mark, scene, formulation, history, topology, summary
    for file in files:
        assert (tmp_path / "one" / file).read_bytes() == (tmp_path / "two" / file).read_bytes()


def test_the_summary_says_running_until_the_end(tmp_path, memory_run):
    folder = RunFolder(tmp_path / "run", summary=Summary(title="a", scene_hash="ff"))
    assert json.loads((tmp_path / "run/summary.json").read_text())["status"] == "running"
    stored = read_run(tmp_path / "run")
    assert stored.summary.scene_hash == "ff"
    steps = len(stored.history["step"])
    assert (len(stored.frames), steps, stored.topologies) == (0, 0, ())
    fill(folder, memory_run)
    assert read_run(tmp_path / "run").summary.status == "failed_load"


KILLED = """
import os, signal, sys
from conftest import made_up_run
from nmm.results import RunFolder
class Dying(RunFolder):
    def finish(self, summary):
        os.kill(os.getpid(), signal.SIGKILL)
made_up_run(Dying(sys.argv[1]), blocks=10, frames=3)
"""


def test_a_killed_run_keeps_its_frames_and_history(tmp_path):
    killed(KILLED, tmp_path / "run", PYTHONPATH=str(Path(__file__).parents[3]))
    stored = read_run(tmp_path / "run")
    assert stored.summary.status == "stopped"
    assert stored.summary.sentence.endswith("3 steps of it can be read, the last at 0.2")
    assert stored.faults == ()
    assert len(stored.frames) == 3
    assert list(stored.history["step"]) == [0, 1, 2]


def test_half_a_frame_or_line_left_by_a_kill_is_not_read(tmp_path, memory_run):
    fill(RunFolder(tmp_path / "run"), memory_run)
    (tmp_path / "run/frames/.000004.npz.77.tmp").write_bytes(b"PK half")
    history = tmp_path / "run/history.csv"
    history.write_text(history.read_text()[:-4])
    stored = read_run(tmp_path / "run")
    assert len(stored.frames) == 4
    assert len(stored.history["step"]) == 3


def test_a_new_history_column_leaves_earlier_rows_empty(tmp_path):
    sink, memory = RunFolder(tmp_path / "run"), MemorySink()
    for row in ({"time": 0.1, "step": 1}, {"time": 0.2, "open": 3}, {"open": 4, "time": 1 / 3}):
        sink.row(row)
        memory.row(row)
    for history in (read_run(tmp_path / "run").history, memory.history):
        assert list(history) == ["time", "step", "open"]
        assert np.array_equal(history["time"], [0.1, 0.2, 1 / 3])
        assert np.array_equal(history["step"], [1, np.nan, np.nan], equal_nan=True)
        assert np.array_equal(history["open"], [np.nan, 3, 4], equal_nan=True)


def test_a_column_name_may_hold_commas_and_quotes(tmp_path):
    sink = RunFolder(tmp_path / "run")
    sink.row({'monitor:"a, b":ux': 1.5})
    assert read_run(tmp_path / "run").history == {'monitor:"a, b":ux': [1.5]}


def test_an_altered_history_is_named_by_line(tmp_path):
    sink = RunFolder(tmp_path / "run")
    sink.row({"a": 1, "b": 2})
    with (tmp_path / "run/history.csv").open("a") as file:
        file.write("1,2,3\n")
    with pytest.warns(NmmWarning, match="history.csv, line 3: 3 cells: expected 2"):
        stored = read_run(tmp_path / "run")
    assert {name: list(column) for name, column in stored.history.items()} == {"a": [1], "b": [2]}


def test_frames_after_a_cut_belong_to_the_new_topology(tmp_path, memory_run):
    topology = memory_run.topologies[0]
    for sink in (RunFolder(tmp_path / "run"), MemorySink()):
        for index, frame in enumerate(memory_run.frames[:2]):
            sink.begin(topology)
            sink.frame(replace(frame, index=index))
        run = sink if isinstance(sink, MemorySink) else read_run(tmp_path / "run")
        assert len(run.topologies) == 2
        assert [frame.topology for frame in run.frames] == [0, 1]


def test_an_earlier_run_is_replaced_whole(tmp_path, memory_run):
    fill(RunFolder(tmp_path / "run"), memory_run)
    RunFolder(tmp_path / "run").row({"time": 0.0})
    stored = read_run(tmp_path / "run")
    assert len(stored.frames) == 0
    assert stored.topologies == ()
    assert list(stored.history) == ["time"]


def test_a_folder_of_something_else_is_left_alone(tmp_path):
    (tmp_path / "thesis.tex").write_text("mine")
    with pytest.raises(NmmError, match="not a run folder"):
        RunFolder(tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["thesis.tex"]


def test_reading_what_is_no_run_says_so(tmp_path):
    with pytest.raises(NmmError, match=r"no run\.json or summary\.json in it"):
        read_run(tmp_path)


def test_frames_can_be_sliced(tmp_path, memory_run):
    stored = read_run(fill(RunFolder(tmp_path / "run"), memory_run).path)
    assert [frame.index for frame in stored.frames[1:3]] == [1, 2]
    with pytest.raises(IndexError):
        stored.frames[4]


FIELDS = {
    "pressure": Quantity("elements", np.array([1.0, np.nan]), "Pa"),
    "flow": Quantity("points", np.arange(16.0).reshape(8, 2), "m/s"),
    "both": Quantity("elements", np.arange(4.0).reshape(2, 2), "Pa", ("major", "minor")),
    "nothing": Quantity("contacts", np.zeros(0), ""),
}


@pytest.fixture
def with_fields(tmp_path):
    """A stored frame with further quantities, and the arrays in its file."""
    frame = Frame(
        0, 0.0, 1.0, "load", *(np.zeros((8, 2)) for _ in range(3)), np.zeros((2, 3)),
        np.zeros((0, 2)), np.zeros((0, 2)), np.zeros(0), np.zeros((0, 2)), np.zeros(0),
        np.zeros(0, dtype=np.int64), fields=FIELDS,
    )  # fmt: skip
    path = tmp_path / "000000.npz"
    files.write_frame(path, frame)
    return path, files.read_arrays(path)


def test_further_quantities_read_back_exactly(with_fields):
    found = files.read_frame(with_fields[0]).fields
    assert list(found) == list(FIELDS)
    for name, one in FIELDS.items():
        assert (found[name].on, found[name].unit) == (one.on, one.unit)
        assert found[name].components == one.components
        assert np.array_equal(found[name].values, one.values, equal_nan=True)
    assert files.archive_fault(with_fields[0]) is None


DAMAGES = {
    "its field_1 is no array": lambda stored: stored.pop("field_1"),
    "its field_0 does not fit its elements": lambda stored: stored.update(field_0=np.zeros(3)),
    "its field_0 does not fit its attic": lambda stored: stored.update(
        field_places=np.array(["attic", "points", "elements", "contacts"])
    ),
    "its field_2 is no array": lambda stored: stored.update(field_2=np.array(["a", "b"])),
    "its field_units have the shape": lambda stored: stored.update(field_units=np.array(["Pa"])),
    "an array 'field_x' that none knows": lambda stored: stored.update(field_x=np.zeros(2)),
}


@pytest.mark.parametrize("words", DAMAGES)
def test_damaged_quantities_are_told(with_fields, words):
    path, stored = with_fields
    DAMAGES[words](stored)
    files.write_arrays(path, stored)
    with pytest.raises(DamageError, match=re.escape(words)):
        files.read_frame(path)
