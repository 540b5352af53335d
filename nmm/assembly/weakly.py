"""Methods handed on without their object: who receives one does not keep it alive."""

from collections.abc import Callable
from typing import Any, ParamSpec, TypeVar
from weakref import ref

Given = ParamSpec("Given")
T = TypeVar("T")


def weakly(method: Callable[Given, T]) -> Callable[Given, T]:
    """Return a bound method that holds its object weakly; another one holds that for as long.

    It is for objects that would hold each other, or themselves: they would be freed by a search for
    cycles alone, which counts objects and not their bytes.

    Raises
    ------
    ReferenceError
        When the method is called after its object is gone.
    """
    bound: Any = method
    held, make = ref(bound.__self__), bound.__func__

    def called(*given: Given.args, **named: Given.kwargs) -> T:
        owner = held()
        if owner is None:
            name = make.__qualname__
            raise ReferenceError(
                f"{name} is asked of an effect that is gone: keep the run, or its plan"
            )
        result: T = make(owner, *given, **named)
        return result

    return called
