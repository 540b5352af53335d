"""One thread of dense linear algebra while a run goes on."""

import ctypes
from functools import cache
from importlib import import_module
from typing import Any

LINKED = ("scipy.linalg.cython_blas", "numpy.linalg._umath_linalg")
"""Compiled modules that are linked to the OpenBLAS of scipy and of numpy."""
VERBS = ("set", "get")


class OneThread:
    """Keeps OpenBLAS, scipy's and numpy's, from starting threads within a ``with``.

    Fronts are too small for them (6 times slower), and sums over parts that threads choose differ
    in their last digits with the number of threads. Entered for each solution, so that it is a
    class: a generator takes twice as long.
    """

    def __enter__(self) -> None:
        counts = [(setter, getter()) for setter, getter in _thread_controls()]
        self._changed = [(setter, count) for setter, count in counts if count != 1]
        for setter, _ in self._changed:
            setter(1)

    def __exit__(self, *_: object) -> None:
        for setter, count in self._changed:
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
