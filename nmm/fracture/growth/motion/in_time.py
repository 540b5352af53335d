"""Dynamic crack growth: tips advance at a speed that follows from the intensity factors.

Cracks are cut in segments. The tip of the model stays at the beginning of a segment until the
speed, integrated over the steps, has carried the real tip half way through it. Then the segment is
cut, and the tractions on its faces are released over the time that the other half takes at the
speed reached. So the tip of the model is never more than half a segment from the real one.
"""

from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from integration.arrays import Bools, Floats
from nmm.assembly.state import State
from nmm.effects.base import Instant, Setup
from nmm.fracture.growth.growing import GrowingCracks
from nmm.fracture.growth.grown import GrownSoFar, nearest_elements
from nmm.fracture.growth.motion.branching import TWO, Branching
from nmm.fracture.growth.motion.inflow import EnergyInflow
from nmm.fracture.growth.motion.released_tractions import ReleasedTractions, tractions_on_new_faces
from nmm.fracture.growth.motion.running import RunningTips
from nmm.fracture.growth.motion.speed import SPEEDS, rayleigh_speeds
from nmm.fracture.growth.rule import ROUNDING
from nmm.fracture.growth.tips.intensities import Intensities, tip_moduli

if TYPE_CHECKING:
    from nmm.effects.change import Change


class GrowthInTime(GrowingCracks):
    """Crack growth in scenes with inertia; its energy is the work against released tractions."""

    continuous = True

    def __init__(self, setup: Setup, sofar: GrownSoFar | None = None) -> None:
        super().__init__(setup, sofar)
        self._law = SPEEDS[self._table.speed or "freund"]
        angle, length = self._table.branching, self._table.branching_length
        self._branching = None if angle is None else Branching(angle, length or 0.0)
        self._running = RunningTips.begun(len(self._fronts), setup.start.time)
        self._inflow = EnergyInflow.none(len(self._fronts), setup.start.time)
        self._released = ReleasedTractions.none(setup.model)

    @property
    def about(self) -> str:
        return f"{super().about}, speed by {self._table.speed or 'freund'}"

    @property
    def steady(self) -> bool:
        """See `Effect.steady`: released tractions fall with time."""
        return False

    def force(self, state: State, end: Instant) -> Floats:
        """Return the tractions left on faces of new segments at the end of the step."""
        return self._released.push(state, end.time)

    def loss(self, before: State, after: State) -> float:
        """Work (J) of opening faces against the released tractions."""
        return self._released.work_against(before, after)

    def accepted(self, state: State) -> None:
        """Advance the tips by the speed at the end of a step."""
        found = self.intensities(state)
        speed, rate = np.zeros((2, len(self._fronts)))
        rate[found.front] = found.share**2
        self._inflow = self._inflow.after(state.time, rate)
        at_rest = np.sqrt(self._inflow.driving[found.front])
        speed[found.front] = self._bound * self._law(at_rest) * self.free(found)
        self._running = self._running.advanced(state.time, speed)

    @cached_property
    def _bound(self) -> Floats:
        """Rayleigh wave speeds (k,) at fronts with a tip, the limit of their speeds (m/s)."""
        model = self._setup.model
        element = model.cut.tips.element[self._measured.tip]
        return rayleigh_speeds(model, element, tip_moduli(model, element)[0])

    def follow(self, change: "Change") -> "GrowthInTime":
        """Return the effect on the new geometry, with tractions on the faces of new segments."""
        before, after = self._setup.geometry.cracks, change.setup.geometry.cracks
        new = GrowthInTime(change.setup, self._grown_so_far(change))
        length, was = new._fronts.gained(before, after), new._fronts.former(before, after)
        grown = np.flatnonzero(length > 0)
        running, inflow = self._with_new_tips(change, was[len(self._fronts) :])
        # Where no tip was before, all are at rest, and no bound counts.
        bound = float(self._bound.min(initial=np.inf))
        new._inflow = inflow.cut(grown, length[grown], bound)
        new._running, span = running.cut(grown, length[grown])
        released = tractions_on_new_faces(change, was[grown], span, self._measured.stresses)
        new._released = self._released.followed(change).joined(released)
        return new

    def _with_new_tips(self, change: "Change", born: Floats) -> tuple[RunningTips, EnergyInflow]:
        """Return the tips with those that began at places (k, 2) of the old model."""
        if len(change.setup.geometry.nuclei) > len(self._setup.geometry.nuclei):
            model = self._setup.model
            element = nearest_elements(model, born)
            speed = rayleigh_speeds(model, element, tip_moduli(model, element)[0])
            new = RunningTips.begun(len(born), self._running.time, float(speed.min()))
            none = EnergyInflow.none(len(born), self._inflow.time)
            return self._running.joined(new), self._inflow.joined(none)
        # Where a tip branches, both branches go on at its speed.
        away = np.hypot(*np.moveaxis(born[:, None] - self._points, -1, 0))
        parents = np.argmin(away, axis=1)
        return self._running.divided(parents), self._inflow.divided(parents)

    def _extended(self, found: Intensities) -> tuple[tuple[Floats, ...], str]:
        """See `GrowingCracks._extended`; with tips that branch."""
        if self._branching is None:
            return super()._extended(found)
        cut, cracks = self._setup.model.cut, self._setup.geometry.cracks
        length = self.rule.increment
        twice = self._inflow.driving[found.front] >= TWO
        gained = np.where(self._sofar.length[found.front] > 0, length, 0.0)
        self._running = self._running.fed_by(found.front, twice, gained)
        fed = self._running.fed[found.front] >= self._branching.length * (1 - ROUNDING)
        return self._branching.extended(cut, cracks, self._fronts, found, twice & fed, length)

    @property
    def _points(self) -> Floats:
        """Places (n, 2) of the fronts (m)."""
        return self._fronts.points(self._setup.geometry.cracks)

    def carried(self) -> tuple[Any, ...]:
        """See `GrowingCracks.carried`; with the way of the tips and the released tractions."""
        mine = self._running.arrays, self._inflow.arrays, self._released.arrays
        return (*super().carried(), *mine)

    def carry(self, carried: tuple[Any, ...]) -> None:
        *sofar, running, inflow, released = carried
        super().carry(tuple(sofar))
        self._running, self._inflow = RunningTips(*running), EnergyInflow(*inflow)
        self._released = ReleasedTractions.of_arrays(self._setup.model, released)

    def _growing(self, found: Intensities) -> Bools:
        """Which fronts (k,) with a tip have come half way through their next segment."""
        half = self.rule.increment / 2
        return self.free(found) & (self._running.way[found.front] >= half)
