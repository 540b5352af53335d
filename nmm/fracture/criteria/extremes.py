"""Newton's method for the minima of a smooth function of the angle about a tip."""

from collections.abc import Callable

import numpy as np

from integration.arrays import Floats

# Largest number of Newton steps.
STEPS = 40
# Longest step, and step at which the iteration has converged (rad).
LONG, FOUND = 0.2, 1e-14

Slopes = Callable[[Floats], tuple[Floats, Floats]]


def minimum_from(start: Floats, slopes: Slopes) -> Floats:
    """Return the angles (n,) of the minima reached downhill from ``start`` (n,) (rad).

    ``slopes`` returns the first and second derivatives (n,) at angles (n,).
    """
    angle = start.copy()
    for _ in range(STEPS):
        first, second = slopes(angle)
        # With the absolute value a step goes downhill where the function is not convex, too.
        step = -first / np.maximum(np.abs(second), 1e-300)
        step = np.where(first == 0, 0.0, np.clip(step, -LONG, LONG))
        angle = angle + step
        if (np.abs(step) <= FOUND).all():
            break
    return angle
