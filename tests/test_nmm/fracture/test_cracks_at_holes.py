"""The dislocations that benchmark cracks at holes, against published and limiting values."""

import numpy as np
import pytest

from nmm.verification.continuum import traction_of
from nmm.verification.problems.cracks.hole_with_cracks import HoleWithCracks


@pytest.mark.parametrize(("length", "factor"), [(0.25, 1.0168), (0.5, 1.0582), (1.0, 1.0409)])
def test_two_cracks_have_newmans_intensities(length, factor):
    """Newman (1971), table of collocation, K over sqrt(pi (R + a)); four digits are printed."""
    found = HoleWithCracks(length, both=True).intensity / np.sqrt(np.pi * (1 + length))
    assert found == pytest.approx(factor, abs=2e-4)


@pytest.mark.parametrize("both", [False, True])
def test_a_short_crack_is_one_at_an_edge_under_three_times_the_tension(both):
    """3 x 1.12152 sqrt(pi a); what is missing falls with the length, here 1e-4 radii."""
    found = HoleWithCracks(1e-4, both).intensity / np.sqrt(np.pi * 1e-4)
    assert found == pytest.approx(3 * 1.12152, rel=5e-4)


def test_a_long_crack_is_the_half_of_one_as_long_as_crack_and_hole():
    """sqrt(pi (2 R + a) / 2) for a crack of 200 radii beside the hole; the rest is its size."""
    found = HoleWithCracks(200.0, both=False, points=800).intensity
    assert found == pytest.approx(np.sqrt(np.pi * 202 / 2), rel=2e-3)


@pytest.mark.parametrize("both", [False, True])
def test_the_hole_is_free_and_the_whole_in_balance(both):
    """Tractions on the hole vanish, those on a circle about it add up to nothing: rounding."""
    exact = HoleWithCracks(0.3, both)
    turn = np.linspace(0.1, np.pi - 0.1, 9)
    hole = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    assert np.abs(traction_of(exact.stress(hole), hole)).max() < 1e-12
    turn = 2 * np.pi * np.arange(400) / 400
    around = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    assert np.abs(traction_of(exact.stress(3 * around), around).sum(axis=0)).max() < 1e-10
