"""Functions of compiled code, which numba makes, or takes from disk, when one is first called.

To import numba takes a tenth of a second of processor time, as much as numpy. What reads or checks
a scene calls none of these functions, so that it need not wait for it.
"""

from collections.abc import Callable
from functools import cached_property
from typing import Any, TypeVar, cast

import numpy as np

from nmm.compiled.stamp import Compilable

Function = TypeVar("Function", bound=Callable[..., Any])
LOOSE = dict.fromkeys(("reassoc", "contract", "nsz"), True)
"""Rules that sums need not keep which may be added up in any order."""
place = np.uint64
"""Of an entry in an array, without sign: compiled code need not look whether it counts from the
end, which takes as long as the rest of a sparse product."""


class Kernel(Compilable):
    """A function that is compiled when it is first called, or when one that calls it is.

    A `functools.partial` hands its call on without a frame of Python; what to is replaced once.
    Compiled code that names a kernel finds what numba made of it by its attributes.
    """

    @classmethod
    def of(cls, python: Callable[..., Any], **options: Any) -> "Kernel":
        """Return the kernel of a function in Python; options are those of numba."""
        kernel = cls(lambda *given: kernel.made(*given))
        kernel.python = python
        # Called by Python and by each other, not by C, which takes a twentieth more time.
        kernel.options = {"no_cfunc_wrapper": True, **options}
        return kernel

    @cached_property
    def made(self) -> Any:
        """What numba makes of the function, which calls go to from now on."""
        from numba import njit

        from nmm.compiled.store import KeptCode

        made = njit(**self.options)(self.python)
        made._cache = KeptCode(self)
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
    return cast(Function, Kernel.of(function, fastmath=LOOSE))
