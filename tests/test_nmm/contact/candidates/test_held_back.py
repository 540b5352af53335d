"""Pairs that a step let through at first stay contacts as long as they push over their edges."""

from types import SimpleNamespace

import numpy as np
import pytest

from integration.polygons import Polygons
from nmm.contact.candidates.held_back import held_back, joined
from nmm.testing.detection.search import polygon_surface

FLOOR = np.array([[0.0, -1.0], [1.0, -1.0], [1.0, 0.0], [0.0, 0.0]])
TOP = 2
"""Edge of the floor from (1, 0) to (0, 0)."""
CORNER = 4
"""Lower left corner of the block upon it."""


def kept(x: float, force: float, joint: bool = False):
    block = np.array([[x, 0.0], [x + 1, 0.0], [x + 1, 1.0], [x, 1.0]])
    surface = polygon_surface(Polygons.from_vertices([FLOOR, block]))
    ends = np.array([CORNER]), np.array([TOP])
    contacts = SimpleNamespace(edge_a=ends[0], edge_b=ends[1], is_joint=np.array([joint]))
    contacts.take = lambda which: SimpleNamespace(edge_a=ends[0][which], edge_b=ends[1][which])
    answer = SimpleNamespace(normal_force=np.array([force]))
    return held_back(ends, SimpleNamespace(contacts=contacts, answer=answer), surface)


@pytest.mark.parametrize("x", [0.0, 0.5, 1.0])
def test_a_pair_that_pushes_over_its_edge_is_a_contact_of_the_next_step(x):
    assert kept(x, -1.0) == (CORNER, TOP)


@pytest.mark.parametrize("given", [(0.5, 0.0), (1.01, -1.0), (-0.01, -1.0), (0.5, -1.0, True)])
def test_what_pushes_no_more_or_has_left_its_edge_or_is_a_joint_is_left_to_search(given):
    assert kept(*given) is None


def test_pairs_of_two_searches_are_those_of_both_and_none_without_any():
    one, other = (np.array([1]), np.array([2])), (np.array([3]), np.array([4]))
    assert joined(None, None) is None
    assert joined(one, None) is one
    assert joined(None, other) is other
    np.testing.assert_array_equal(joined(one, other), [[1, 3], [2, 4]])
