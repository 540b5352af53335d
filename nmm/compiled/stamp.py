"""What the compiled code of a kernel was made of: its own code, what it calls, values it names.

Compiled code takes in the kernels that it calls and the values that it names. The stamp of a kernel
changes with any of them, and with the modules that kernels stand in, which compiled code loads:
code kept on disk is never that of an earlier version. It is taken from what Python has read and not
from files, which may have changed since.
"""

import hashlib
import pickle
from collections.abc import Iterator
from functools import cache, partial
from inspect import unwrap
from types import CodeType, ModuleType
from typing import Any

KNOWN = frozenset({"math", "numpy"})
"""Modules whose functions are numba's own."""


class Compilable(partial[Any]):
    """A function in Python, and what numba is told of it."""

    python: Any
    options: dict[str, Any]


def stamp(kernel: Compilable) -> str:
    """Return the digest of all that numba reads when it compiles the kernel."""
    found, left = {kernel}, [kernel]
    while left:
        new = _own(left.pop())[1] - found
        found |= new
        left += new
    own = sorted(_own(one)[0] for one in found)
    return hashlib.sha256("".join(own).encode()).hexdigest()[:16]


@cache
def _own(kernel: Compilable) -> tuple[str, frozenset[Compilable]]:
    """Digest of a kernel's own code and of the values it names, and the kernels it names."""
    python, called, values = kernel.python, set(), []
    for name, value in _named(python):
        if isinstance(value, Compilable):
            called.add(value)
        else:
            values.append((name, repr(_told(value))))
    # Compiled code names the modules of what it calls.
    place = python.__module__, python.__qualname__
    words = place, kernel.options, _words(python.__code__), python.__defaults__, sorted(values)
    return hashlib.sha256(repr(words).encode()).hexdigest(), frozenset(called)


def _named(python: Any) -> Iterator[tuple[str, Any]]:
    """Values of other places that a function names, and those of modules that it names."""
    code, there = python.__code__, python.__globals__
    names = _names(code)
    cells = python.__closure__ or ()
    yield from zip(code.co_freevars, (cell.cell_contents for cell in cells), strict=True)
    for name in names & there.keys():
        yield name, there[name]
        if isinstance(there[name], ModuleType) and there[name].__name__ not in KNOWN:
            yield from _named_inside(there[name], names)


def _named_inside(module: ModuleType, names: set[str]) -> Iterator[tuple[str, Any]]:
    """Values of a module by these names; all its functions where it makes some when asked."""
    inside = vars(module)
    yield from ((name, inside[name]) for name in names & inside.keys())
    if "__getattr__" in inside:
        own = (one for one in inside.values() if getattr(one, "__module__", "") == module.__name__)
        yield from ((one.__name__, one) for one in own if callable(one))


def _names(code: CodeType) -> set[str]:
    inner = (_names(each) for each in code.co_consts if isinstance(each, CodeType))
    return set(code.co_names).union(*inner)


def _words(code: CodeType) -> tuple[object, ...]:
    """What a function does, on whatever lines it stands."""
    given = (_words(each) if isinstance(each, CodeType) else each for each in code.co_consts)
    return code.co_code, code.co_names, code.co_varnames, code.co_freevars, *given


def _told(value: Any) -> object:
    """Words for a value that are the same in every process."""
    if isinstance(value, type | ModuleType):
        place = getattr(value, "__module__", "")
        return place, value.__name__, getattr(value, "_fields", ())
    if callable(value):
        code = getattr(unwrap(value), "__code__", None)
        return _words(code) if code else getattr(value, "__name__", "")
    try:
        return pickle.dumps(value)
    except (pickle.PicklingError, TypeError, AttributeError):  # nothing that numba takes in
        return type(value).__name__
