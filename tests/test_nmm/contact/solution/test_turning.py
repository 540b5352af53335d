"""What turning bodies owe and where forces should act, against plain mechanics and whole arrays."""

import numpy as np
import pytest
from scipy.sparse import csc_array

from nmm.assembly.moving.moved_bodies import entries
from nmm.contact.solution.turning import foreseen, matters, owed

ONE = np.array([0]), np.array([1])


def test_a_turn_matters_where_turn_times_way_is_a_share_of_the_deepest_gap() -> None:
    # Two bodies, of which one turns by 0.1 on a way of 0.2 m: gaps are off by 2 * 0.1 * 0.2.
    still, turn, way = np.zeros(2), np.array([0.1, 0]), np.array([0.2, 0])
    motions = turn, way, turn, still
    for share, expected in ((0.39, True), (0.41, False)):
        contact = *ONE, np.array([-1.0]), np.array([-0.1])
        assert matters(contact, np.arange(2), motions, share, 0.0) == expected
    open_contact = *ONE, np.zeros(1), np.array([-0.1])
    assert not matters(open_contact, np.arange(2), motions, 1e-9, 1.0)


@pytest.mark.parametrize("gap", [0.0, 1e-19, -1e-19])
def test_rounding_of_gaps_does_not_say_whether_a_turn_matters(gap: float) -> None:
    # By 2 * 0.1 * 0.2 beside a share of 1e-3 of the way of 0.2 m.
    motions = np.array([0.1, 0]), np.array([0.2, 0]), np.array([0.2, 0]), np.zeros(2)
    contact = *ONE, np.array([-1.0]), np.array([gap])
    for share, expected in ((399.0, True), (401.0, False)):
        assert matters(contact, np.arange(2), motions, share, 1e-3) is expected


def test_what_rattles_is_foreseen_to_go_as_far_as_both_steps_agree() -> None:
    flight, last = np.array([1.0, -2.0, 3.0, 0.5]), np.array([0.5, -3.0, -1.0, 0.0])
    rigid = csc_array(np.zeros((4, 6)))
    contact = *ONE, np.array([-1.0]), np.array([-1.0])
    given = entries(rigid.T.tocsr()), contact, (np.arange(2), np.ones(2)), 0.1, 0.0
    turns, way = foreseen((flight, last), *given)
    assert not turns
    np.testing.assert_array_equal(way, [0.5, -2.0, 0.0, 0.0])


def test_bodies_are_given_the_turn_that_a_force_at_their_corner_has_not_made() -> None:
    # Unknowns are rigid motions. A force of 2 N up acts at (1, 0) on bodies centred at (0, 1) and
    # (-1, -4); its rows have pushed both without any moment: 2 N m are owed on the first, whose
    # forces have the sign changed, and 4 N m on the other.
    push = np.array([0.0, -2, 0, 0, 2, 0])
    modes, body = csc_array(np.eye(6)), np.array([0, 0, 1, 1])
    start = np.array([[0.0, 0], [3, 0], [0, 0], [3, 0]])
    edges = start, np.array([1, 0, 3, 2]), body
    third = np.array([1 / 3])
    contacts = np.array([0]), np.array([2]), third, third, np.array([7])
    through = np.array([[0.0, 1]]), np.array([2.0]), np.zeros(1)
    centre, gain = np.array([[0.0, 1], [-1, -4]]), np.array([1.0, 1, 0.5, 1, 1, 0.25])
    found = owed(push, push, entries(modes), edges, centre, contacts, through, gain)
    np.testing.assert_allclose(found, [0, 0, -0.5 * 2, 0, 0, 0.25 * 4], atol=1e-14)
