"""Jumps of speed of ground whose way is given: by a history, a field, or places of a record."""

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Floats
from nmm.effects.base import Instant, Setup
from nmm.effects.motion.record import Axis

if TYPE_CHECKING:
    from nmm.scene.actions import SupportTable

HALF = 0.5
"""Samples of a smooth way, twelve a period, turn a corner of this share of the largest speed."""

AT_START = 1e-6
"""Share of the run after which the speed of the ground is its first, with steps by an error."""

PARTS = 50
"""Parts of the run whose mean speeds tell how fast a field moves."""


def jumps_of_way(
    setup: Setup,
    support: "SupportTable",
    ground: Callable[[Instant], Floats],
    axis: int,
    speed: float,
) -> list[tuple[float, float]]:
    """Return times (s) at which the speed of the ground jumps along an axis, and by how much (m/s).

    The start, and the sharpest corner after it, of supports of whole blocks alone: the edge of a
    body that sets out at once sends a wave into it.

    Parameters
    ----------
    setup, support
        The scene at the start of the run, and the support.
    ground
        Its displacement (2,) or (m, 2) at an instant (m).
    axis
        Along x (0) or y (1).
    speed
        Mean one of the bodies at the start (m/s).
    """
    duration = setup.scene.duration
    name: Axis = "x" if axis == 0 else "y"
    whole = support.point is None and support.segment is None
    if duration is None or not whole or name not in support.fix:
        return []
    step = setup.formulation.integrator.step
    first = AT_START * duration if step == "auto" else min(step, duration)
    corners = _corners(setup, support, name)
    samples = np.linspace(0.0, duration, PARTS + 1) if support.field is not None else corners
    within = samples[(samples > 0) & (samples < duration)]
    times = np.unique(np.concatenate([[0.0, first, duration], within]))
    way = [np.mean(np.atleast_2d(ground(Instant(time, 1.0)))[:, axis]) for time in times]
    speeds = np.diff(way) / np.diff(times)
    change = np.diff(np.append(speed, speeds))
    told = np.isin(times[:-1], np.append(0.0, corners))
    told &= np.abs(change) > HALF * np.abs(speeds).max()
    found = [(float(times[i]), float(change[i])) for i in np.flatnonzero(told)]
    later = sorted((one for one in found if one[0] > 0), key=lambda one: -abs(one[1]))
    # Of many corners the sharpest says enough.
    return [one for one in found if one[0] == 0] + later[:1]


def _corners(setup: Setup, support: "SupportTable", axis: "Axis") -> Floats:
    """Times at which the speed of the ground may jump after the start (s)."""
    found = [time for time, _ in support.history or ()]
    if axis in support.motion:
        record = setup.scene.records[support.motion[axis]]
        found += list(record.times_and_values[0])
    return np.array(found, dtype=float)
