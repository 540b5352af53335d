"""Stress along straight lines through one body each."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import shapely

from integration.arrays import Bools, Floats, Ints
from integration.rules import PointRule
from nmm.assembly.model import Model
from nmm.fracture.acting_stress import StressField
from nmm.fracture.free_length import free_length

# Points nearer to an element than this share of the size of the domain lie in it.
NEAR = 1e-9


@dataclass(frozen=True)
class LineStress:
    """Stress along lines through a model."""

    model: Model

    def at(
        self, stress: StressField, begin: Floats, way: Floats, body: Ints, shares: Floats
    ) -> tuple[Floats, Bools]:
        """Return stresses (k, n, 3) in body axes (Pa), and which points (k, n) lie in the body.

        Parameters
        ----------
        stress
            The stress field.
        begin, way
            (k, 2) start of each line in the reference configuration, and the vector to its end (m).
        body
            (k,) body of each line; points outside it have zero stress.
        shares
            (n,) places of the points along the line, as shares of its length.
        """
        points, element = self._located(begin, way, body, shares)
        known = element >= 0
        found = np.zeros((len(points), 3))
        rule = PointRule(points[known], np.ones(int(known.sum())), element[known])
        if known.any():
            found[known] = stress(rule)
        shape = len(begin), len(shares)
        return found.reshape(*shape, 3), known.reshape(shape)

    def stays(self, begin: Floats, way: Floats, body: Ints, shares: Floats) -> Bools:
        """Return which lines (k,) stay in their body; see `at`."""
        _, element = self._located(begin, way, body, shares)
        return np.asarray((element.reshape(len(begin), len(shares)) >= 0).all(axis=1))

    def depth(self, begin: Floats, way: Floats, body: Ints, asked: Bools) -> Floats:
        """Return how far bodies (k,) reach along lines (m); infinite of those not ``asked``."""
        edges, found = self.model.cut.boundary, np.full(len(begin), np.inf)
        for one in np.flatnonzero(asked):  # the lines of one chunk, over all edges each
            own = edges.body == body[one]
            ends = edges.start[own], edges.end[own]
            found[one] = free_length(begin[one], way[one], *ends, self._size)
        return found

    def _located(
        self, begin: Floats, way: Floats, body: Ints, shares: Floats
    ) -> tuple[Floats, Ints]:
        """Points (k n, 2) of lines, and the element of each; -1 outside the body."""
        points = (begin[:, None] + shares[:, None] * way[:, None]).reshape(-1, 2)
        return points, self._elements(points, np.repeat(body, len(shares)))

    def _elements(self, points: Floats, body: Ints) -> Ints:
        """Element (m,) of a body at each point; -1 outside the body."""
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

    @property
    def _reach(self) -> float:
        return NEAR * self._size

    @property
    def _size(self) -> float:
        return self.model.manifold.elements.extent
