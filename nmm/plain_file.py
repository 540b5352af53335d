"""Files that may come from anybody: pipes and devices are none, since they need not end."""

import errno
from pathlib import Path


def plain(path: Path) -> Path:
    """Return a path as it is given, unless it leads to what is neither file nor folder.

    Raises
    ------
    OSError
        Before it is opened, which would wait at a pipe and read a device without end.
    """
    if path.exists() and not path.is_file() and not path.is_dir():
        raise OSError(errno.EINVAL, "a pipe or a device, no file", str(path))
    return path
