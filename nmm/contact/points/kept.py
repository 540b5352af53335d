"""What is made of which contacts there are, kept while they stay: springs, limits, patterns."""

from collections.abc import Callable
from functools import wraps
from operator import is_
from typing import Any, TypeVar

from nmm.assembly.kept import MARK
from nmm.contact.points.contact_points import ContactPoints

Owner = TypeVar("Owner")
T = TypeVar("T")


def of_pairs(make: Callable[[Owner, ContactPoints], T]) -> Callable[[Owner, ContactPoints], T]:
    """A method made of the pairs of contact points, their sizes and their bonds alone, and kept.

    It is made anew with other arrays of these, told apart by identity: `tracking.continued` hands
    the same ones on as long as search finds the same pairs. The value is in the dictionary of the
    object whose method it is, as those of `nmm.assembly.kept` are.
    """
    name = MARK + make.__qualname__

    @wraps(make)
    def of(owner: Owner, points: ContactPoints) -> T:
        now = (
            *(points.key, points.edge_a, points.edge_b, points.interface),
            *(points.length, points.spring_factor, points.history["bonded"]),
        )
        known: tuple[tuple[Any, ...], T]
        try:
            known = owner.__dict__[name]
        except KeyError:
            known = (None,) * len(now), None  # type: ignore[assignment]
        if False in map(is_, known[0], now):
            known = owner.__dict__[name] = now, make(owner, points)
        return known[1]

    return of
