"""Writes that a kill or a full disk never leaves half done, and refusals in one sentence.

A file is written beside its place and renamed into it, so readers see the old or the new content.
That outlives the death of the process at any moment. Against a power cut files are also brought to
the disk (fsync), but not each by itself: a run does so at most every `INTERVAL` seconds and at its
end (`ToDisk`), so that a power cut costs at most its last seconds.
"""

import errno
import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path
from time import monotonic

import numpy.typing as npt

from nmm.errors import StorageError
from nmm.results.storage.archive import to_bytes

INTERVAL = 5.0  # s between two times at which files are brought to the disk

_ROOM = "room for it: free some, or choose another folder; what was written before can be read"
_LEAVE = "leave to write there: change the permissions or choose another folder"
_PLACE = "a folder that can be made: choose another name"
_EXPECTED = {
    errno.ENOSPC: _ROOM,
    errno.EDQUOT: _ROOM,
    errno.EFBIG: "a limit on the size of files that lets it pass: raise it (ulimit -f)",
    errno.EACCES: _LEAVE,
    errno.EPERM: _LEAVE,
    errno.EROFS: _LEAVE,
    errno.ENOTDIR: _PLACE,
    errno.EEXIST: _PLACE,
    errno.EISDIR: _PLACE,
    errno.ELOOP: _PLACE,
    errno.ENAMETOOLONG: "a shorter name: choose one",
}


@contextmanager
def told(path: Path) -> Iterator[None]:
    """Tell what the system refuses when a path is written as one sentence.

    Raises
    ------
    StorageError
        In place of every OSError.
    """
    try:
        yield
    except OSError as fault:
        expected = _EXPECTED.get(fault.errno or 0, "a place that can be written: choose another")
        reason = (fault.strerror or str(fault)).lower()
        raise StorageError(f"{path}: cannot be written, {reason}: expected {expected}") from fault


def write_bytes(path: Path, content: bytes, to_disk: bool = False) -> None:
    """Write a file whole or not at all; ``to_disk``: outlive a power cut from then on.

    Raises
    ------
    StorageError
        When the system refuses; what was there before is left.
    """
    scratch = path.with_name(f".{path.name}.{os.getpid()}.tmp")
    with told(path):
        try:
            scratch.write_bytes(content)
            if to_disk:
                _sync(scratch)
            os.replace(scratch, path)
            if to_disk:
                _sync(path.parent)
        except BaseException:
            with suppress(OSError):
                scratch.unlink(missing_ok=True)
            raise


def write_text(path: Path, content: str) -> None:
    """Write a text file as `write_bytes` does."""
    write_bytes(path, content.encode())


def write_arrays(
    path: Path, arrays: Mapping[str, npt.ArrayLike], to_disk: bool = False, packed: bool = False
) -> None:
    """Write an .npz as `write_bytes` does; the same arrays give the same bytes."""
    write_bytes(path, to_bytes(arrays, packed), to_disk)


class ToDisk:
    """Brings written files to the disk, every `INTERVAL` seconds and when told to."""

    def __init__(self) -> None:
        self._waiting: dict[Path, None] = {}
        self._last = monotonic()

    def wrote(self, path: Path) -> None:
        """Remember a file that was written, and bring all to the disk when it is time."""
        self._waiting[path] = None
        if monotonic() - self._last > INTERVAL:
            self.sync()

    def sync(self) -> None:
        """Bring all that was written since, and the names of the files, to the disk."""
        folders = {path.parent: None for path in self._waiting}
        for path in [*self._waiting, *folders]:  # one system call a file
            with told(path):
                _sync(path)
        self._waiting.clear()
        self._last = monotonic()


def _sync(path: Path) -> None:
    handle = os.open(path, os.O_RDONLY)
    try:
        os.fsync(handle)
    except OSError as fault:
        # Some file systems of networks do not know it for folders.
        if fault.errno != errno.EINVAL:
            raise
    finally:
        os.close(handle)
