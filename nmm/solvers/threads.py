"""One thread of dense linear algebra while a run goes on."""

import ctypes
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from importlib import import_module
from typing import Any

LINKED = ("scipy.linalg.cython_blas", "numpy.linalg._umath_linalg")
"""Compiled modules that are linked to the OpenBLAS of scipy and of numpy."""
VERBS = ("set", "get")


@contextmanager
def one_thread() -> Iterator[None]:
    """Keep OpenBLAS, scipy's and numpy's, from starting threads.

    Fronts are too small for them (6 times slower), and sums over parts that threads choose differ
    in their last digits with the number of threads.
    """
    controls = _thread_controls()
    before = [getter() for _, getter in controls]
    for setter, _ in controls:
        setter(1)
    try:
        yield
    finally:
        for (setter, _), count in zip(controls, before, strict=True):
            setter(count)


@cache
def _thread_controls() -> list[tuple[Any, Any]]:
    """Setter and getter of the number of threads in scipy's and numpy's OpenBLAS, where known."""
    found = (_thread_control(str(import_module(name).__file__)) for name in LINKED)
    return [control for control in found if control is not None]


def _thread_control(file: str) -> tuple[Any, Any] | None:
    """Setter and getter in the OpenBLAS that a compiled module is linked to."""
    try:
        library = ctypes.CDLL(file)
    except OSError:
        return None
    for name in ("scipy_openblas_{}_num_threads", "openblas_{}_num_threads"):
        for suffix in ("", "64_"):
            try:
                setter, getter = (getattr(library, name.format(v) + suffix) for v in VERBS)
                return setter, getter
            except AttributeError:
                continue
    return None
