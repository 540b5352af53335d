"""Pressure of the pores in bodies that bend by any angle.

It takes ``b p`` from Cauchy's normal stresses, whatever the body has become: ``-b p J C^-1`` of the
second Piola-Kirchhoff stress, ``-b p cof F`` of the first, so that its work is ``b p dJ``
(Biot 1972). In the plane ``J`` is of second degree in the displacements: the cofactors half way
give its change exactly.
"""

from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats
from nmm.assembly.finite_strain.finite_matter import FiniteMatter
from nmm.assembly.finite_strain.gradients import volumes
from nmm.assembly.motion import State
from nmm.assembly.stress_points import ISOTROPIC, StressAt
from nmm.effects.base import Instant, Span, StepForce

# Derivative of the cofactors (xx, xy, yx, yy) by the gradient.
TURNING = np.fliplr(np.diag([1.0, -1.0, -1.0, 1.0]))


@dataclass(frozen=True)
class PoreStress:
    """What a pressure at material points does.

    Attributes
    ----------
    matter
        Whose points they are.
    stress_at
        The same as a stress in all directions, see `Effect.stress_at`.
    """

    matter: FiniteMatter
    stress_at: StressAt

    def at(self, time: float) -> Floats:
        """Return ``b p`` (Q,) at the points (Pa)."""
        rule = self.matter.points.rule
        return -self.stress_at(rule.owner, rule.points, time)[:, 0]

    def force(self, state: State, end: Instant) -> Floats:
        """See `Effect.force`."""
        return self._pushed(self.at(end.time), state.deformation)

    def step_force(self, before: State, after: State, span: Span) -> StepForce:
        """See `Effect.step_force`: in time by the means of both ends, where it does ``b p dJ``."""
        pressure, place, share = self.at(after.time), after.deformation, 1.0
        if span.weight < 1:
            pressure, share = (self.at(before.time) + pressure) / 2, 0.5
            place = (before.deformation + place) / 2
        turning = -share * pressure[:, None, None] * TURNING
        return StepForce(self._pushed(pressure, place), lambda: self.matter.stiffness(turning))

    def work(self, before: State, after: State) -> float:
        """Work (J) of the mean pressure on the change of the volume."""
        mean, points = (self.at(before.time) + self.at(after.time)) / 2, self.matter.points
        ends = (volumes(points.strain(one.deformation)) for one in (before, after))
        first, last = ends
        return self.matter.thickness * float((points.rule.weights * mean) @ (last - first))

    def mean(self, state: State) -> Floats:
        """Mean Cauchy stress (E, 3) of the elements where they are now (Pa)."""
        points, volume = self.matter.points, volumes(self.matter.points.strain(state.deformation))
        _, found = points.means((self.at(state.time) * volume)[:, None])
        _, area = points.means(volume[:, None])
        return np.asarray(-found / area * ISOTROPIC)

    def _pushed(self, pressure: Floats, deformation: Floats) -> Floats:
        a, b, c, d = self.matter.points.strain(deformation).T
        cofactors = np.stack([1 + d, -c, -b, 1 + a], axis=1)
        return self.matter.force(deformation, pressure[:, None] * cofactors)
