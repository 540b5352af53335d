"""What is done at a start and an end that no verb needs is left out: a start is mostly imports."""

import atexit
import dataclasses
import gc
import os
from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module
from typing import Any

UNUSED = frozenset({"ctypeslib", "f2py", "testing"})
"""Parts of numpy that are imported when they are asked for, as scipy asks for all that it finds."""


def late_methods() -> None:
    """Let dataclasses write their methods when they are first called.

    The library compiles the text of six methods a class as it is made; a check makes 237 classes,
    few of which it makes objects of. Versions of Python whose library writes them otherwise are
    left alone.
    """
    library = vars(dataclasses)
    written = library.get("_create_fn")
    if written is None:
        return

    def create(name: str, *given: Any, **options: Any) -> Any:
        method = None

        def late(self: Any, *arguments: Any, **named: Any) -> Any:
            nonlocal method
            if method is None:
                method = written(name, *given, **options)
                for owner in type(self).__mro__:
                    if vars(owner).get(name) is late:
                        setattr(owner, name, method)
            return method(self, *arguments, **named)

        late.__name__ = name
        return late

    library["_create_fn"] = create


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
