"""Lengths of relaxation's steps, and when it keeps speed."""

from types import SimpleNamespace

import numpy as np
from scipy.sparse import eye_array

from nmm.stepping.drive.equilibrium.pace import LONGER, SHORTER, SHORTEST, Pace

MODEL = SimpleNamespace(mass=eye_array(2))


def test_steps_from_rest_keep_no_speed_and_grow_without_bound():
    pace = Pace(0.1)
    assert not pace.speed(MODEL, np.array([1.0, 2.0])).any()
    pace.lengthen()
    assert pace.length == LONGER * 0.1


def test_after_two_cuts_speed_is_kept_while_kinetic_energy_grows():
    pace = Pace(0.1)
    pace.cut()
    pace.cut()
    grows = [pace.speed(MODEL, np.array([v, 0.0]))[0] for v in (1.0, 2.0, 1.5, 0.5)]
    assert grows == [1.0, 2.0, 0.0, 0.5]  # at rest at the peak, then from there


def test_after_two_cuts_steps_stay_shorter_than_half_of_what_failed():
    pace = Pace(0.1)
    pace.cut()
    pace.cut()
    for _ in range(20):
        pace.lengthen()
    assert pace.length == 0.5 * SHORTER * 0.1


def test_it_ends_where_a_step_of_a_hundredth_of_the_first_fails():
    pace = Pace(0.1)
    while not pace.ends:
        pace.cut()
    assert SHORTER * SHORTEST * 0.1 < pace.length < SHORTEST * 0.1


def test_rest_is_asked_for_after_twice_as_many_steps_each_time():
    pace = Pace(0.1)
    assert [n for n in range(20) if pace.may_ask(n)] == [0, 1, 3, 7, 15]
