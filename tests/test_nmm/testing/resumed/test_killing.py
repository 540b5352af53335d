"""What holds two runs to be the same tells one byte of a difference, and where it is."""

import json
import shutil

import pytest

from nmm.testing.resumed.killing import check_same_files, killed

DIES = "import os, signal; os.kill(os.getpid(), signal.SIGKILL)"
FILES = [f"frames/{number}.npz" for number in range(6)]
MEASURED = {"seconds": {"solve": 1.5}, "effect_seconds": {}, "peak_memory": 1024}


def written(folder, **summary):
    """A folder of seven files, like that of a run."""
    (folder / "frames").mkdir(parents=True)
    for name in FILES:
        (folder / name).write_bytes(name.encode())
    (folder / "summary.json").write_text(json.dumps({"steps": 10, **MEASURED, **summary}))
    return folder


@pytest.fixture
def whole(tmp_path):
    return written(tmp_path / "whole")


def test_folders_that_differ_in_seconds_and_memory_alone_are_the_same(whole, tmp_path):
    other = {"seconds": {"solve": 9.0}, "effect_seconds": {"loads": 1.0}, "peak_memory": 1}
    check_same_files(whole, written(tmp_path / "other", **other))


def test_one_other_byte_is_told_by_its_file(whole, tmp_path):
    other = written(tmp_path / "other")
    (other / FILES[3]).write_bytes(FILES[3].upper().encode())
    with pytest.raises(AssertionError, match=r"another frames/3\.npz"):
        check_same_files(whole, other)


def test_another_entry_of_the_summary_is_told(whole, tmp_path):
    with pytest.raises(AssertionError, match=r"another summary\.json"):
        check_same_files(whole, written(tmp_path / "other", steps=11))


def test_a_file_that_is_missing_or_too_much_is_told(whole, tmp_path):
    less, more = (written(tmp_path / name) for name in ("less", "more"))
    (less / FILES[0]).unlink()
    shutil.copy(more / FILES[0], more / "frames/.0.npz.tmp")
    for other in (less, more):
        with pytest.raises(AssertionError, match="other files"):
            check_same_files(whole, other)


def test_a_script_that_ends_before_it_is_killed_is_told():
    killed(DIES)
    with pytest.raises(AssertionError, match="not killed"):
        killed("")
