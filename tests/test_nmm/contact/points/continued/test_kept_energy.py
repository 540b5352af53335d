"""Energy of contacts that end goes on in the springs between the same two bodies."""

import numpy as np

from nmm.contact.points.contact_points import ContactPoints
from nmm.contact.points.continued.kept_energy import kept_energy

BODY = np.array([0, 1, 2])


def points(edges, gap):
    """Contacts of bodies 0, 1, 2 with one edge each."""
    a, b = np.array(edges).T
    m, zero = len(gap), np.zeros(len(gap))
    return ContactPoints.unloaded(
        edge_a=a,
        parameter_a=zero,
        edge_b=b,
        parameter_b=zero,
        normal=np.tile([0.0, 1.0], (m, 1)),
        gap=np.array(gap),
        length=zero,
        spring_factor=np.ones(m),
        interface=np.zeros(m, dtype=int),
        key=np.arange(m),
        state=np.zeros(m, dtype=int),
        history={},
    )


def test_the_spring_that_is_left_holds_what_two_held_and_others_are_as_they_were():
    old = points([(0, 1), (1, 0), (2, 0)], [-3.0, -4.0, -1.0])
    new = points([(0, 1), (2, 0), (1, 2)], [-4.0, -1.0, 2.0])
    found = kept_energy(new, old, lambda some: np.full(len(some), 7.0), BODY)
    # 3^2 + 4^2 = 5^2; gaps count from references a metre further.
    np.testing.assert_allclose(found.gap, [-5.0, -1.0, 2.0], rtol=1e-15)
    np.testing.assert_allclose(found.reference, [1.0, 0.0, 0.0], atol=1e-15)


def test_no_spring_is_made_that_does_not_push():
    old, new = points([(0, 1)], [-3.0]), points([(1, 0)], [0.5])
    found = kept_energy(new, old, lambda some: np.full(len(some), 7.0), BODY)
    np.testing.assert_array_equal(found.gap, [0.5])
