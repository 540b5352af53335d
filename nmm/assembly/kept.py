"""Methods whose last values are kept, told apart by what they are given: a state, an array.

The values are in the dictionary of the object whose method it is, and nothing leads from them back
to it: once a run is dropped it is freed, without a search for cycles. A value that is kept costs
the one call that asks for it.
"""

from collections.abc import Callable, Hashable
from functools import wraps
from typing import TYPE_CHECKING, Any, Concatenate, ParamSpec, TypeVar

from integration.arrays import Floats

if TYPE_CHECKING:
    from nmm.assembly.state import Frames, State

Owner = TypeVar("Owner")
Given = ParamSpec("Given")
G = TypeVar("G")
T = TypeVar("T")

# What names of kept values begin with: no attribute has such a name.
MARK = "kept: "


def kept_of_object(make: Callable[[Owner, G], T]) -> Callable[[Owner, G], T]:
    """A method that keeps its values of the last two objects: states, arrays, which never change.

    They are told apart by identity.
    """
    name = MARK + make.__qualname__

    @wraps(make)
    def of(owner: Owner, given: G) -> T:
        known: tuple[tuple[G, T], ...]
        try:
            known = owner.__dict__[name]
        except KeyError:
            known = ()
        for one, value in known:
            if one is given:
                return value
        value = make(owner, given)
        owner.__dict__[name] = (given, value), *known[:1]
        return value

    return of


def kept_of_place(make: Callable[[Owner, "State"], T]) -> Callable[[Owner, "State"], T]:
    """A method that keeps its values of the last two places of the material.

    It depends on no rates and on no time.
    """
    name = MARK + make.__qualname__

    @wraps(make)
    def of(owner: Owner, state: "State") -> T:
        known: tuple[tuple[Frames, Floats, T], ...]
        try:
            known = owner.__dict__[name]
        except KeyError:
            known = ()
        frames, deformation = state.frames, state.deformation
        for place, bent, value in known:
            if place is frames and bent is deformation:
                return value
        value = make(owner, state)
        owner.__dict__[name] = (frames, deformation, value), *known[:1]
        return value

    return of


def kept(
    key: Callable[Concatenate[Owner, Given], Hashable], most: int = 2
) -> Callable[[Callable[Concatenate[Owner, Given], T]], Callable[Concatenate[Owner, Given], T]]:
    """A method that keeps its last values, told apart by a ``key`` of what it is given.

    A key may have identities of what is given, which is held too: nothing else takes them over.
    """

    def keeping(
        make: Callable[Concatenate[Owner, Given], T],
    ) -> Callable[Concatenate[Owner, Given], T]:
        name = MARK + make.__qualname__

        @wraps(make)
        def of(owner: Owner, /, *given: Given.args, **named: Given.kwargs) -> T:
            now = key(owner, *given, **named)
            known: tuple[tuple[Hashable, object, T], ...]
            try:
                known = owner.__dict__[name]
            except KeyError:
                known = ()
            for one, _, value in known:
                if one == now:
                    return value
            value = make(owner, *given, **named)
            owner.__dict__[name] = (now, given, value), *known[: most - 1]
            return value

        return of

    return keeping


def place_and_time(owner: Any, state: "State", time: float) -> tuple[int, int, float]:
    """A key of `kept`: where the material is, and when."""
    return id(state.frames), id(state.deformation), time


def forget_kept(owner: object) -> None:
    """Drop all kept values of an object: what they are made with has changed."""
    for name in [name for name in owner.__dict__ if name.startswith(MARK)]:
        del owner.__dict__[name]
