"""What joints store above the water, by their shape."""

import numpy as np
import pytest

from nmm.water.joint_balance import JointBalance
from nmm.water.network import JointNetwork


@pytest.mark.parametrize("drawn", [0.0, 1e-3])
def test_a_level_slit_stores_its_length_above_the_water_closed_or_open(drawn):
    # Of height w and length 2, a half of which is a node's: w 2 / 2 / w.
    slit = JointNetwork(np.array([[0, 1]]), np.array([2.0]), 2)
    balance = JointBalance(slit, np.zeros(2), np.array([drawn]), 1.0, 1e-5)
    stored = balance.matrix(balance.opened(np.full((1, 2), 1e-3)), np.array([-1.0, -1.0]), 0.0)
    np.testing.assert_allclose(stored, np.eye(2), rtol=1e-12)
