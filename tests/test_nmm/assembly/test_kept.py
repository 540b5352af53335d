"""What is made of a place is made once for all states that are there."""

from dataclasses import replace

import numpy as np

from nmm.assembly.kept import KeptOfPlaces, KeptOfStates
from nmm.assembly.state import Frames, State


def state() -> State:
    frames = Frames(np.zeros((1, 2)), np.zeros(1))
    return State(0.0, 0.0, frames, *np.zeros((3, 4)))


def test_other_rates_and_times_are_the_same_place_and_another_deformation_is_not() -> None:
    made = []
    places = KeptOfPlaces(lambda at: made.append(at) or len(made))
    first = state()
    later = replace(first, time=1.0, velocity=np.ones(4))
    assert [places.of(one) for one in (first, later)] == [1, 1]
    assert places.of(replace(first, deformation=np.zeros(4))) == 2
    places.forget()
    assert places.of(first) == 3


def test_states_are_told_apart_by_identity() -> None:
    made = []
    states = KeptOfStates(lambda at: made.append(at) or len(made))
    first = state()
    assert [states.of(one) for one in (first, first, replace(first))] == [1, 1, 2]
