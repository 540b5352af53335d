"""What is done at a start and an end that no verb needs is left out: a start is mostly imports."""

import atexit
import gc
import os
from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module

UNUSED = frozenset({"ctypeslib", "f2py", "testing"})
"""Parts of numpy that are imported when they are asked for, as scipy asks for all that it finds."""


def without_plugins() -> None:
    """Keep pydantic from looking for plugins in all packages that are installed."""
    os.environ.setdefault("PYDANTIC_DISABLE_PLUGINS", "__all__")


@contextmanager
def without_searches() -> Iterator[None]:
    """Search for no circles of objects: a check ends before there are any to speak of.

    Most of what it makes is made by imports and stays; to look through that is a tenth of it.
    """
    gc.disable()
    try:
        yield
    finally:
        gc.enable()


def without_farewell() -> None:
    """Let the process end without a last search for circles of objects.

    Python looks three times through all that imports have made, a tenth of a second, to free what
    the end of the process frees.
    """
    atexit.register(gc.freeze)


def sparse_matrices() -> None:
    """Import scipy's sparse matrices, half of whose time are parts of numpy not used."""
    import numpy

    names = vars(numpy)
    starred, found = names["__all__"], names["__dir__"]
    names["__all__"] = [name for name in starred if name not in UNUSED]
    names["__dir__"] = lambda: [name for name in found() if name not in UNUSED]
    try:
        import_module("scipy.sparse")
    finally:
        names.update(__all__=starred, __dir__=found)
