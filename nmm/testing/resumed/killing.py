"""Runs that are killed at any moment, and whether two runs are the same byte by byte."""

import json
import os
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np

import nmm
from nmm.stepping.run import Run
from nmm.testing.claims import claim

# Runs a scene and is killed in place of putting the n-th file in its place, or after step n.
KILLED = """
import os, signal, sys
import nmm
scene, folder, what, count = sys.argv[1:]
left, replace = [int(count)], os.replace
def die():
    left[0] -= 1
    if left[0] < 0:
        os.kill(os.getpid(), signal.SIGKILL)
def dying(*places):
    die()
    replace(*places)
if what == "write":
    os.replace = dying
nmm.run(nmm.read_scene(scene), out=folder,
        progress=(lambda share, text: die()) if what == "step" else None)
"""
LONGEST = 600.0  # s


def apart(script: str, *words: object, **variables: str) -> subprocess.CompletedProcess[str]:
    """Run a script with words behind it in a process of its own, with variables of environment.

    It finds this project, and what ``PYTHONPATH`` names among the variables.
    """
    project = str(Path(nmm.__file__).resolve().parents[1])
    path = os.pathsep.join([project, *variables.pop("PYTHONPATH", "").split(os.pathsep)])
    return subprocess.run(
        [sys.executable, "-c", script, *map(str, words)],
        env={**os.environ, **variables, "PYTHONPATH": path},
        capture_output=True,
        text=True,
        timeout=LONGEST,
        check=False,
    )


def killed(script: str, *words: object, **variables: str) -> None:
    """Run a script, see `apart`, that is to kill its own process.

    Raises
    ------
    AssertionError
        When it has ended before.
    """
    done = apart(script, *words, **variables)
    claim(done.returncode == -signal.SIGKILL, f"{words}: not killed: {done.stderr}")


def killed_and_gone_on(scene: Path, folder: Path, what: str, count: int) -> Run:
    """Run a scene file into a folder, kill it, and go on with it.

    It is killed after ``count`` calls of its progress where ``what`` is "step", before the file of
    that number is put in its place where it is "write".

    Raises
    ------
    AssertionError
        When the run has ended before.
    """
    killed(KILLED, scene, folder, what, count)
    resumed = nmm.resume(folder)
    # What a killed write leaves beside its place is no part of the run.
    for scratch in folder.rglob(".*.tmp"):
        scratch.unlink()
    return resumed


def check_same_bytes(whole: Run, resumed: Run, folders: tuple[Path, Path]) -> None:
    """Check that two runs are the same in memory and on disk.

    Raises
    ------
    AssertionError
        Naming what differs.
    """
    check_same_files(*folders)
    claim(list(whole.history) == list(resumed.history), "resumed: other columns of the history")
    for name, column in whole.history.items():
        same = np.array_equal(column, resumed.history[name], equal_nan=True)
        claim(same, f"resumed: another column {name}")
    numbers = [frame.index for frame in resumed.frames]
    claim(numbers == [*range(len(whole.frames))], "resumed: other frames")
    claim(np.array_equal(whole.displacement, resumed.displacement), "resumed: other displacements")


def check_same_files(folder: Path, other: Path) -> None:
    """Check that two run folders are the same byte by byte, but for seconds and memory.

    Raises
    ------
    AssertionError
        Naming what differs.
    """
    one, two = _content(folder), _content(other)
    claim(len(one) > 6, f"{folder}: too few files")
    claim(one.keys() == two.keys(), f"{other}: other files")
    for name, content in one.items():
        claim(content == two[name], f"{other}: another {name}")


def _content(folder: Path) -> dict[str, Any]:
    """Bytes of the files of a run by name, and its summary but for seconds and memory."""
    files = {str(path.relative_to(folder)): path for path in folder.rglob("*") if path.is_file()}
    summary = json.loads(files.pop("summary.json").read_text())
    for name in ("seconds", "effect_seconds", "peak_memory"):
        summary.pop(name)
    return {name: path.read_bytes() for name, path in files.items()} | {"summary.json": summary}
