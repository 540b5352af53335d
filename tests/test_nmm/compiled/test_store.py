import subprocess
import sys
from importlib import import_module, invalidate_caches

import numpy as np
import pytest

from nmm.compiled import store
from nmm.compiled.stamp import stamp

INNER = """
from nmm.compiled import compiled
FACTOR = 2.0
@compiled
def scaled(x):
    return FACTOR * x
"""
OUTER = """
import numpy as np
from nmm.compiled import compiled
from part_inner import scaled
@compiled
def total(values):
    found = 0.0
    for value in values:
        found += scaled(value)
    return found
"""
TWO = np.array([1.0, 2.0])
CALLED = "import numpy as np; from part_outer import total; print(total(np.arange(4.0)))"


@pytest.fixture
def package(tmp_path, monkeypatch):
    """Two modules whose compiled code is kept beside them: a kernel, and one that calls it."""
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setattr(sys, "dont_write_bytecode", True)
    monkeypatch.setattr(store, "folders", lambda: (tmp_path / "kept",))
    (tmp_path / "part_inner.py").write_text(INNER)
    (tmp_path / "part_outer.py").write_text(OUTER)
    yield tmp_path
    _forget()


def _forget():
    sys.modules.pop("part_inner", None)
    sys.modules.pop("part_outer", None)
    invalidate_caches()


def _total():
    """Return the outer kernel as a new process would read it."""
    _forget()
    return import_module("part_outer").total


def _kept(package):
    return {file.name.split("-")[0] for file in (package / "kept").iterdir()}


def test_what_is_kept_is_not_compiled_again(package):
    assert _total()(TWO) == 6.0
    again = _total()
    assert again(TWO) == 6.0
    assert sum(again.stats.cache_misses.values()) == 0
    assert _kept(package) == {"part_inner.scaled", "part_outer.total"}


@pytest.mark.parametrize(
    ("old", "new", "factor"), [("FACTOR * x", "5.0 * x", 5.0), ("= 2.0", "= 3.0", 3.0)]
)
def test_a_kernel_is_compiled_again_when_one_that_it_calls_has_changed(package, old, new, factor):
    assert _total()(TWO) == 6.0
    (package / "part_inner.py").write_text(INNER.replace(old, new))
    changed = _total()
    assert changed(TWO) == 3.0 * factor
    assert sum(changed.stats.cache_misses.values()) == 1


def test_a_kernel_that_another_calls_may_move_to_another_module(package):
    assert _total()(TWO) == 6.0
    (package / "part_inner.py").rename(package / "part_moved.py")
    (package / "part_outer.py").write_text(OUTER.replace("part_inner", "part_moved"))
    moved = _total()
    sys.modules.pop("part_moved")
    # A new process has read nothing of the old module, which is gone.
    assert moved(TWO) == 6.0
    assert sum(moved.stats.cache_misses.values()) == 1


def test_lines_and_comments_compile_nothing_again(package):
    before = stamp(_total())
    (package / "part_inner.py").write_text("# A comment.\n" + INNER)
    assert stamp(_total()) == before


def test_a_kernel_is_another_when_one_that_it_calls_stands_in_another_module(package):
    """Compiled code names the modules of what it calls: it cannot be read where they are gone."""
    before = stamp(_total())
    (package / "part_inner.py").rename(package / "part_moved.py")
    (package / "part_outer.py").write_text(OUTER.replace("part_inner", "part_moved"))
    assert stamp(_total()) != before
    sys.modules.pop("part_moved", None)


def test_values_that_numba_cannot_take_in_do_no_harm(package):
    attribute = INNER.replace("return FACTOR * x", "return FACTOR * x.real")
    (package / "part_inner.py").write_text("import threading\nreal = threading.Lock()" + attribute)
    assert _total()(TWO) == 6.0


def test_what_an_earlier_version_left_goes(package):
    _total()(TWO)
    count = len(list((package / "kept").iterdir()))
    (package / "part_inner.py").write_text(INNER.replace("2.0", "3.0"))
    _total()(TWO)
    assert len(list((package / "kept").iterdir())) == count


def test_what_cannot_be_written_to_is_read_and_another_folder_kept_in(package, monkeypatch):
    (package / "file").write_text("")
    places = package / "file" / "no folder", package / "kept"
    monkeypatch.setattr(store, "folders", lambda: places)
    _total()(TWO)
    again = _total()
    again(TWO)
    assert sum(again.stats.cache_misses.values()) == 0


def test_where_nothing_can_be_written_kernels_run_all_the_same(package, monkeypatch):
    (package / "file").write_text("")
    monkeypatch.setattr(store, "folders", lambda: (package / "file" / "no folder",))
    assert _total()(TWO) == 6.0


def test_a_damaged_file_is_compiled_anew(package):
    _total()(TWO)
    for file in (package / "kept").iterdir():
        file.write_bytes(file.read_bytes()[:100])
    assert _total()(TWO) == 6.0


def test_a_kernel_of_another_module_stays_when_one_is_kept_anew(package):
    _total()(TWO)
    (package / "part_outer.py").write_text(OUTER.replace("0.0", "1.0"))
    _total()(TWO)
    assert _kept(package) == {"part_inner.scaled", "part_outer.total"}


def test_processes_that_start_at_once_share_what_they_keep(package, monkeypatch):
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(package / "shared"))
    started = [
        subprocess.Popen([sys.executable, "-c", CALLED], cwd=package, stdout=subprocess.PIPE)
        for _ in range(2)
    ]
    assert [one.communicate()[0].split() for one in started] == 2 * [[b"12.0"]]
    kept = [file.name for file in (package / "shared").rglob("*") if file.is_file()]
    assert len(kept) == 2
    assert all(name.endswith(".nbc") for name in kept)
