"""What the command line leaves out at its start and end."""

import dataclasses
import subprocess
import sys
from pathlib import Path

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


PICTURED = """
import sys, nmm.cli.lean as lean
lean.pictures()
from matplotlib.artist import kwdoc
from matplotlib.figure import Figure
from matplotlib.patches import Patch
print("mpl_toolkits.mplot3d" in sys.modules, "alpha" in kwdoc(Patch))
figure = Figure(); figure.subplots().set(title="once")
figure.axes[0].grid(True, color="red"); figure.draw_without_rendering()
print(figure.axes[0].get_title())
import mpl_toolkits.mplot3d
print("Axes3D" in vars(mpl_toolkits.mplot3d))
"""


def test_matplotlib_is_imported_without_axes_in_space_and_is_whole_afterwards():
    code = [sys.executable, "-W", "error", "-c", PICTURED]
    ended = subprocess.run(code, capture_output=True, text=True, check=True)
    assert ended.stdout.splitlines() == ["False True", "once", "True"]


LOOKED = """
import sys
from pathlib import Path
from nmm.cli.app import app
try:
    app(["check", sys.argv[1]])
except SystemExit as ended:
    print(ended.code, "importlib.metadata" in sys.modules)
"""


def test_a_check_reads_no_metadata_of_packages():
    scene = Path(__file__).parents[3] / "examples/incline/slide.toml"
    ended = subprocess.run(
        [sys.executable, "-c", LOOKED, str(scene)], capture_output=True, text=True, check=True
    )
    assert ended.stdout.splitlines()[-1] == "0 False"
