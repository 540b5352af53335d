"""Cracks that grow in time: tips run through their pieces at a speed that the intensities give.

Within the first half of a piece a tip is seen at its beginning: it waits there until its speed,
summed over the steps, has brought it half way. Then the piece is cut, and what held its faces is
withdrawn over the time that the other half takes at the speed that was reached. So a tip is never
further from where it is seen than half a piece.
"""

from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from integration.arrays import Bools, Floats
from nmm.assembly.motion import State
from nmm.effects.base import Instant, Setup
from nmm.fracture.growth.branching import TWO, Branching
from nmm.fracture.growth.growing import GrowingCracks
from nmm.fracture.growth.grown import GrownSoFar, nearest_elements
from nmm.fracture.growth.held_faces import HeldFaces, newly_held
from nmm.fracture.growth.rule import ROUNDING
from nmm.fracture.growth.running import RunningTips
from nmm.fracture.growth.speed import SPEEDS, rayleigh_speeds
from nmm.fracture.growth.tips.intensities import Intensities, tip_moduli

if TYPE_CHECKING:
    from nmm.effects.change import Change


class GrowthInTime(GrowingCracks):
    """Cracks that grow in scenes with inertia; what growth takes is the work on faces that open."""

    held = True

    def __init__(self, setup: Setup, sofar: GrownSoFar | None = None) -> None:
        super().__init__(setup, sofar)
        self._law = SPEEDS[self._table.speed or "freund"]
        angle, length = self._table.branching, self._table.branching_length
        self._branching = None if angle is None else Branching(angle, length or 0.0)
        self._running = RunningTips.at_rest(len(self._fronts), setup.start.time)
        self._held = HeldFaces.none(setup.model)

    @property
    def about(self) -> str:
        """See `Effect.about`."""
        return f"{super().about}, speed by {self._table.speed or 'freund'}"

    @property
    def steady(self) -> bool:
        """See `Effect.steady`: what holds new faces falls with time."""
        return False

    def force(self, state: State, end: Instant) -> Floats:
        """Return what holds faces that tips are running through, at the end of the step."""
        return self._held.push(state, end.time)

    def loss(self, before: State, after: State) -> float:
        """Work of opening faces against what holds them."""
        return self._held.taken(before, after)

    def accepted(self, state: State) -> None:
        """Let tips run on by what a step brings them."""
        found = self.intensities(state)
        speed = np.zeros(len(self._fronts))
        speed[found.front] = self._bound * self._law(found.share) * self.free(found)
        self._running = self._running.advanced(state.time, speed)

    @cached_property
    def _bound(self) -> Floats:
        """Speeds (k,) of Rayleigh's wave at fronts with a tip, which none can reach (m/s)."""
        model = self._setup.model
        element = model.cut.tips.element[self._measured.tip]
        return rayleigh_speeds(model, element, tip_moduli(model, element)[0])

    def follow(self, change: "Change") -> "GrowthInTime":
        """Return the effect on the new geometry, with faces held where tips have gone on."""
        before, after = self._setup.geometry.cracks, change.setup.geometry.cracks
        new = GrowthInTime(change.setup, self._grown_so_far(change))
        length, was = new._fronts.gained(before, after), new._fronts.former(before, after)
        grown = np.flatnonzero(length > 0)
        running = self._joined(change, was[len(self._fronts) :])
        new._running, span = running.cut(grown, length[grown])
        held = newly_held(change, was[grown], span, self._measured.stresses)
        new._held = self._held.followed(change).joined(held)
        return new

    def _joined(self, change: "Change", born: Floats) -> RunningTips:
        """Return how tips run with those that were born at places (k, 2) before."""
        if len(change.setup.geometry.nuclei) > len(self._setup.geometry.nuclei):
            model = self._setup.model
            element = nearest_elements(model, born)
            speed = rayleigh_speeds(model, element, tip_moduli(model, element)[0])
            return self._running.begun(len(born), float(speed.min()))
        # Where a tip divides, both branches run on as it ran.
        away = np.hypot(*np.moveaxis(born[:, None] - self._points, -1, 0))
        return self._running.divided(np.argmin(away, axis=1))

    def _laid(self, found: Intensities) -> tuple[tuple[Floats, ...], str]:
        """See `GrowingCracks._laid`; with tips that divide."""
        if self._branching is None:
            return super()._laid(found)
        cut, cracks = self._setup.model.cut, self._setup.geometry.cracks
        length = self.rule.increment
        twice = found.share**2 >= TWO
        gained = np.where(self._sofar.length[found.front] > 0, length, 0.0)
        self._running = self._running.fed_by(found.front, twice, gained)
        fed = self._running.fed[found.front] >= self._branching.length * (1 - ROUNDING)
        return self._branching.laid(cut, cracks, self._fronts, found, twice & fed, length)

    @property
    def _points(self) -> Floats:
        """Where the fronts are (n, 2)."""
        return self._fronts.points(self._setup.geometry.cracks)

    def carried(self) -> tuple[Any, ...]:
        """See `GrowingCracks.carried`; and how far tips are, and what holds faces."""
        return (*super().carried(), self._running.arrays, self._held.arrays)

    def carry(self, carried: tuple[Any, ...]) -> None:
        """See `Effect.carry`."""
        *sofar, running, held = carried
        super().carry(tuple(sofar))
        self._running = RunningTips(*running)
        self._held = HeldFaces.of_arrays(self._setup.model, held)

    def _growing(self, found: Intensities) -> Bools:
        """Which fronts (k,) with a tip have come half way through their next piece."""
        half = self.rule.increment / 2
        return self.free(found) & (self._running.way[found.front] >= half)
