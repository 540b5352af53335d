"""Products of plane vectors, row by row."""

import numpy as np

from integration.arrays import Floats


def dot(a: Floats, b: Floats) -> Floats:
    """Scalar products (m,) of vectors (m, 2)."""
    return np.asarray(a[:, 0] * b[:, 0] + a[:, 1] * b[:, 1])


def cross(a: Floats, b: Floats) -> Floats:
    """Turn (m,) of b against a, (m, 2) both: their product and the sine of the angle between."""
    return np.asarray(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])
