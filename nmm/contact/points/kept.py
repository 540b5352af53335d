"""What is made of which contacts there are, kept while they stay: springs, limits, patterns."""

from collections.abc import Callable
from functools import partial
from operator import is_
from typing import Any, Generic, TypeVar

from nmm.contact.points.contact_points import ContactPoints

T = TypeVar("T")


class KeptOfPairs(Generic[T]):
    """A value made of the pairs of contact points, their sizes and their bonds alone.

    It is made anew with other arrays of these, told apart by identity: `tracking.continued` hands
    the same ones on as long as search finds the same pairs.
    """

    def __init__(self, make: Callable[[ContactPoints], T]) -> None:
        self._make = make
        self._known: tuple[tuple[Any, ...], T] | None = None

    def of(self, points: ContactPoints) -> T:
        """Return the value of contact points, made where it is not kept."""
        now = (
            *(points.key, points.edge_a, points.edge_b, points.interface),
            *(points.length, points.spring_factor, points.history["bonded"]),
        )
        known = self._known
        if known is not None and all(map(is_, known[0], now)):
            return known[1]
        value = self._make(points)
        self._known = now, value
        return value


class of_pairs(Generic[T]):
    """A method of contact points whose last value is kept, see `KeptOfPairs`."""

    def __init__(self, make: Callable[[Any, ContactPoints], T]) -> None:
        self.make, self.__doc__ = make, make.__doc__

    def __set_name__(self, owner: type, name: str) -> None:
        self.name = name

    def __get__(self, value: Any, owner: type | None = None) -> Callable[[ContactPoints], T]:
        if value is None:
            return self  # type: ignore[return-value]  # of the class: its documentation
        found = value.__dict__[self.name] = KeptOfPairs[T](partial(self.make, value)).of
        return found
