"""The length below which places are one: all decisions of a cut are certain above it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from covers.cutting.components import components, unique_rows
from integration.arrays import Floats, Ints

# Steps across the model as a power of two. Doubles hold 2^53: the difference leaves places an
# error of 2^-8 steps and orientation tests one of 2^-5, far below the step that parts points.
STEPS = 46
# Steps are not finer than this many units in the last place of the coordinates.
ULPS = 32


@dataclass(frozen=True)
class Resolution:
    """Coordinates ``(x - centre) / step`` in which points nearer than 1 are one point.

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


def resolution_of(points: Floats) -> Resolution:
    """Return the resolution of a model with the given extreme points.

    The step is 2^-46 of the model's extent, rounded up to a power of two (1.4e-14 to 2.8e-14), and
    at least 32 units in the last place of the largest coordinate: far from the origin the
    coordinates themselves know no more.
    """
    low, high = points.min(axis=0), points.max(axis=0)
    extent = float((high - low).max())
    noise = ULPS * float(np.spacing(np.abs(points).max()))
    step = 2.0 ** np.ceil(np.log2(max(np.ldexp(extent, -STEPS), noise)))
    return Resolution((low + high) / 2, float(step))


def clusters(steps: Floats) -> tuple[Ints, Ints]:
    """First point of each cluster of points within one step of one another, and each's cluster.

    First points of two clusters are more than a step apart.
    """
    from scipy.spatial import cKDTree

    first, group = unique_rows(steps)
    pairs = cKDTree(steps[first]).query_pairs(1.0, output_type="ndarray").reshape(-1, 2)
    near = components(len(first), pairs[:, 0], pairs[:, 1])
    return first[np.unique(near, return_index=True)[1]], near[group]
