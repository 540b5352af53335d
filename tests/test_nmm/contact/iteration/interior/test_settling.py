"""From which points of an interior point's path Newton's method on springs is tried."""

from types import SimpleNamespace

import numpy as np

from nmm.contact.iteration.interior.settling import Settling

CONTACTS = 1000


def tried(paths, share):
    """Which points, given by the contacts that are open there, Newton's method is tried from."""
    settling = Settling(share)
    found = []
    for opened in paths:
        is_open = np.isin(np.arange(CONTACTS), opened)
        springs = SimpleNamespace(states=lambda at, is_open=is_open: (is_open, ~is_open & False))
        sides = SimpleNamespace(springs=springs)
        found.append(settling.seen(sides, SimpleNamespace(increment=None)))
    return found


def test_newton_is_tried_once_from_states_that_stay():
    # All change at first, none from then on: what failed from these states fails again.
    assert tried([[1], [1], [1], [1]], 1e-3) == [False, True, False, False]


def test_newton_is_tried_again_once_others_have_changed_and_come_to_rest():
    # Two of 2 000 states change, which may; the next try waits until a quarter of two change.
    paths = [[1], [2], [3, 4], [3, 4], [3, 4]]
    assert tried(paths, 1e-3) == [False, True, False, True, False]
