"""Stress that blocks keep beyond that of their law."""

from dataclasses import dataclass
from typing import Self

import numpy as np

from integration.arrays import Floats, Ints
from nmm.assembly.model import Model
from nmm.assembly.stress_points import StressPoints, nearest
from nmm.assembly.transfer.history import nearest_points


@dataclass(frozen=True)
class KeptStress:
    """The stress difference at the points of blocks whose material has changed.

    Attributes
    ----------
    points
        The Q points.
    stress
        (Q, 3) present stress minus that of the new law, in body axes (Pa).
    beside
        (Q, 3) initial stress at the points (Pa).
    """

    points: StressPoints
    stress: Floats
    beside: Floats

    @classmethod
    def none(cls, model: Model) -> Self:
        """Return no stress, at no points."""
        nowhere = np.zeros(len(model.manifold.elements), dtype=bool)
        empty = np.zeros((0, 3))
        return cls(StressPoints.of(model.manifold, nowhere), empty, empty)

    def carried(self, old: Model, new: Model, points: StressPoints) -> Floats:
        """Return the stress (Q, 3) at points of the new model; zero where no block keeps any."""
        if not len(self.points):
            return np.zeros((len(points), 3))
        near = nearest_points(old, self.points, new, points)
        return np.where(near[:, None] < 0, 0.0, self.stress[near])

    def mean(self, model: Model) -> Floats:
        """Return the mean stress (E, 3) of elements (Pa)."""
        found = np.zeros((len(model.manifold.elements), 3))
        if len(self.points):
            elements, means = self.points.means(self.stress)
            found[elements] = means
        return found

    def at(self, elements: Ints, points: Floats) -> Floats:
        """Return the stress (m, 3) of the nearest point in elements (m,); zero without any (Pa)."""
        if not len(self.points):
            return np.zeros((len(elements), 3))
        at = nearest(self.points.rule, elements, points)
        return np.where(at[:, None] < 0, 0.0, self.stress[at])
