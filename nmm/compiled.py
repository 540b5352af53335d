"""Functions of compiled code, which numba makes, or loads from its cache, when one is first called.

To import numba takes a tenth of a second of processor time, as much as numpy. What reads or checks
a scene calls none of these functions, so that it need not wait for it.
"""

from collections.abc import Callable
from functools import cached_property, partial
from typing import Any, TypeVar, cast

Function = TypeVar("Function", bound=Callable[..., Any])


class Kernel(partial[Any]):
    """A function that is compiled when it is first called, or when one that calls it is.

    A `functools.partial` hands its call on without a frame of Python; what to is replaced once.
    Compiled code that names a kernel finds what numba made of it by its attributes.
    """

    python: Callable[..., Any]

    @classmethod
    def of(cls, python: Callable[..., Any]) -> "Kernel":
        """Return the kernel of a function in Python."""
        kernel = cls(lambda *given: kernel.made(*given))
        kernel.python = python
        return kernel

    @cached_property
    def made(self) -> Callable[..., Any]:
        """What numba makes of the function, which calls go to from now on."""
        from numba import njit

        made: Callable[..., Any] = njit(cache=True)(self.python)
        self.__setstate__((made, (), {}, vars(self)))
        return made

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):  # what copying and inspecting ask for
            raise AttributeError(name)
        return getattr(self.made, name)


def compiled(function: Function) -> Function:
    """Return the function, compiled on its first call and kept on disk."""
    return cast(Function, Kernel.of(function))
