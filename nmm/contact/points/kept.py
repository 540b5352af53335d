"""What is made of which contacts there are, kept while they stay: springs, limits, patterns."""

from collections.abc import Callable
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
