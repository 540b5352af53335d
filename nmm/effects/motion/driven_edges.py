"""Absorbing edges: dashpots, and the tractions of the moving ground beyond them."""

from collections.abc import Sequence
from typing import Protocol

import numpy as np
from scipy.sparse import csc_array

from integration.arrays import Floats
from nmm.assembly.state import State
from nmm.effects.base import Effect, Instant
from nmm.effects.motion.edge_dashpots import EdgeDashpots


class DrivenEdge(Protocol):
    """An edge with dashpots and tractions of the ground beyond."""

    @property
    def dashpots(self) -> EdgeDashpots:
        """Dashpots of the ground beyond."""

    @property
    def driven(self) -> bool:
        """Whether the ground beyond moves."""

    def traction(self, time: float) -> Floats:
        """Tractions (m, 2) of the ground on a fixed edge at a time (Pa)."""


class DrivenEdges(Effect):
    """Dashpots on edges and the tractions of the ground beyond.

    The energy of the dashpots is booked as lost, that of the tractions as work.
    """

    def __init__(self, edges: Sequence[DrivenEdge], n_unknowns: int) -> None:
        self._driven, self._n = [one for one in edges if one.driven], n_unknowns
        none = csc_array((n_unknowns, n_unknowns))
        self._matrix = sum((one.dashpots.matrix(n_unknowns) for one in edges), start=none)

    @property
    def steady(self) -> bool:
        return not self._driven

    def damping(self, state: State) -> csc_array:
        """See `Effect.damping`; always the same object."""
        return self._matrix

    def force(self, state: State, end: Instant) -> Floats:
        """Return the force (n,) of the tractions of the ground."""
        total = np.zeros(self._n)
        for one in self._driven:  # a handful
            total += one.dashpots.push(state, one.traction(end.time))
        return total

    def work(self, before: State, after: State) -> float:
        """Work (J) of the mean of the tractions at both ends of the step."""
        total = 0.0
        for one in self._driven:  # a handful
            mean = (one.traction(before.time) + one.traction(after.time)) / 2
            total += one.dashpots.work(before, after, mean)
        return total
