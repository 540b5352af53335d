"""Caches of values computed from a state, or from an array of it."""

from collections.abc import Callable, Hashable
from typing import TYPE_CHECKING, ClassVar, Generic, ParamSpec, TypeVar

from integration.arrays import Floats

if TYPE_CHECKING:
    from nmm.assembly.state import Frames, State

Given = ParamSpec("Given")
G = TypeVar("G")
T = TypeVar("T")


class Kept(Generic[Given, T]):
    """Values of what was given last, told apart by a ``key`` of it."""

    most: ClassVar[int] = 2

    def __init__(self, make: Callable[Given, T], key: Callable[Given, Hashable]) -> None:
        self._make, self._key = make, key
        # What was given is held too, so that nothing else takes over its identity.
        self._known: list[tuple[Hashable, object, T]] = []

    def of(self, *given: Given.args, **named: Given.kwargs) -> T:
        """Return the value of what is given, computed unless it is kept."""
        key = self._key(*given, **named)
        for known, _, value in self._known:
            if known == key:
                return value
        value = self._make(*given, **named)
        self._known = [(key, given, value), *self._known][: self.most]
        return value

    def forget(self) -> None:
        """Drop all values: what they are computed with has changed."""
        self._known = []


class KeptOfObject(Generic[G, T]):
    """Values of the last two objects, which are never changed, told apart by identity."""

    def __init__(self, make: Callable[[G], T]) -> None:
        self._make = make
        self._known: list[tuple[G, T]] = []

    def of(self, given: G) -> T:
        """Return the value of an object, computed unless it is kept."""
        for known, value in self._known:
            if known is given:
                return value
        value = self._make(given)
        self._known = [(given, value), *self._known[:1]]
        return value

    def forget(self) -> None:
        """Drop all values: what they are computed with has changed."""
        self._known = []


class KeptOfStates(KeptOfObject["State", T]):
    """Values of the last two states."""


class KeptOfArray(KeptOfObject[Floats, T]):
    """Values of the last two arrays."""


class KeptOfPlaces(Generic[T]):
    """Values that depend on the place of the material alone, not on rates or time."""

    most: ClassVar[int] = 2

    def __init__(self, make: Callable[["State"], T]) -> None:
        self._make = make
        self._known: list[tuple[Frames, Floats, T]] = []

    def of(self, state: "State") -> T:
        """Return the value of the place of a state, computed unless it is kept."""
        frames, deformation = state.frames, state.deformation
        for place, bent, value in self._known:
            if place is frames and bent is deformation:
                return value
        value = self._make(state)
        self._known = [(frames, deformation, value), *self._known][: self.most]
        return value

    def forget(self) -> None:
        """Drop all values: what they are computed with has changed."""
        self._known = []


class KeptOfInstants(Kept[["State", float], T]):
    """Values of a place and a time, of which the last two are kept."""

    def __init__(self, make: Callable[["State", float], T]) -> None:
        super().__init__(make, lambda state, time: (*_place(state), time))


def _place(state: "State") -> tuple[int, int]:
    return id(state.frames), id(state.deformation)
