"""The energy that a crack frees on its way from one piece to the next, at its toughness throughout.

With linear matter under loads of one factor L the energy freed by growth da is L^2 g(a) da, where
g is what a unit of the factor frees. Work along a chord, from one factor to the next, frees L1 L2
times the integral of g. But the crack was at its toughness between them too: there
L^2 g is constant, 1 / L goes with the intensity of a unit of the factor, and what is freed is the
integral of g over the mean of 1 / L^2.
"""

from collections.abc import Sequence

import numpy as np

from integration.arrays import Floats

# Gauss points on (0, 1), which have squares of parabolas exactly.
POINTS = (1 + np.array([-1, 0, 1]) * np.sqrt(0.6)) / 2
WEIGHTS = np.array([5.0, 8.0, 5.0]) / 18
Station = tuple[float, float]
"""How far cracks have grown (m), and the load factor at which they are at their toughness."""


def freed_over_chord(stations: Sequence[Station]) -> float:
    """Return what a crack frees over what a chord says, from the last station but one to the last.

    1 / L is linear in the growth between two stations, which a double cantilever beam has exactly;
    with one more before them it is a parabola. Where the factor passes zero it is one.
    """
    length, factor = np.array(stations[-3:]).T
    if len(length) < 2 or not ((factor > 0).all() or (factor < 0).all()):
        return 1.0
    inverse = 1 / factor
    between = _through(length, inverse, length[-2] + POINTS * (length[-1] - length[-2]))
    return float(inverse[-2] * inverse[-1] / (WEIGHTS @ between**2))


def _through(x: Floats, y: Floats, where: Floats) -> Floats:
    """Values at places of the polynomial through two or three points (Newton's form)."""
    first = (y[-1] - y[-2]) / (x[-1] - x[-2])
    found = y[-2] + first * (where - x[-2])
    if len(x) < 3:
        return np.asarray(found)
    earlier = (y[-2] - y[-3]) / (x[-2] - x[-3])
    second = (first - earlier) / (x[-1] - x[-3])
    return np.asarray(found + second * (where - x[-2]) * (where - x[-1]))
