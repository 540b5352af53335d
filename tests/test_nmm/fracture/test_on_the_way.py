"""What a crack at its toughness frees between two of its lengths, against closed forms."""

import numpy as np
import pytest

from nmm.fracture.growth.on_the_way import freed_over_chord


def test_a_double_cantilever_beam_frees_what_its_toughness_takes():
    """C = s^3, L = 1 / s: a chord says L1 L2 (s2^3 - s1^3) / 2, right is 3 (s2 - s1) / 2."""
    one, two = 0.567, 0.667
    chord = 1 / (one * two) * (two**3 - one**3) / 2
    found = freed_over_chord([(one, 1 / one), (two, 1 / two)])
    assert found * chord == pytest.approx(1.5 * (two - one), rel=1e-12)
    assert found == pytest.approx(1 / (1 + 0.1**2 / (3 * one * two)), rel=1e-12)


@pytest.mark.parametrize("scale", [1.0, -2.0])
def test_a_third_length_brings_it_from_second_to_third_order(scale):
    """K of a unit grows as exp(a): the mean of exp(2 a) over the piece is known."""
    errors = []
    for piece in (0.4, 0.2):
        lengths = 1 + piece * np.arange(-1, 2)
        stations = [(a, scale * np.exp(-a)) for a in lengths]
        mean = (np.exp(2 * lengths[2]) - np.exp(2 * lengths[1])) / (2 * piece)
        right = np.exp(lengths[1] + lengths[2]) / mean
        errors.append(abs(freed_over_chord(stations) / right - 1))
    assert errors[1] < errors[0] / 7
    assert errors[1] < 1e-3


def test_the_first_factor_and_one_that_turns_round_have_no_way_between():
    assert freed_over_chord([(0.5, 2.0)]) == 1.0
    assert freed_over_chord([(0.5, 2.0), (0.6, -1.0)]) == 1.0
