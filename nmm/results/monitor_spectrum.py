"""The response spectrum of a monitor: its acceleration from the history of a run."""

from collections.abc import Mapping

import numpy as np

from integration.arrays import Floats
from nmm.errors import NmmError
from nmm.results.response_spectrum import PERIODS, ResponseSpectrum, response_spectrum
from nmm.results.sink import RESETS, RunData


def monitor_spectrum(
    run: RunData,
    monitor: str,
    axis: str = "x",
    periods: Floats = PERIODS,
    ratio: float = 0.05,
) -> ResponseSpectrum:
    """Return the spectrum of a monitor's motion along "x" or "y", from a run's history.

    The acceleration is that of the parabola through the displacements of three steps that follow
    one another; its error is of order two in the step.

    Raises
    ------
    NmmError
        When the run has no such monitor, or no steps in time.
    """
    column, history = f"monitor:{monitor}:u{axis}", run.history
    if not len(history.get("time", ())):
        raise NmmError(
            f"monitor {monitor}: the run ended before its first step: expected three steps in time "
            "or more: see why in its summary.json"
        )
    if column not in history:
        known = sorted({name.split(":")[1] for name in history if name.startswith("monitor:")})
        raise NmmError(
            f"monitor {monitor}, axis {axis}: no column {column}: expected one of "
            f"{', '.join(known) or 'no monitors'} with axis x or y: correct the name"
        )
    times, way = _from_rest(history, history[column])
    if len(times) < 4 or (np.diff(times) <= 0).any():
        raise NmmError(
            f"monitor {monitor}: {len(times) - 1} steps in time: expected three or more: run a "
            "scene with [inertia]"
        )
    return response_spectrum(times[:-1], _accelerations(times, way), periods, ratio)


def _from_rest(history: Mapping[str, Floats], way: Floats) -> tuple[Floats, Floats]:
    """Times and displacements (n,) from the start; of stages at rest before it the last state."""
    times = history["time"]
    if times[0] > 0:
        return np.append(0.0, times), np.append(0.0, way)
    begin = int(np.flatnonzero(times <= times[0])[-1])
    times, way = times[begin:], way[begin:].copy()
    resets = np.nan_to_num(history.get(RESETS, np.zeros(0)))[begin : begin + 2]
    if resets.any() and resets[0] != resets[-1]:
        way[0] = 0.0  # displacements count from the state at rest
    return times, way


def _accelerations(times: Floats, way: Floats) -> Floats:
    """Accelerations (n - 1,) at all times but the last of displacements (n,) that begin at rest."""
    steps = np.diff(times)
    speed = np.diff(way) / steps
    inside = 2 * np.diff(speed) / (steps[1:] + steps[:-1])
    return np.concatenate([[2 * speed[0] / steps[0]], inside])
