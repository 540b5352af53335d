"""What contact forces do to unknowns and to bodies, against whole arrays and plain mechanics."""

import numpy as np
from scipy.sparse import csr_array, random_array

from nmm.contact.points.contact_rows import ContactRows
from nmm.contact.solution.turning import moments


def test_forces_on_unknowns_are_products_with_the_transposed_rows() -> None:
    rng = np.random.default_rng(1)
    normal, tangent = (csr_array(random_array((7, 5), density=0.4, rng=rng)) for _ in range(2))
    forces = rng.normal(size=(2, 7))
    expected = normal.toarray().T @ forces[0] + tangent.toarray().T @ forces[1]
    found = ContactRows(normal, tangent, np.zeros((7, 2))).push(*forces)
    np.testing.assert_allclose(found, expected, rtol=1e-14, atol=1e-14)


def test_a_force_at_a_third_of_an_edge_turns_both_bodies_about_their_centres() -> None:
    # At (1, 0) on the edge from (0, 0) to (3, 0): 2 N up and, with the tangent (1, 0), 5 N right.
    start, following = np.array([[0.0, 0], [0, 0], [3, 0]]), np.array([2, 2, 0])
    centre, one = np.array([[0.0, 1], [-1.0, -4]]), np.ones(1)
    found = moments(
        (start, following, np.array([0, 1, 0])),
        centre,
        (np.array([0]), np.array([1]), one / 3, one / 3, np.array([0])),
        (np.array([[0.0, 1]]), 2 * one, 5 * one),
    )
    # Arms (1, -1) and (2, 4): moments 1 * 2 + 1 * 5, and 2 * 2 - 4 * 5 with the sign changed.
    np.testing.assert_allclose(found, [7, 16], rtol=1e-14)
