"""The resolution of a cut: the length below which points are merged.

Above it all geometric predicates of a cut are certain.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from covers.cutting.components import components, unique_rows
from integration.arrays import Floats, Ints

# Steps across the model, as a power of two. Doubles have 53 bits: the rest leaves an error of 2^-8
# steps to coordinates, and of 2^-5 to orientation tests, far below the distance of points.
STEPS = 46
# A step is at least so many units in the last place of the coordinates.
ULPS = 32
# ... and as many times the rounding of coordinates that came from elsewhere: what lies on a line
# there, to the last place or two, is on it.
GIVEN = 8


@dataclass(frozen=True)
class Resolution:
    """Coordinates ``(x - centre) / step``, in which points nearer than 1 are merged.

    Attributes
    ----------
    centre : (2,)
        middle of the model, m.
    step : float
        a power of two, m.
    """

    centre: Floats
    step: float

    def steps(self, points: Floats) -> Floats:
        """Coordinates (n, 2) of points in steps."""
        return np.asarray((points - self.centre) / self.step)

    def points(self, steps: Floats) -> Floats:
        """Points (n, 2) from their coordinates in steps, m."""
        return np.asarray(self.centre + steps * self.step)


def resolution_of(points: Floats, rounding: float = 0.0) -> Resolution:
    """Return the resolution of a model with the given extreme points.

    The step is 2^-46 of the extent of the model, rounded up to a power of two (1.4e-14 to 2.8e-14),
    and at least 32 units in the last place of the largest coordinate, as far from the origin
    coordinates are no more accurate. Of coordinates that were moved here from far away ``rounding``
    (m) is the unit in their last place there, and the step at least eight of it.
    """
    low, high = points.min(axis=0), points.max(axis=0)
    extent = float((high - low).max())
    noise = max(ULPS * float(np.spacing(np.abs(points).max())), GIVEN * rounding)
    step = 2.0 ** np.ceil(np.log2(max(np.ldexp(extent, -STEPS), noise)))
    return Resolution((low + high) / 2, float(step))


def clusters(steps: Floats) -> tuple[Ints, Ints]:
    """Return the first point of each cluster of points within a step, and clusters (n,).

    The first points of clusters are more than a step apart.
    """
    from scipy.spatial import cKDTree

    first, group = unique_rows(steps)
    pairs = cKDTree(steps[first]).query_pairs(1.0, output_type="ndarray").reshape(-1, 2)
    near = components(len(first), pairs[:, 0], pairs[:, 1])
    return first[np.unique(near, return_index=True)[1]], near[group]
