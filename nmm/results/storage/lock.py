"""One run at a time in a folder: a lock that lives no longer than its process.

The lock is the system's own (flock) on the file `.lock`, so it ends with its process however that
ends. The file says whose it is: process and host. Where the system's lock does not reach, on some
file systems of networks, a file of another host is taken at its word.
"""

import errno
import fcntl
import json
import os
import socket
import time
from contextlib import suppress
from dataclasses import asdict, dataclass
from io import TextIOWrapper
from pathlib import Path

from nmm.errors import StorageError
from nmm.plain_file import plain
from nmm.results.storage.writing import told

TRIES, PAUSE = 5, 0.02  # s; a reader holds the lock for a moment to see whether it is free


@dataclass(frozen=True)
class Owner:
    """Who holds a folder: process, host, and since when."""

    pid: int
    host: str
    since: str

    def __str__(self) -> str:
        return f"process {self.pid} on {self.host} since {self.since}"


class FolderLock:
    """Holds a folder from its making until `release`, or the end of the process.

    Attributes
    ----------
    stale
        Whose lock of a process that is gone was found there, None if there was none.

    Raises
    ------
    StorageError
        When another run holds the folder, or the lock cannot be written.
    """

    stale: Owner | None

    def __init__(self, path: Path) -> None:
        self._path = path
        with told(path):
            self._file = _open_and_lock(path)
            self._file.seek(0)
            self.stale = _parsed(self._file.read())
            here = socket.gethostname()
            if self.stale is not None and self.stale.host != here:
                self._file.close()
                raise StorageError(_in_use(path, self.stale, "cannot be asked from here"))
            me = Owner(os.getpid(), here, time.strftime("%Y-%m-%d %H:%M:%S"))
            self._file.seek(0)
            self._file.truncate()
            self._file.write(json.dumps(asdict(me)) + "\n")
            self._file.flush()

    @property
    def released(self) -> bool:
        """Whether the folder was given free."""
        return self._file.closed

    def release(self) -> None:
        """Give the folder free; a second call does nothing."""
        if not self._file.closed:
            with suppress(OSError):
                self._path.unlink(missing_ok=True)
            with suppress(OSError):
                self._file.close()


def owner(path: Path) -> Owner | None:
    """Return who holds a lock file now; None when it is free or its process is gone."""
    try:
        with plain(path).open() as file:
            found = _parsed(file.read())
            if found is None or found.host != socket.gethostname():
                return found
            return found if not _locked(file, fcntl.LOCK_SH) else None
    except OSError:
        return None


def _open_and_lock(path: Path) -> TextIOWrapper:
    for _ in range(TRIES):
        file = os.fdopen(os.open(path, os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW, 0o666), "r+")
        if _locked(file, fcntl.LOCK_EX):
            # Its former owner may have deleted the file between our opening and our locking it.
            if _same_file(file, path):
                return file
        else:
            other = _parsed(file.read())
            time.sleep(PAUSE)
        file.close()
    raise StorageError(_in_use(path, other, "is still writing"))


def _locked(file: TextIOWrapper, kind: int) -> bool:
    """Try to lock a file; a file system that knows no locks counts as locked by us."""
    try:
        fcntl.flock(file, kind | fcntl.LOCK_NB)
    except OSError as fault:
        return fault.errno not in (errno.EWOULDBLOCK, errno.EACCES)
    return True


def _same_file(file: TextIOWrapper, path: Path) -> bool:
    try:
        return os.path.samestat(os.fstat(file.fileno()), os.stat(path))
    except FileNotFoundError:
        return False


def _parsed(text: str) -> Owner | None:
    try:
        found = json.loads(text)
        return Owner(int(found["pid"]), str(found["host"]), str(found["since"]))
    except (ValueError, KeyError, TypeError):
        return None


def _in_use(path: Path, other: Owner | None, why: str) -> str:
    who = other or "another process"
    return (
        f"{path.parent}: in use by {who}, which {why}: expected a folder of its own for each run: "
        f"choose another folder, or delete {path} once that run has ended"
    )
