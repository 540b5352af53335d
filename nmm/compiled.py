"""Functions of compiled code, which numba makes, or loads from its cache, when one is first called.

To import numba takes a tenth of a second of processor time, as much as numpy. What reads or checks
a scene calls none of these functions, so that it need not wait for it.
"""

from collections.abc import Callable
from functools import cached_property, partial
from pathlib import Path
from typing import Any, TypeVar, cast

import numpy as np

Function = TypeVar("Function", bound=Callable[..., Any])
OPTIONS: dict[str, Any] = {"cache": True, "no_cfunc_wrapper": True}
"""Kept on disk; called by Python and by each other, not by C, which takes a twentieth more time."""
place = np.uint64
"""Of an entry in an array, without sign: compiled code need not look whether it counts from the
end, which takes as long as the rest of a sparse product."""


class Kernel(partial[Any]):
    """A function that is compiled when it is first called, or when one that calls it is.

    A `functools.partial` hands its call on without a frame of Python; what to is replaced once.
    Compiled code that names a kernel finds what numba made of it by its attributes.
    """

    python: Callable[..., Any]
    loose: frozenset[str]

    @classmethod
    def of(cls, python: Callable[..., Any], loose: frozenset[str] = frozenset()) -> "Kernel":
        """Return the kernel of a function in Python; ``loose``: rules sums need not keep."""
        kernel = cls(lambda *given: kernel.made(*given))
        kernel.python, kernel.loose = python, loose
        return kernel

    @cached_property
    def made(self) -> Callable[..., Any]:
        """What numba makes of the function, which calls go to from now on."""
        from numba import njit

        made: Callable[..., Any] = njit(**OPTIONS, fastmath=set(self.loose))(self.python)
        self.__setstate__((made, (), {}, vars(self)))
        return made

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):  # what copying and inspecting ask for
            raise AttributeError(name)
        return getattr(self.made, name)


def compiled(function: Function) -> Function:
    """Return the function, compiled on its first call and kept on disk."""
    return cast(Function, Kernel.of(function))


def compiled_sums(function: Function) -> Function:
    """Return the same of a function whose sums may be added up in any order: several at once."""
    return cast(Function, Kernel.of(function, frozenset({"reassoc", "contract", "nsz"})))


def kept(function: Callable[..., Any]) -> bool:
    """Whether compiled code of a function is on disk, of this or of an earlier version of it."""
    kernel = cast(Kernel, function)
    file = Path(kernel.python.__code__.co_filename).stem
    folder = Path(kernel.made.stats.cache_path)  # type: ignore[attr-defined]
    return any(folder.glob(f"{file}.{kernel.python.__qualname__}-*.nbi"))
