"""Products and quarter turns of plane vectors, row by row."""

import numpy as np

from integration.arrays import Floats, columns

# Turns columns by 90 degrees, counter-clockwise.
QUARTER_TURN = np.array([[0.0, -1.0], [1.0, 0.0]])


def dot(a: Floats, b: Floats) -> Floats:
    """Scalar products (m,) of vectors (m, 2)."""
    return np.asarray(a[:, 0] * b[:, 0] + a[:, 1] * b[:, 1])


def cross(a: Floats, b: Floats) -> Floats:
    """Turn (m,) of b against a, (m, 2) both: their product and the sine of the angle between."""
    return np.asarray(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])


def counterclockwise(vectors: Floats) -> Floats:
    """Return vectors (m, 2) turned by 90 degrees: (1, 0) gives (0, 1)."""
    return columns(-vectors[:, 1], vectors[:, 0])


def clockwise(vectors: Floats) -> Floats:
    """Return vectors (m, 2) turned by -90 degrees: (0, 1) gives (1, 0)."""
    return columns(vectors[:, 1], -vectors[:, 0])
