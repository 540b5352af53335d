"""What the command line leaves out at its start and end."""

import dataclasses
import subprocess
import sys

import pytest

from nmm.cli import lean

ASKED = """
import atexit, gc
last = []  # what is registered first is called last
atexit.register(lambda: print("left", gc.get_freeze_count() > 0.9 * last[0]))
from nmm.cli.app import app
try:
    app(["--version"])
except SystemExit:
    last.append(len(gc.get_objects()))
"""


def test_a_verb_ends_without_a_last_search_through_what_it_imported():
    ended = subprocess.run(
        [sys.executable, "-c", ASKED], capture_output=True, text=True, check=True
    )
    assert ended.stdout.splitlines()[-1] == "left True"


def test_frozen_dataclasses_are_the_same_when_their_methods_are_written_late(monkeypatch):
    library = vars(dataclasses)
    if "_create_fn" not in library:
        pytest.skip("this Python's library writes methods otherwise")
    monkeypatch.setitem(library, "_create_fn", library["_create_fn"])
    lean.late_methods()

    @dataclasses.dataclass(frozen=True)
    class Point:
        x: float
        y: float = 2.0

    one, same, other = Point(1.0), Point(1.0, 2.0), Point(1.0, 3.0)
    assert one == same != other
    assert hash(one) == hash(same) == hash((1.0, 2.0))
    assert repr(one).endswith("Point(x=1.0, y=2.0)")
    with pytest.raises(dataclasses.FrozenInstanceError, match="x"):
        one.x = 2.0
    with pytest.raises(dataclasses.FrozenInstanceError, match="x"):
        del one.x
    assert dataclasses.replace(one, y=3.0) == other
