"""Soft ground on rock between free fields: its response spectrum beside that of a shear column."""

from pathlib import Path

import numpy as np

import nmm
from nmm.effects.motion.record import corrected
from nmm.results.monitor_spectrum import monitor_spectrum
from nmm.results.response_spectrum import response_spectrum

FOLDER = Path(__file__).parents[2] / "examples/shaken_ground"
PERIODS = np.geomspace(0.1, 3.0, 40)  # s
TRAVEL = 30.0 / 300.0  # s, from the rock to the surface
IMPEDANCE = (2000 * 300) / (2400 * 1200)  # of soil over that of rock


def column(times):
    """Acceleration (m/s2) of the surface of a shear column on rock (d'Alembert).

    What enters is ``2 / (1 + a)`` of the wave, the surface doubles it, and each echo comes back
    from the rock as ``-(1 - a) / (1 + a)`` of what went down.
    """
    sample, share = np.loadtxt(FOLDER / "record.txt").T
    wave = corrected(sample, 0.5 * 9.80665 * share, "displacement")
    echo, found = -(1 - IMPEDANCE) / (1 + IMPEDANCE), np.zeros(len(times))
    for number in range(40):  # 0.65^40 is 4e-8
        late = times - (2 * number + 1) * TRAVEL
        found += echo**number * np.interp(late, sample, wave, left=0.0, right=0.0)
    return 4 / (1 + IMPEDANCE) * found


def test_ground_between_free_fields_has_the_spectrum_of_a_shear_column():
    run = nmm.run(nmm.read_scene(FOLDER / "ground.toml"))
    assert run.summary.status == "converged"
    times = np.arange(3201) * 2.5e-3
    exact = response_spectrum(times, column(times), PERIODS).pseudo_acceleration
    # Ten cells in the shortest wave of 0.1 s and forty steps: dispersion of half a percent.
    for name in ("side", "middle"):
        found = monitor_spectrum(run, name, periods=PERIODS).pseudo_acceleration
        np.testing.assert_allclose(found, exact, rtol=0.01)
    # Waves travel up and down in four travel times: the ground swings with 0.4 s.
    assert abs(PERIODS[exact.argmax()] / (4 * TRAVEL) - 1) < 0.05
