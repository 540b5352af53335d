"""Tangents of laws at a point, where a contact has slid far and barely slides on."""

import numpy as np
import pytest

from nmm.interfaces.mohr_coulomb import MohrCoulomb


@pytest.mark.parametrize("slid", [0.0, 2e-5, 1e-2])
def test_a_contact_that_barely_slides_answers_by_friction_alone(slid: float) -> None:
    # Coulomb's force k mu g: nothing by more slip, -mu k by more pressure, however far it has slid.
    law = MohrCoulomb(friction_angle=0.6)
    spring, gap = np.array([7e10]), np.array([-1.3e-10])
    mu = np.tan(0.6)
    stretch = -gap * mu * 1.003
    history = {"bonded": np.array([False]), "plastic_slip": np.array([slid])}
    found = law.update(history, gap, slid + stretch, (spring, spring))
    assert found.traction[0, 1] == pytest.approx(7e10 * 1.3e-10 * mu, rel=1e-6)
    # Slips of 0.01 m are rounded to 1e-8 of what the spring is stretched by.
    expected = np.array([[7e10, 0.0], [-mu * 7e10, 0.0]])
    assert found.tangent[0] == pytest.approx(expected, abs=5e-3 * 7e10)
