"""Response spectra: Nigam and Jennings against exact answers, and of monitors of runs."""

import numpy as np
import pytest

from nmm.errors import NmmError
from nmm.results.monitor_spectrum import monitor_spectrum
from nmm.results.response_spectrum import response_spectrum

R1 = [0, 0.6, 1.8, -1.2, -3.0, 0.9, 3.4, 2.1, -0.8, -3.6, -1.5, 2.4, 1.1, -2.2, 0.4, 1.6, -0.9]
R1 = np.array([*R1, -0.5, 0.3, -0.1, 0])


def finely(step):
    """The record, sampled finer: the same function, but answers are seen at more times."""
    times = np.arange(round(2 / step) + 1) * step
    return times, np.interp(times, np.arange(21) * 0.1, R1)


@pytest.mark.parametrize(
    ("period", "ratio", "displacement", "pseudo", "absolute"),
    [
        (0.5, 0.05, 0.08199225, 12.947697, 13.016183),
        (0.3, 0.0, 0.02778873, (2 * np.pi / 0.3) ** 2 * 0.02778873, None),
    ],
)
def test_one_oscillator_has_the_exact_largest_answers(
    period, ratio, displacement, pseudo, absolute
):
    found = response_spectrum(*finely(0.001), np.array([period]), ratio)
    # Largest at samples 1 ms apart: w^2 dt^2 / 8 lower at most.
    assert found.displacement[0] == pytest.approx(displacement, rel=1e-4)
    assert found.pseudo_acceleration[0] == pytest.approx(pseudo, rel=1e-4)
    if absolute is not None:
        assert found.absolute_acceleration[0] == pytest.approx(absolute, rel=1e-4)
    else:
        assert found.absolute_acceleration == pytest.approx(found.pseudo_acceleration)


def test_stiff_oscillators_feel_the_ground_and_soft_ones_stay_where_they_are():
    found = response_spectrum(*finely(0.001), np.array([0.01, 200.0]), 0.05)
    assert found.absolute_acceleration[0] == pytest.approx(np.abs(R1).max(), rel=0.02)
    way = 0.204  # of the ground at the end, with its speed of 0.08 m/s
    assert found.displacement[1] > way


def test_samples_need_not_be_even():
    times, values = finely(0.001)
    kept = np.union1d(np.arange(0, 2001, 100), np.arange(3, 2000, 7))
    uneven = response_spectrum(times[kept], values[kept], np.array([0.5]))
    even = response_spectrum(times, values, np.array([0.5]))
    assert uneven.displacement == pytest.approx(even.displacement, rel=1e-3)


@pytest.mark.parametrize("ratio", [0.0, 0.05, 0.4])
def test_a_short_shock_is_answered_after_it(ratio):
    """Of an impulse I the way is ``I / w exp(-z a / sqrt(1 - z^2))``, a the angle of cosine z.

    Whatever the longest period of the spectrum: answers after the shaking were seen at fortieths
    of it alone, and of those that are an eighth of it or less little was left.
    """
    periods = np.array([0.08, 0.1, 0.125, 0.2, 0.25, 0.3, 0.5, 1.0, 5.0])
    shock = np.array([0.0, 5e-5, 1e-4]), np.array([0.0, 1e4, 0.0])
    angle, root = np.arccos(ratio), np.sqrt(1 - ratio**2)
    exact = 0.5 * periods / 2 / np.pi * np.exp(-ratio / root * angle)
    found = response_spectrum(*shock, periods, ratio)
    # The mass hardly moves while the shock lasts: (w t)^2 / 24 and w t z of it.
    assert found.displacement == pytest.approx(exact, rel=5e-3)


@pytest.mark.parametrize("period", [0.04, 0.07, 0.2, 1.3])
@pytest.mark.parametrize("ratio", [0.0, 0.05])
def test_answers_between_coarse_samples_are_seen(period, ratio):
    """The record in its own 21 samples of 0.1 s is the same function as in 2001."""
    coarse = response_spectrum(*finely(0.1), np.array([period]), ratio)
    fine = response_spectrum(*finely(0.0005), np.array([period]), ratio)
    assert coarse.displacement == pytest.approx(fine.displacement, rel=0.0124)
    assert coarse.absolute_acceleration == pytest.approx(fine.absolute_acceleration, rel=0.0124)


@pytest.mark.parametrize("beat", [0.3, 0.9, 1.1, 2.7])
def test_ground_that_swings_harmonically_is_answered_as_its_closed_form_says(beat):
    """Undamped from rest: ``u = A / (w^2 - W^2) (sin W t - W / w sin w t)``, over ten periods."""
    period = 0.5
    w, forced = 2 * np.pi / period, beat * 2 * np.pi / period
    times = np.linspace(0, 5.0, 20001)
    exact = (np.sin(forced * times) - beat * np.sin(w * times)) / (w**2 - forced**2)
    speed = (forced * np.cos(forced * 5) - forced * np.cos(w * 5)) / (w**2 - forced**2)
    swings_on = np.hypot(exact[-1], speed / w)
    found = response_spectrum(times, np.sin(forced * times), np.array([period]), 0.0)
    # Lines between samples leave (W dt)^2 / 12 of the shaking.
    assert found.displacement[0] == pytest.approx(max(np.abs(exact).max(), swings_on), rel=1e-5)


class Shaken:
    """A run whose monitor moves as the record says."""

    def __init__(self, step):
        times, values = finely(step)
        speed = np.concatenate([[0], np.cumsum((values[1:] + values[:-1]) / 2 * step)])
        more = speed[:-1] * step + step**2 * (2 * values[:-1] + values[1:]) / 6
        way = np.concatenate([[0], np.cumsum(more)])
        self.history = {"time": times[1:], "monitor:base:ux": way[1:]}


def test_the_spectrum_of_a_monitor_is_that_of_its_acceleration():
    found = monitor_spectrum(Shaken(0.005), "base", periods=np.array([0.3, 0.5, 1.0]))
    exact = response_spectrum(*finely(0.001), np.array([0.3, 0.5, 1.0]))
    assert found.pseudo_acceleration == pytest.approx(exact.pseudo_acceleration, rel=5e-3)


def test_a_run_without_a_step_is_refused_as_such():
    """Its history has no column of a monitor, whatever the monitors of its scene."""
    ended = Shaken(0.1)
    ended.history = {"time": np.zeros(0), "step": np.zeros(0)}
    with pytest.raises(NmmError, match="the run ended before its first step"):
        monitor_spectrum(ended, "base")


def test_wrong_names_and_numbers_are_refused():
    with pytest.raises(NmmError, match="no column monitor:top:ux: expected one of base"):
        monitor_spectrum(Shaken(0.1), "top")
    with pytest.raises(NmmError, match="ratio 1"):
        response_spectrum(*finely(0.1), np.array([1.0]), 1.0)
