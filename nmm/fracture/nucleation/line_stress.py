"""Stress averaged along straight lines through the material of one body."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import shapely
from numpy.polynomial.legendre import leggauss

from integration.arrays import Bools, Floats, Ints
from integration.rules import PointRule
from nmm.assembly.model import Model
from nmm.fracture.acting_stress import StressOn

# Gauss points along a line, as parts of it.
SHARES, LINE_WEIGHTS = (1 + leggauss(8)[0]) / 2, leggauss(8)[1] / 2
# Points nearer to an element than this share of the domain lie in it.
NEAR = 1e-9


@dataclass(frozen=True)
class LineStress:
    """Means along lines through a model."""

    model: Model

    def means(
        self, stress: StressOn, begin: Floats, way: Floats, body: Ints
    ) -> tuple[Floats, Bools]:
        """Return mean stresses (k, 3) in body axes, in Pa, and which lines (k,) stay in their body.

        Parameters
        ----------
        stress
            That acts.
        begin, way
            (k, 2) where each begins in the reference place, and from there to its end (m).
        body
            (k,) of each; what leaves it has no mean.
        """
        points, element = self._located(begin, way, body)
        known = element >= 0
        found = np.zeros((len(points), 3))
        rule = PointRule(points[known], np.ones(int(known.sum())), element[known])
        found[known] = stress(rule)
        mean = np.einsum("q,kqi->ki", LINE_WEIGHTS, found.reshape(-1, len(LINE_WEIGHTS), 3))
        return mean, np.asarray(known.reshape(-1, len(LINE_WEIGHTS)).all(axis=1))

    def stays(self, begin: Floats, way: Floats, body: Ints) -> Bools:
        """Which lines (k,) stay in their body; see `means`."""
        _, element = self._located(begin, way, body)
        return np.asarray((element.reshape(-1, len(LINE_WEIGHTS)) >= 0).all(axis=1))

    def _located(self, begin: Floats, way: Floats, body: Ints) -> tuple[Floats, Ints]:
        """Gauss points (k Q, 2) of lines, and the element of each; -1 where it has none."""
        points = (begin[:, None] + SHARES[:, None] * way[:, None]).reshape(-1, 2)
        return points, self._elements(points, np.repeat(body, len(SHARES)))

    def _elements(self, points: Floats, body: Ints) -> Ints:
        """Element (m,) of a body at each point; -1 where it has none there."""
        manifold = self.model.manifold
        point, element = self._tree.query(
            shapely.points(points), predicate="dwithin", distance=self._reach
        )
        own = manifold.element_body[element] == body[point]
        none = len(manifold.elements)
        found = np.full(len(points), none, dtype=np.int64)
        np.minimum.at(found, point[own], element[own])
        return np.where(found == none, -1, found)

    @cached_property
    def _tree(self) -> shapely.STRtree:
        return shapely.STRtree(self.model.manifold.elements.to_shapely())

    @cached_property
    def _reach(self) -> float:
        return NEAR * float(np.hypot(*np.ptp(self.model.manifold.elements.points, axis=0)))
