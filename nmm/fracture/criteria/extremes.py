"""Newton's method for the angles where a smooth function about a tip is largest or least."""

from collections.abc import Callable

import numpy as np

from integration.arrays import Floats

# Steps of Newton's method; each doubles the digits once it is near.
STEPS = 40
# Longest step (rad), and step below which an angle is found.
LONG, FOUND = 0.2, 1e-14

Slopes = Callable[[Floats], tuple[Floats, Floats]]


def minimum_from(start: Floats, slopes: Slopes) -> Floats:
    """Return the angles (n,) of the minima nearest downhill of ``start`` (n,).

    ``slopes`` returns first and second derivatives (n,) at angles (n,).
    """
    angle = start.copy()
    for _ in range(STEPS):
        first, second = slopes(angle)
        # Where the function is not convex a step goes downhill all the same.
        step = -first / np.maximum(np.abs(second), 1e-300)
        step = np.where(first == 0, 0.0, np.clip(step, -LONG, LONG))
        angle = angle + step
        if (np.abs(step) <= FOUND).all():
            break
    return angle
