"""What is made of a state or of an array of it, kept while it is asked for again."""

from collections.abc import Callable
from typing import TYPE_CHECKING, Generic, TypeVar

from integration.arrays import Floats

if TYPE_CHECKING:
    from nmm.assembly.motion import State

T = TypeVar("T")


class KeptOfStates(Generic[T]):
    """Values made of the last two states that were asked for, told apart by identity."""

    def __init__(self, make: Callable[["State"], T]) -> None:
        self._make = make
        self._known: list[tuple[State, T]] = []

    def of(self, state: "State") -> T:
        """Return the value of a state, made where it is not kept."""
        for known, value in self._known:
            if known is state:
                return value
        value = self._make(state)
        self._known = [*self._known[-1:], (state, value)]
        return value

    def forget(self) -> None:
        """Keep nothing: what values are made with has changed."""
        self._known = []


class KeptOfPlaces(KeptOfStates[T]):
    """Values made of where material is alone, be its rates or the time what they may."""

    def of(self, state: "State") -> T:
        """Return the value of a state, made where none is kept of the same place."""
        frames, deformation = state.frames, state.deformation
        for known, value in self._known:
            if known.frames is frames and known.deformation is deformation:
                return value
        value = self._make(state)
        self._known = [*self._known[-1:], (state, value)]
        return value


class KeptOfInstants(Generic[T]):
    """Values made of a place and a time, of which the last two are kept."""

    def __init__(self, make: Callable[["State", float], T]) -> None:
        self._make = make
        self._known: list[tuple[State, float, T]] = []

    def of(self, state: "State", time: float) -> T:
        """Return the value of a state's place at a time, made where it is not kept."""
        frames, deformation = state.frames, state.deformation
        for known, then, value in self._known:
            if then == time and known.frames is frames and known.deformation is deformation:
                return value
        value = self._make(state, time)
        self._known = [*self._known[-1:], (state, time, value)]
        return value

    def forget(self) -> None:
        """Keep nothing: what values are made with has changed."""
        self._known = []


class KeptOfArray(Generic[T]):
    """A value made of an array that nobody changes, kept while that array is asked for."""

    def __init__(self, make: Callable[[Floats], T]) -> None:
        self._make = make
        self._known: tuple[Floats, T] | None = None

    def of(self, array: Floats) -> T:
        """Return the value of an array, made where it is not that of the last one."""
        if self._known is None or self._known[0] is not array:
            self._known = array, self._make(array)
        return self._known[1]

    def forget(self) -> None:
        """Keep nothing."""
        self._known = None
