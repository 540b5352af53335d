"""The mean force of a spring that pushes alone: work is what it stores, its slope a derivative."""

import numpy as np
import pytest

from nmm.contact.laws.conserving_springs import force_slope, mean_force

STIFFNESS = 3.0
CASES = [(-0.2, -0.5), (-0.5, -0.1), (0.3, -0.4), (-0.4, 0.3), (0.2, 0.5), (0.0, -0.1), (-0.1, 0.0)]


@pytest.mark.parametrize(("start", "end"), CASES)
def test_its_work_is_the_energy_that_it_stores(start, end):
    force = mean_force(*(np.array([one]) for one in (STIFFNESS, start, end)))
    stored = STIFFNESS / 2 * (min(end, 0.0) ** 2 - min(start, 0.0) ** 2)
    assert force[0] * (end - start) == pytest.approx(stored, abs=1e-15)


@pytest.mark.parametrize(("start", "end"), [one for one in CASES if 0.0 not in one])
def test_its_slope_is_its_derivative(start, end):
    h = 1e-6
    low, high = (mean_force(*np.array([[STIFFNESS], [start], [end + d]])) for d in (-h, h))
    slope = force_slope(*np.array([[STIFFNESS], [start], [end]]))
    # differences of rounding over 2e-6
    assert slope == pytest.approx((high - low) / (2 * h), abs=1e-8)
