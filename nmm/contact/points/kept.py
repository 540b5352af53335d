"""What is made of which contacts there are, kept while they stay: springs, limits, patterns."""

from collections.abc import Callable
from operator import is_
from typing import Any, Generic, TypeVar

from nmm.contact.points.contact_points import ContactPoints

T = TypeVar("T")


class of_pairs(Generic[T]):
    """A method made of the pairs of contact points, their sizes and their bonds alone, and kept.

    It is made anew with other arrays of these, told apart by identity: `tracking.continued` hands
    the same ones on as long as search finds the same pairs.
    """

    def __init__(self, make: Callable[[Any, ContactPoints], T]) -> None:
        self.make, self.__doc__ = make, make.__doc__

    def __set_name__(self, owner: type, name: str) -> None:
        self.name = name

    def __get__(self, value: Any, owner: type | None = None) -> Callable[[ContactPoints], T]:
        if value is None:
            return self  # type: ignore[return-value]  # of the class: its documentation
        known: tuple[tuple[Any, ...], T] | None = None

        def of(points: ContactPoints) -> T:
            nonlocal known
            now = (
                *(points.key, points.edge_a, points.edge_b, points.interface),
                *(points.length, points.spring_factor, points.history["bonded"]),
            )
            if known is None or False in map(is_, known[0], now):
                known = now, self.make(value, points)
            return known[1]

        value.__dict__[self.name] = of
        return of
