"""Loads on the volume that are functions of position."""

from collections.abc import Callable
from typing import Self

import numpy as np

from integration.arrays import Floats
from integration.rules import polygon_rule
from nmm.assembly.model import Model
from nmm.assembly.motion import State
from nmm.effects.base import Effect, Instant, Setup


class FieldLoad(Effect):
    """A force density given by a function, integrated by point rules over the elements."""

    name = "field load"

    def __init__(self, force: Floats) -> None:
        self._force = force

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Refuse: scenes declare body loads by numbers."""
        raise NotImplementedError("a field load is made from Python by FieldLoad.of")

    @classmethod
    def of(cls, model: Model, field: Callable[[Floats], Floats], order: int) -> Self:
        """Integrate ``field(points)`` (m, 2) in N/m3 to the degree ``order``."""
        manifold = model.manifold
        rule = polygon_rule(manifold.elements, order)
        rows = manifold.rows(rule.owner, rule.points)
        heavy = rule.weights[:, None] * field(rule.points) * model.thickness
        local = rows.along(heavy)
        force = np.bincount(rows.unknowns.ravel(), local.ravel(), minlength=manifold.n_unknowns)
        return cls(np.asarray(force))

    def force(self, state: State, end: Instant) -> Floats:
        """Return the load."""
        return self._force
