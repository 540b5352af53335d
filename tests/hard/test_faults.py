"""Faults of storage: kills, full disks, two runs in a folder, damaged files.

The oracle is the writer itself: it says over a pipe what it was told is stored, and is then killed
or refused. All of that, and nothing that was never written, must read back.
"""

import errno
import json
import os
import random
import resource
import shutil
import subprocess
import sys
import warnings
from contextlib import suppress
from dataclasses import fields, replace
from pathlib import Path

import numpy as np
import pytest

from nmm.errors import DamageError, NmmWarning, StorageError
from nmm.plots import draw_all
from nmm.results import Frame, MemorySink, RunFolder, read_run
from nmm.results.viewing.paraview import write_paraview
from nmm.testing.resumed.killing import killed
from nmm.verification import text

TESTS = Path(__file__).resolve().parents[1]
KILLS = [*range(4), *(pytest.param(n, marks=pytest.mark.slow) for n in range(4, 40))]

# Forked children write runs without end and are killed after random times; what each was told is
# stored it says first. One process of its own, so that pytest is never forked.
KILLER = """
import os, random, signal, sys, time
from conftest import made_up_run
from nmm.results import MemorySink, RunFolder
seed, many, place = int(sys.argv[1]), int(sys.argv[2]), sys.argv[3]
memory = made_up_run(MemorySink(), blocks=10, frames=4)

def write(pipe, path):
    folder = RunFolder(path, scene="s" * 3000, formulation="f")
    folder.begin(memory.topologies[0])
    number = 0
    while True:
        folder.row({**memory.rows[number % 4], "step": number, f"new {number // 7}": 1.0})
        os.write(pipe, b"r")
        folder.frame(__import__("dataclasses").replace(memory.frames[number % 4], index=number))
        os.write(pipe, b"f")
        number += 1

draw = random.Random(seed)
for number in range(many):
    read, pipe = os.pipe()
    child = os.fork()
    if not child:
        try:
            write(pipe, f"{place}/{number % 3}")
        finally:
            os._exit(1)
    os.close(pipe)
    time.sleep(draw.uniform(0, 0.03))
    os.kill(child, signal.SIGKILL)
    os.waitpid(child, 0)
    said = b""
    while more := os.read(read, 65536):
        said += more
    os.close(read)
    os.system(f"cp -r {place}/{number % 3} {place}/killed_{number} 2>/dev/null")
    print(said.count(b"r"), said.count(b"f"), flush=True)
"""


def process(script, *words, **options):
    return subprocess.run(
        [sys.executable, "-c", script, *map(str, words)],
        capture_output=True,
        text=True,
        env={**os.environ, "PYTHONPATH": f"{TESTS}:{TESTS.parent}"},
        timeout=300,
        **options,
    )


def same_frame(one, other):
    """Whether two frames hold the same numbers, but for their place in the run."""
    return all(
        np.array_equal(getattr(one, item.name), getattr(other, item.name))
        for item in fields(Frame)
        if item.name != "index"
    )


@pytest.mark.parametrize("seed", KILLS)
def test_what_was_stored_before_a_kill_at_any_moment_is_read_back(tmp_path, seed, write_run):
    memory = write_run(MemorySink(), blocks=10, frames=4)
    done = process(KILLER, seed, 25, tmp_path)
    assert done.returncode == 0, done.stderr
    told = [tuple(map(int, line.split())) for line in done.stdout.splitlines()]
    assert len(told) == 25
    for number, (rows, frames) in enumerate(told):
        folder = tmp_path / f"killed_{number}"
        if not folder.exists() or not any(folder.glob("*.json")):
            assert rows == 0  # killed before anything was written
            continue
        stored = read(folder)
        if stored.summary.status == "replacing":
            assert rows == 0
            continue
        assert stored.faults == ()  # nothing is damaged
        assert stored.summary.status == "stopped"
        steps = stored.history.get("step", np.empty(0))
        assert np.array_equal(steps, np.arange(len(steps)))
        # One more than was told may be there: the kill came before the child could say so. A child
        # that never began has left the run of the one before it.
        if rows:
            assert rows <= len(steps) <= rows + 1
            assert frames <= len(stored.frames) <= frames + 1
        for index, frame in enumerate(stored.frames):
            assert frame.index == index
            assert same_frame(frame, memory.frames[index % 4])


class Disk:
    """A disk on which the call number ``fail`` of those that write fails, half done."""

    def __init__(self, monkeypatch, fail, code):
        self.calls, self.fail, self.code = 0, fail, code
        plain_write, plain_bytes = os.write, Path.write_bytes
        monkeypatch.setattr(Path, "write_bytes", self.half(plain_bytes, plain_bytes))
        monkeypatch.setattr(os, "write", self.half(plain_write, plain_write))
        for name in ("replace", "fsync", "ftruncate"):
            monkeypatch.setattr(os, name, self.whole(getattr(os, name)))
        monkeypatch.setattr(Path, "mkdir", self.whole(Path.mkdir))
        monkeypatch.setattr(Path, "unlink", self.whole(Path.unlink))

    def refuse(self):
        self.calls += 1
        return self.calls == self.fail

    def half(self, plain, part):
        def call(where, content):
            if self.refuse():
                part(where, content[: len(content) // 2])
                raise OSError(self.code, os.strerror(self.code))
            return plain(where, content)

        return call

    def whole(self, plain):
        def call(*where, **how):
            if self.refuse():
                raise OSError(self.code, os.strerror(self.code))
            return plain(*where, **how)

        return call


def write_all(path, memory, told):
    """Write a run as `nmm.run` does, noting what was taken."""
    folder = None
    try:
        folder = RunFolder(path, scene="a", formulation="b")
        folder.begin(memory.topologies[0])
        for frame, row in zip(memory.frames, memory.rows, strict=True):
            folder.row(row)
            told["rows"] += 1
            folder.frame(frame)
            told["frames"] += 1
        folder.finish(replace(memory.summary, frames=len(memory.frames)))
    except BaseException as fault:
        if folder is not None:
            folder.stop(fault)
        raise


REFUSALS = [
    (errno.ENOSPC, True),
    (errno.EACCES, False),
    pytest.param(errno.ENOSPC, False, marks=pytest.mark.slow),
    *(pytest.param(errno.EIO, former, marks=pytest.mark.slow) for former in (False, True)),
    *(pytest.param(errno.EDQUOT, former, marks=pytest.mark.slow) for former in (False, True)),
]


@pytest.mark.parametrize(("code", "former"), REFUSALS)
def test_a_refusal_at_any_write_loses_nothing_that_was_stored(tmp_path, code, former, write_run):
    memory = write_run(MemorySink(), blocks=10, frames=3)
    path, number, refused = tmp_path / "run", 0, True
    while refused:
        number += 1
        shutil.rmtree(path, ignore_errors=True)
        if former:
            write_all(path, memory, {"rows": 0, "frames": 0})
        told = {"rows": 0, "frames": 0}
        with pytest.MonkeyPatch.context() as patch:
            disk = Disk(patch, number, code)
            said = refusal(write_all, path, memory, told)
        refused = disk.calls >= number
        if said:
            assert str(path) in said
            assert os.strerror(code).lower() in said
            assert "\n" not in said
        if not any(path.glob("*.json")):
            assert told == {"rows": 0, "frames": 0}
            continue
        stored = read(path)
        if stored.summary.status == "replacing":
            assert told["rows"] == 0
            continue
        assert len(stored.frames) >= told["frames"]
        assert all(map(same_frame, stored.frames, memory.frames))
        assert len(stored.history.get("step", ())) >= told["rows"]
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", NmmWarning)  # the lock itself may have been refused
            RunFolder(path).close()
    assert number > 20  # every call was tried


def refusal(call, *words):
    """What a call is refused with, nothing when it is not."""
    try:
        call(*words)
    except StorageError as fault:
        return str(fault)
    return ""


def read(path):
    """Read a run, whatever it warns of."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", NmmWarning)
        return read_run(path)


SCENE = text.scene(
    text.weighty(1e-3, duration=0.06),
    [text.material("rock"), *text.floor(), text.box("stone", (0, 0.001), (1, 1))],
)


def limit_files():
    resource.setrlimit(resource.RLIMIT_FSIZE, (6000, 6000))


def test_a_run_whose_files_grow_too_large_ends_in_one_line(tmp_path):
    (tmp_path / "drop.toml").write_text(SCENE)
    script = "from nmm.cli.app import app; app()"
    words = ("run", tmp_path / "drop.toml", "--out", tmp_path / "run", "-q")
    done = process(script, *words, preexec_fn=limit_files)
    assert done.returncode == 1
    assert len(done.stderr.splitlines()) == 1, done.stderr
    assert "history.csv: cannot be written, file too large: expected a limit" in done.stderr
    stored = read_run(tmp_path / "run")
    assert stored.summary.status == "stopped"
    steps = len(stored.history["step"])
    assert "history.csv" in stored.summary.sentence
    assert stored.summary.steps == steps
    assert 10 < steps < 60
    assert (tmp_path / "run/history.csv").stat().st_size <= 6000
    assert (tmp_path / "run/history.csv").read_text().endswith("\n")
    assert len(stored.frames) == steps + 1  # the start, and one a step


def test_a_second_run_into_a_folder_is_refused_while_the_first_writes(tmp_path, write_run):
    first = RunFolder(tmp_path / "run")
    first.row({"step": 1})
    script = "import sys; from nmm.results import RunFolder; RunFolder(sys.argv[1])"
    other = process(script, tmp_path / "run")
    assert f"in use by process {os.getpid()} on " in other.stderr
    with pytest.raises(StorageError, match="choose another folder"):
        RunFolder(tmp_path / "run")
    assert read_run(tmp_path / "run").summary.sentence.startswith("the run has not ended: process")
    first.row({"step": 2})
    assert list(read_run(tmp_path / "run").history["step"]) == [1, 2]
    first.close()
    write_run(RunFolder(tmp_path / "run"), blocks=10, frames=2)
    assert not (tmp_path / "run/.lock").exists()


def test_the_lock_of_a_killed_run_is_told_and_taken_over(tmp_path):
    script = (
        "import os, sys; from nmm.results import RunFolder; folder = RunFolder(sys.argv[1]);"
        "folder.row({'step': 1}); os.kill(os.getpid(), 9)"
    )
    killed(script, tmp_path / "run")
    assert (tmp_path / "run/.lock").exists()
    assert read_run(tmp_path / "run").summary.status == "stopped"
    with pytest.warns(NmmWarning, match=r"process \d+ on .* was stopped here before its run"):
        RunFolder(tmp_path / "run").close()


def test_a_lock_of_another_host_is_taken_at_its_word(tmp_path):
    RunFolder(tmp_path / "run").close()
    lock = {"pid": 1, "host": "elsewhere", "since": "yesterday"}
    (tmp_path / "run/.lock").write_text(json.dumps(lock))
    with pytest.raises(StorageError, match=r"process 1 on elsewhere .*delete .*lock"):
        RunFolder(tmp_path / "run")
    assert "elsewhere" in read_run(tmp_path / "run").summary.sentence


RACE = """
import os, sys, time
from nmm.errors import StorageError
from nmm.results import RunFolder
time.sleep(max(0.0, float(sys.argv[2]) - time.time() - 0.01))
while time.time() < float(sys.argv[2]):
    pass
try:
    folder = RunFolder(sys.argv[1])
except StorageError:
    print("refused")
else:
    time.sleep(2)
    print("held")
    folder.close()
"""


def test_of_runs_that_start_at_once_in_a_folder_one_goes_on(tmp_path):
    import time

    start = str(time.time() + 3)
    command = [sys.executable, "-c", RACE, str(tmp_path / "run"), start]
    paths = {**os.environ, "PYTHONPATH": str(TESTS.parent)}
    many = [subprocess.Popen(command, stdout=-1, env=paths, text=True) for _ in range(4)]
    said = sorted(one.communicate(timeout=60)[0].strip() for one in many)
    assert said == ["held", "refused", "refused", "refused"]


def nothing_lost(before, folder):
    """Whether all files of the user are as they were."""
    return all((folder / name).read_text() == text for name, text in before.items())


def test_a_new_run_deletes_nothing_but_what_a_run_writes(tmp_path, write_run):
    folder = tmp_path / "run"
    write_run(RunFolder(folder), blocks=10, frames=3)
    mine = ("notes.txt", "pictures/mine.png", "frames/7.npz", "frames/1.npz.bak", "paraview/a.vtu",
            "topology_old.npz", "history.csv.bak", "pictures/deformed.png.orig")  # fmt: skip
    for name in mine:
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_text(name)
    write_run(RunFolder(folder), blocks=10, frames=1)
    assert nothing_lost({name: name for name in mine}, folder)
    assert [path.name for path in (folder / "frames").glob("0*.npz")] == ["000000.npz"]


def test_nothing_is_deleted_through_a_link(tmp_path, write_run):
    elsewhere = tmp_path / "elsewhere"
    write_run(RunFolder(elsewhere), blocks=10, frames=2)
    write_run(RunFolder(tmp_path / "run"), blocks=10, frames=1)
    shutil.rmtree(tmp_path / "run/frames")
    (tmp_path / "run/frames").symlink_to(elsewhere / "frames")
    with pytest.raises(StorageError, match="a link to elsewhere"):
        RunFolder(tmp_path / "run")
    assert len(read_run(elsewhere).frames) == 2


@pytest.mark.parametrize("content", ['{"status": "ok", "mine": 1}', "[1, 2]", "not json", ""])
def test_the_summary_of_another_program_makes_no_run_folder(tmp_path, content):
    (tmp_path / "summary.json").write_text(content)
    (tmp_path / "history.csv").write_text("mine")
    with pytest.raises(StorageError, match="is not a run folder"):
        RunFolder(tmp_path)
    assert (tmp_path / "history.csv").read_text() == "mine"


def test_a_folder_of_a_later_layout_is_told(tmp_path, write_run):
    write_run(RunFolder(tmp_path / "run"), blocks=10, frames=1)
    mark = json.loads((tmp_path / "run/run.json").read_text())
    (tmp_path / "run/run.json").write_text(json.dumps(mark | {"format": 3, "new": []}))
    with pytest.raises(StorageError, match=r"run.json: format 3: expected 2 at most: read it with"):
        read_run(tmp_path / "run")


def test_a_folder_of_before_the_mark_is_read(tmp_path, write_run):
    write_run(RunFolder(tmp_path / "run"), blocks=10, frames=2)
    (tmp_path / "run/run.json").unlink()
    stored = read_run(tmp_path / "run")
    assert (stored.faults, len(stored.frames)) == ((), 2)


def test_a_scene_cut_off_is_told_though_what_is_left_is_toml(tmp_path):
    RunFolder(tmp_path / "run", scene='title = "a"\nplane = "strain"\n').close()
    (tmp_path / "run/scene.toml").write_text('title = "a"\n')
    assert "scene.toml: altered or cut off" in read(tmp_path / "run").faults[0]


def damages(path, draw):
    """All ways in which one file is damaged here, by name; drawn at random where bytes matter."""
    content = path.read_bytes()

    def truncate():
        path.write_bytes(content[: draw.randrange(max(len(content), 1))])

    def flip():
        changed = bytearray(content or b"x")
        for _ in range(draw.choice([1, 5, 50])):
            changed[draw.randrange(len(changed))] = draw.randrange(256)
        path.write_bytes(bytes(changed))

    def insert():
        at = draw.randrange(len(content) + 1)
        path.write_bytes(content[:at] + draw.randbytes(draw.choice([1, 10, 1000])) + content[at:])

    def directory():
        path.unlink()
        path.mkdir()

    return [
        truncate, truncate, truncate, flip, flip, flip, insert, insert, directory, path.unlink,
        lambda: path.write_bytes(b""), lambda: path.write_bytes(draw.randbytes(300)),
        lambda: path.write_bytes(b"\xef\xbb\xbf" + content), lambda: path.write_bytes(b"\0" * 500),
    ]  # fmt: skip


NAMES = ("frames/000001.npz", "frames/000003.npz", "topology.npz", "history.csv", "summary.json",
         "run.json", "scene.toml", "formulation.toml")  # fmt: skip
ROUNDS = [0, *(pytest.param(n, marks=pytest.mark.slow) for n in range(1, 60))]


@pytest.mark.parametrize("seed", ROUNDS)
@pytest.mark.parametrize("name", NAMES)
def test_a_damaged_file_is_told_by_name_and_the_others_are_read(tmp_path, name, seed, write_run):
    memory = write_run(MemorySink(), blocks=10, frames=4)
    whole = tmp_path / "whole"
    write_all(whole, memory, {"rows": 0, "frames": 0})
    draw = random.Random(f"{name} {seed}")
    for number in range(14):
        folder = tmp_path / str(number)
        shutil.copytree(whole, folder)
        damages(folder / name, draw)[number]()
        altered = not (folder / name).is_file() or (
            (folder / name).read_bytes() != (whole / name).read_bytes()
        )
        if refused := refusal(read, folder):
            assert "run.json: format" in refused  # a digit of the version was changed
            continue
        stored = read(folder)
        said = list(stored.faults)
        readable = {}
        for position in range(len(stored.frames)):
            try:
                frame = stored.frames[position]
            except DamageError as fault:
                said.append(str(fault))
            else:
                readable[frame.index] = frame
        write_paraview(stored, folder / "paraview", said.append)
        others = {1, 3, 0, 2} - ({int(name[7:13])} if name.startswith("frames") else set())
        if "topology" not in name:
            assert all(same_frame(readable[n], memory.frames[n]) for n in others)
        if "history" not in name:
            assert list(stored.history["step"]) == [0, 1, 2, 3]
        # Some bytes of a zip, and digits of a number, may change and nothing be known of it.
        if name not in ("history.csv", "summary.json", "run.json") and number in (0, 8, 9, 10, 11):
            assert not altered or any(name in one for one in said), (number, said)
        assert all("\n" not in one for one in said)


@pytest.mark.parametrize("name", NAMES)
def test_a_damaged_run_is_drawn_as_far_as_it_can_be(tmp_path, name, write_run):
    memory = write_run(MemorySink(), blocks=10, frames=4)
    write_all(tmp_path / "run", memory, {"rows": 0, "frames": 0})
    (tmp_path / "run" / name).write_bytes((tmp_path / "run" / name).read_bytes()[:40])
    said = []
    drawn = {path.name for path in draw_all(read(tmp_path / "run"), tmp_path, tell=said.append)}
    curves, shapes = {"history.png"}, {"stress_mises.png", "contact_forces.png"}
    if name != "history.csv":
        assert curves <= drawn
    if name != "topology.npz":
        assert shapes <= drawn
        assert drawn & {"deformed.png", "failure_mode.png"}
    else:
        assert all("topology.npz: damaged" in one for one in said)
        assert said


@pytest.mark.parametrize("name", [*NAMES, ".lock"])
def test_a_pipe_or_a_device_in_the_place_of_a_file_is_told_and_never_waited_for(
    tmp_path, name, write_run
):
    memory = write_run(MemorySink(), blocks=10, frames=4)
    folder = tmp_path / "run"
    write_all(folder, memory, {"rows": 0, "frames": 0})
    for put in (os.mkfifo, lambda path: path.symlink_to("/dev/zero")):
        (folder / name).unlink(missing_ok=True)
        put(folder / name)
        stored = read(folder)
        assert list(stored.history["step"]) in ([], [0, 1, 2, 3])
        assert name == ".lock" or any(f"{name}: cannot be read" in one for one in stored.faults)
    with suppress(StorageError):  # a run there is refused, or takes its place
        RunFolder(folder, scene="a", formulation="b").close()


@pytest.mark.parametrize("lost", [1, 4, "all"])
def test_a_history_that_lacks_steps_of_a_run_that_ended_is_told(tmp_path, lost, write_run):
    memory = write_run(MemorySink(), blocks=10, frames=4)
    write_all(tmp_path, memory, {"rows": 0, "frames": 0})
    path = tmp_path / "history.csv"
    kept = "".join(path.read_text().splitlines(keepends=True)[: 5 - (lost if lost != "all" else 0)])
    path.unlink() if lost == "all" else path.write_text(kept)
    (fault,) = read(tmp_path).faults
    assert f"{4 - lost if lost != 'all' else 0} steps in it, 4 in the summary" in fault


def test_a_frame_in_the_place_of_another_is_told(tmp_path, write_run):
    memory = write_run(MemorySink(), blocks=10, frames=4)
    write_all(tmp_path, memory, {"rows": 0, "frames": 0})
    shutil.copy(tmp_path / "frames/000000.npz", tmp_path / "frames/000003.npz")
    with pytest.raises(DamageError, match=r"000003\.npz: damaged \(it is frame 0\)"):
        read(tmp_path).frames[-1]
