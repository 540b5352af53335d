"""What an earlier run left in a folder: whether there is one, and how it is deleted.

Only files of the exact names that a run writes are deleted. A folder that holds something else, or
whose parts are links to elsewhere, is refused.
"""

import re
from pathlib import Path

from nmm.errors import DamageError, StorageError
from nmm.plain_file import plain
from nmm.results.storage import files
from nmm.results.storage.mark import RunMark
from nmm.results.storage.writing import told
from nmm.results.summary import Summary

_PICTURES = (
    "deformed|failure_mode|contact_forces|members|covers|load_displacement|history"
    "|stress_(mises|xx|yy|xy|major|minor)"
)
_WRITTEN = {
    ".": rf"{files.TOPOLOGY_NAME.pattern}|history\.csv|scene\.toml|formulation\.toml|run\.json"
    r"|checkpoint\.npz",
    files.FRAMES: files.FRAME_NAME.pattern,
    files.PICTURES: rf"({_PICTURES})\.png",
    files.PARAVIEW: r"(blocks|contacts|members)(_[0-9]{6,}\.vtu|\.pvd)",
}
"""Names of all files that a run and its pictures write, by folder; the summary is written over."""

_SCRATCH = r"\.({names}|summary\.json)\.[0-9]+\.tmp"
"""Of the files that a killed process had not yet put in their place."""


def is_there(folder: Path) -> bool:
    """Return whether an earlier run is in a folder, which a new one may replace.

    Raises
    ------
    StorageError
        When there is something else.
    """
    with told(folder):
        if not folder.exists() or (folder.is_dir() and not _others(folder)):
            return False
        if not folder.is_dir() or not _is_run(folder):
            raise StorageError(
                f"{folder}: exists and is not a run folder: expected a new or empty folder, or "
                f"one with {files.MARK} or {files.SUMMARY} of a run: choose another name"
            )
        for name in _WRITTEN:
            if name != "." and (folder / name).is_symlink():
                raise StorageError(
                    f"{folder / name}: a link to elsewhere: expected a folder in the run folder: "
                    "its files are not deleted through a link; choose another name"
                )
    return True


def delete(folder: Path) -> None:
    """Delete the files of an earlier run, and nothing else."""
    for name, written in _WRITTEN.items():
        pattern = re.compile(rf"{written}|{_SCRATCH.format(names=written)}")
        place = folder / name
        for path in list(place.iterdir()) if place.is_dir() else ():
            if pattern.fullmatch(path.name) and (path.is_file() or path.is_symlink()):
                with told(path):
                    path.unlink()


def delete_after(folder: Path, topologies: int, frames: int) -> None:
    """Delete all topologies and frames but so many, which are to be there.

    Raises
    ------
    DamageError
        When one of them is missing.
    """
    for place, name, count, named in (
        (folder, files.TOPOLOGY_NAME, topologies, files.topology_name),
        (folder / files.FRAMES, files.FRAME_NAME, frames, files.frame_name),
    ):
        found = files.numbered(place, name)
        if lost := sorted(set(range(count)) - set(found)):
            raise DamageError(
                f"{place / named(lost[0])}: missing: expected it as the run wrote it before its "
                "checkpoint: restore it or run the scene again"
            )
        for number, path in found.items():
            if number >= count:
                with told(path):
                    path.unlink()


def _others(folder: Path) -> bool:
    return any(path.name != files.LOCK for path in folder.iterdir())


def _is_run(folder: Path) -> bool:
    """Whether the mark or the summary is one that a run wrote."""
    for name, read in ((files.MARK, RunMark.from_json), (files.SUMMARY, Summary.from_json)):
        try:
            read(plain(folder / name).read_text(encoding="utf-8"))
        except (OSError, ValueError):
            continue
        return True
    return False
