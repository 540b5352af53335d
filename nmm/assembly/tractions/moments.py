"""Tractions at few points of a face that have the force and the moment of a line."""

import numpy as np

from integration.arrays import Floats, Ints


def with_moment(joint: Ints, length: Floats, line: Floats, stress: Floats) -> Floats:
    """Return stresses (m,) at places (m,) along joints (m) whose moment is that of a line.

    Points at the ends of a joint have more of a moment than what is spread along it: they take the
    part of its slope that gives the same.
    """

    def whole(part: Floats) -> Floats:
        return np.asarray(np.bincount(joint, length * part)[joint], dtype=np.float64)

    total = whole(np.ones_like(line))
    offset, mean = line - whole(line) / total, whole(stress) / total
    spread = np.maximum(whole(offset**2), np.finfo(float).tiny)
    slope = np.minimum(total**3 / 12 / spread, 1.0)
    return np.asarray(mean + slope * (stress - mean))
