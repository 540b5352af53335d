"""Compiled code on disk: one file for a kernel and its types of arguments, named by what it is of.

The name holds the stamp of the kernel, the types, the processor and the versions of Python, numba
and numpy: a file that is found is right, and nothing has to be deleted by hand. What an
earlier version left goes as the kernel is kept anew. A file appears whole or not at all, so that
any number of processes may start at once. numba's own store looks at the file of a kernel alone.
"""

import hashlib
import os
import pickle
import sys
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from pathlib import Path
from tempfile import NamedTemporaryFile
from typing import Any, cast

import numpy as np

from nmm.compiled.stamp import Compilable, stamp

PACKAGE = Path(__file__).resolve().parents[1]


class KeptCode:
    """Where numba looks for the compiled code of one kernel, and leaves it."""

    def __init__(self, kernel: Compilable) -> None:
        python = kernel.python
        name = f"{python.__module__}.{python.__qualname__}"
        self._name = name.replace("<", "").replace(">", "")  # no signs of files everywhere
        self._stamp = stamp(kernel)
        self.cache_path = str(folders()[0])  # told by numba's `stats`

    @property
    def holds_any(self) -> bool:
        """Whether there is compiled code of the kernel as it is now, for whatever types."""
        return any(any(one.glob(f"{self._name}-{self._stamp}-*")) for one in folders())

    def load_overload(self, types: Any, target: Any) -> Any:
        """Return what is kept for these types of arguments, or nothing."""
        from numba.core.compiler import CompileResult
        from numba.core.runtime.nrt import rtsys

        # All of numba's types and functions, which `refresh` imports, are for what it compiles.
        rtsys.initialize(target)
        name = self._file(types, target.codegen())
        for folder in folders():
            # Types of arguments may have moved to another module since.
            with suppress(OSError, EOFError, pickle.UnpicklingError, ImportError, AttributeError):
                parts = pickle.loads((folder / name).read_bytes())
                return CompileResult._rebuild(target, *parts)  # type: ignore[no-untyped-call]
        return None

    def save_overload(self, types: Any, made: Any) -> None:
        """Keep what numba has made, in the first folder that can be written to."""
        from numba.core.serialize import dumps

        if made.library.has_dynamic_globals:  # addresses of this process
            return
        name = self._file(types, made.codegen)
        content = dumps(made._reduce())  # type: ignore[no-untyped-call]
        for folder in folders():
            with suppress(OSError):
                _put(folder / name, content)
                self._remove_earlier(folder)
                return

    def _file(self, types: Any, codegen: Any) -> str:
        import numba

        versions = sys.version, numba.__version__, np.__version__
        key = hashlib.sha256(repr((types, codegen.magic_tuple(), versions)).encode()).hexdigest()
        return f"{self._name}-{self._stamp}-{key[:16]}.nbc"

    def _remove_earlier(self, folder: Path) -> None:
        for one in folder.glob(f"{self._name}-*"):
            if not one.name.startswith(f"{self._name}-{self._stamp}-"):
                one.unlink(missing_ok=True)


@cache
def folders() -> tuple[Path, ...]:
    """Where compiled code may lie: in NUMBA_CACHE_DIR; else with the package or with the user."""
    from numba.core import config
    from numba.misc.appdirs import user_cache_dir

    own = f"nmm-{hashlib.sha256(str(PACKAGE).encode()).hexdigest()[:16]}"
    if chosen := config.CACHE_DIR:  # type: ignore[attr-defined]
        return (Path(chosen) / own,)
    user = Path(user_cache_dir("nmm", appauthor=False))  # type: ignore[no-untyped-call]
    return PACKAGE / "__pycache__" / "kernels", user / own


def _put(file: Path, content: bytes) -> None:
    """Write a file that others see whole or not at all."""
    file.parent.mkdir(parents=True, exist_ok=True)
    with NamedTemporaryFile(dir=file.parent, delete=False) as written:
        written.write(content)
    try:
        os.replace(written.name, file)
    except OSError:  # open in another process, on Windows: that one has the same
        os.unlink(written.name)


def kept(function: Callable[..., Any]) -> bool:
    """Whether compiled code of a function as it is now is on disk."""
    return KeptCode(cast(Compilable, function)).holds_any
