"""What is made of a place is made once for all states that are there, and holds no object alive."""

import gc
import weakref
from dataclasses import replace

import numpy as np

from nmm.assembly.kept import forget_kept, kept, kept_of_object, kept_of_place
from nmm.assembly.state import Frames, State


class Counting:
    """An object whose methods count how often they are evaluated."""

    def __init__(self) -> None:
        self.made = 0

    @kept_of_place
    def of_place(self, state: State) -> int:
        self.made += 1
        return self.made

    @kept_of_object
    def of_state(self, state: State) -> int:
        self.made += 1
        return self.made

    @kept(lambda owner, one, other: one + other)
    def of_sum(self, one: int, other: int) -> int:
        self.made += 1
        return self.made


class CountingApart(Counting):
    """One that keeps values of its own beside those of its base."""

    @kept_of_place
    def of_place(self, state: State) -> int:
        return 100 * super().of_place(state)


def state() -> State:
    frames = Frames(np.zeros((1, 2)), np.zeros(1))
    return State(0.0, 0.0, frames, *np.zeros((3, 4)))


def test_other_rates_and_times_are_the_same_place_and_another_deformation_is_not() -> None:
    places, first = Counting(), state()
    later = replace(first, time=1.0, velocity=np.ones(4))
    assert [places.of_place(one) for one in (first, later)] == [1, 1]
    assert places.of_place(replace(first, deformation=np.zeros(4))) == 2
    forget_kept(places)
    assert places.of_place(first) == 3


def test_states_are_told_apart_by_identity() -> None:
    states, first = Counting(), state()
    assert [states.of_state(one) for one in (first, first, replace(first))] == [1, 1, 2]


def test_two_values_are_kept_and_the_third_replaces_the_oldest() -> None:
    sums = Counting()
    assert [sums.of_sum(*pair) for pair in ((1, 2), (1, 1), (2, 1), (4, 4), (1, 2))] == [
        1,
        2,
        1,
        3,
        4,
    ]


def test_a_method_and_the_one_that_it_extends_keep_values_apart() -> None:
    first, places = state(), CountingApart()
    assert [places.of_place(first), places.of_place(first)] == [100, 100]
    assert Counting.of_place(places, first) == 1


def test_an_object_with_kept_values_is_freed_without_a_search_for_cycles() -> None:
    owner, first = Counting(), state()
    owner.of_place(first), owner.of_state(first), owner.of_sum(1, 2)
    gone = weakref.ref(owner)
    gc.disable()
    try:
        del owner
        assert gone() is None
    finally:
        gc.enable()
