"""Caches of values computed from a state, or from an array of it."""

from collections.abc import Callable
from typing import TYPE_CHECKING, Generic, TypeVar

from integration.arrays import Floats

if TYPE_CHECKING:
    from nmm.assembly.state import State

T = TypeVar("T")


class KeptOfStates(Generic[T]):
    """Values of the last two states, told apart by identity."""

    def __init__(self, make: Callable[["State"], T]) -> None:
        self._make = make
        self._known: list[tuple[State, T]] = []

    def of(self, state: "State") -> T:
        """Return the value of a state, computed unless it is kept."""
        for known, value in self._known:
            if known is state:
                return value
        value = self._make(state)
        self._known = [*self._known[-1:], (state, value)]
        return value

    def forget(self) -> None:
        """Drop all values: what they are computed with has changed."""
        self._known = []


class KeptOfPlaces(KeptOfStates[T]):
    """Values that depend on the place of the material alone, not on rates or time."""

    def of(self, state: "State") -> T:
        """Return the value of a state, computed unless one of the same place is kept."""
        frames, deformation = state.frames, state.deformation
        for known, value in self._known:
            if known.frames is frames and known.deformation is deformation:
                return value
        value = self._make(state)
        self._known = [*self._known[-1:], (state, value)]
        return value


class KeptOfInstants(Generic[T]):
    """Values of a place and a time, of which the last two are kept."""

    def __init__(self, make: Callable[["State", float], T]) -> None:
        self._make = make
        self._known: list[tuple[State, float, T]] = []

    def of(self, state: "State", time: float) -> T:
        """Return the value of a state's place at a time, computed unless it is kept."""
        frames, deformation = state.frames, state.deformation
        for known, then, value in self._known:
            if then == time and known.frames is frames and known.deformation is deformation:
                return value
        value = self._make(state, time)
        self._known = [*self._known[-1:], (state, time, value)]
        return value

    def forget(self) -> None:
        """Drop all values: what they are computed with has changed."""
        self._known = []


class KeptOfArray(Generic[T]):
    """The value of an array that is never changed, kept until another array is given."""

    def __init__(self, make: Callable[[Floats], T]) -> None:
        self._make = make
        self._known: tuple[Floats, T] | None = None

    def of(self, array: Floats) -> T:
        """Return the value of an array, computed unless it is the last one."""
        if self._known is None or self._known[0] is not array:
            self._known = array, self._make(array)
        return self._known[1]

    def forget(self) -> None:
        """Drop the value."""
        self._known = None
