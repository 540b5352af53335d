"""What cracks at their toughness free between their lengths, against closed forms."""

import numpy as np
import pytest

from nmm.fracture.growth.growth_path import GrowthPath


def passed(length, factor, stored):
    """Return a path through equilibria under loads of one factor, booked along chords."""
    length, factor, stored = (np.asarray(one, dtype=float) for one in (length, factor, stored))
    chords = np.diff(stored / factor**2) * factor[1:] * factor[:-1]
    return booked(length, factor, stored, np.append(0.0, np.cumsum(chords)), np.zeros(len(length)))


def booked(length, factor, stored, chords, dead):
    """Return a path on whose way what is freed beyond chords (n,) is booked as it is found."""
    path = GrowthPath()
    for a, load, energy, chord, stays in zip(length, factor, stored, chords, dead, strict=True):
        path = path.on(a, load, energy, chord + path.beyond_chords(), stays)
    return path


def along_chords(path):
    """Return what chords say of a path (J)."""
    return float(path.equilibria[-1, 4])


def cantilever(length):
    """Arms of C = s^3 at their toughness: L = 1 / s, so that growth by ds frees 1.5 ds."""
    return passed(length, 1 / length, length / 2)


def test_a_double_cantilever_beam_frees_what_its_toughness_takes():
    path = cantilever(0.5 + 0.1 * np.arange(8))
    found = along_chords(path) + path.beyond_chords()
    assert found == pytest.approx(1.5 * 0.7, rel=1e-5)
    assert along_chords(path) == pytest.approx(1.5 * 0.7, rel=0.01)
    assert along_chords(path) > 1.5 * 0.7 * 1.004


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_four_lengths_have_it_to_the_fourth_order(sign):
    """1 / L = 1 + a^2: the mean of its square over the whole way is known."""
    errors = []
    for pieces in (8, 16):
        a = np.linspace(0, 1, pieces + 1)
        compliance = 2 * (a + 2 * a**3 / 3 + a**5 / 5)
        factor = sign / (1 + a**2)
        path = passed(a, factor, compliance * factor**2 / 2)
        errors.append(abs(along_chords(path) + path.beyond_chords() - 1))
    assert errors[1] < errors[0] / 12
    assert errors[1] < 2e-5


def test_a_ligament_of_a_bent_beam_frees_its_share_until_nothing_is_left():
    """With c left of it L = c^1.5 and C = 1 / c^2: growth by dc frees dc, half of it is stored."""
    length = 0.1 * np.arange(10)
    left = 0.93 - length
    path = passed(length, left**1.5, left / 2)
    found = along_chords(path) + path.beyond_chords() + path.to_the_end(0.93)
    assert found == pytest.approx(0.93, rel=1e-7)


def test_a_station_at_a_short_ligament_does_not_count():
    """The factor is 30 % too large where 0.03 is left; the rest is that of the bent beam above."""
    length = 0.1 * np.arange(10)
    left = 0.93 - length
    factor = left**1.5 * np.where(left < 0.05, 1.3, 1.0)
    path = passed(length, factor, left / 2 * (factor / left**1.5) ** 2)
    wrong, right = (
        along_chords(path) + path.beyond_chords() + path.to_the_end(0.93, short)
        for short in (0.0, 0.05)
    )
    assert right == pytest.approx(0.93, rel=1e-7)
    assert abs(wrong - 0.93) > 0.01


def test_the_first_factor_and_one_that_turns_round_have_no_way_between():
    assert GrowthPath().on(0.5, 2.0, 1.0, 0.0).beyond_chords() == 0.0
    turned = passed([0.5, 0.6], [2.0, -1.0], [1.0, 1.0])
    assert turned.beyond_chords() == 0.0


def test_where_the_factor_does_not_fall_nothing_is_said_of_the_end():
    for last in (1.0, -0.1):
        path = passed([0.0, 0.1], [1.0, last], [1.0, 1.1])
        assert path.to_the_end(0.15) == 0.0


def test_a_crack_that_begins_frees_under_the_load_before():
    """U = C L^2 of C = 1 and 3: at L = 2 it frees 8, whatever the load that comes then."""
    path = GrowthPath().on(0.0, 2.0, 4.0, 0.0).begun_anew()
    assert path.beyond_chords() == 0.0
    chord = (3.0 - 1.0) * 2.0 * 0.5
    path = path.on(0.1, 0.5, 0.75, chord)
    assert chord + path.beyond_chords() == pytest.approx(8.0)


@pytest.mark.parametrize("moment", [0.4, -0.5])
def test_arms_that_a_dead_moment_bends_free_what_their_toughness_takes(moment):
    """Arms of C = s^3 and a moment m at their ends: s L + m = 1, and growth by ds frees 1.5 ds.

    A chord frees the integral of 1.5 (m + L1 s) (m + L2 s).
    """
    s = 0.5 + 0.1 * np.arange(8)
    load = (1 - moment) / s
    powers = [moment**2 * s, moment * s**2 / 2, s**3 / 3]
    one, two, three = (np.diff(power) for power in powers)
    chords = 1.5 * (one + (load[1:] + load[:-1]) * two + load[1:] * load[:-1] * three)
    path = booked(s, load, np.ones(8), np.append(0.0, np.cumsum(chords)), moment / s)
    found = along_chords(path) + path.beyond_chords()
    # Cubics through m / s and log s: 1e-5 with pieces of a tenth to a fifth of the length.
    assert found == pytest.approx(1.5 * 0.7, rel=2e-5)
    assert abs(along_chords(path) / (1.5 * 0.7) - 1) > 1e-3
