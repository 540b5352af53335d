"""The lattice of all lines of a cut: integer coordinates in which every decision is certain."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats, Ints

# Steps across the model as a power of two. Doubles hold 2^53: the difference leaves orientation
# tests on lattice points an error of 2^-6 steps, far below the 0.75 steps that lines keep apart.
STEPS = 46
# Steps are not finer than this many units in the last place of the coordinates.
ULPS = 32


@dataclass(frozen=True)
class Lattice:
    """Points ``centre + step * (i, j)``.

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
        """Nearest lattice points (n, 2) as whole numbers of steps in floating point."""
        return np.rint((points - self.centre) / self.step)

    def points(self, steps: Floats) -> Floats:
        """Points (n, 2) at any number of steps, m."""
        return self.centre + steps * self.step


def lattice_of(points: Floats) -> Lattice:
    """Return the lattice for a model with the given extreme points.

    The step is 2^-46 of the model's extent, rounded up to a power of two (1.4e-14 to 2.8e-14), and
    at least 32 units in the last place of the largest coordinate: far from the origin the
    coordinates themselves know no more.
    """
    low, high = points.min(axis=0), points.max(axis=0)
    extent = float((high - low).max())
    noise = ULPS * float(np.spacing(np.abs(points).max()))
    step = 2.0 ** np.ceil(np.log2(max(np.ldexp(extent, -STEPS), noise)))
    return Lattice((low + high) / 2, float(step))


def unique_rows(points: Floats) -> tuple[Ints, Ints]:
    """First occurrence of each distinct row, in order of occurrence, and the row of each point."""
    order = np.lexsort((points[:, 1], points[:, 0]))
    ordered = points[order]
    new = np.ones(len(points), dtype=bool)
    new[1:] = (ordered[1:] != ordered[:-1]).any(axis=1)
    first = order[new]  # the sort is stable: the first of each group is its first occurrence
    group = np.empty(len(points), dtype=np.int64)
    group[order] = np.cumsum(new) - 1
    by_occurrence = np.argsort(first)
    rank = np.empty(len(first), dtype=np.int64)
    rank[by_occurrence] = np.arange(len(first))
    return first[by_occurrence], rank[group]
