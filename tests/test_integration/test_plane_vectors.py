"""Quarter turns of plane vectors."""

import numpy as np

from integration.plane_vectors import QUARTER_TURN, clockwise, counterclockwise


def test_quarter_turns_take_the_first_axis_to_the_second_and_back():
    vectors = np.array([[1.0, 0.0], [0.0, 1.0], [3.0, -2.0]])
    turned = np.array([[0.0, 1.0], [-1.0, 0.0], [2.0, 3.0]])
    assert np.array_equal(counterclockwise(vectors), turned)
    assert np.array_equal(vectors @ QUARTER_TURN.T, turned)
    assert np.array_equal(clockwise(turned), vectors)
