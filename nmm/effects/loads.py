"""Applied forces: at points, along edges, in blocks; dead loads, fixed in direction."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats
from nmm.assembly.motion import State
from nmm.assembly.places import Place
from nmm.effects.base import Effect, Instant


@dataclass(frozen=True)
class Load:
    """One load on points of the material.

    Attributes
    ----------
    name
        As the scene calls it.
    place
        Where it acts.
    force
        (m, 2) on each point at factor 1 (N).
    factor
        From the instant to the factor.
    """

    name: str
    place: Place
    force: Floats
    factor: Callable[[Instant], float]

    @property
    def magnitude(self) -> float:
        """Length of the resultant at factor 1 (N)."""
        return float(np.hypot(*self.force.sum(axis=0)))


class Loads(Effect):
    """All point and edge loads of a scene."""

    name = "loads"

    def __init__(self, loads: list[Load], n_unknowns: int) -> None:
        self.loads = loads
        self._n = n_unknowns

    def force(self, state: State, end: Instant) -> Floats:
        """Return the loads in the bodies' axes."""
        total = np.zeros(self._n)
        for load in self.loads:  # a handful of loads
            points = load.place.points
            local = points.along(state.frames, load.factor(end) * load.force)
            total += np.bincount(points.rows.unknowns.ravel(), local.ravel(), minlength=self._n)
        return total

    def work(self, before: State, after: State, increment: Floats, end: Instant) -> float:
        """Mean of the loads at both ends of the step times the motion of their points."""
        start = Instant(before.time, before.load_factor)
        total = 0.0
        for load in self.loads:
            points = load.place.points
            way = points.place(after.frames, after.deformation) - points.place(
                before.frames, before.deformation
            )
            mean = (load.factor(start) + load.factor(end)) / 2
            total += mean * float(np.sum(load.force * way))
        return total
