"""Pore pressure in finite strain.

It subtracts ``b p`` from the normal Cauchy stresses: ``-b p J C^-1`` in the second and
``-b p cof F`` in the first Piola-Kirchhoff stress, so that its work is ``b p dJ`` (Biot 1972). In
the plane ``J`` is quadratic in the displacements, and the cofactors at the midpoint of a step give
its change exactly.
"""

from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats
from nmm.assembly.finite_strain.finite_matter import FiniteMatter
from nmm.assembly.finite_strain.gradients import volumes
from nmm.assembly.state import State
from nmm.assembly.stress_points import StressAt
from nmm.effects.base import Instant, Span, StepForce
from nmm.materials.tensors import ISOTROPIC

# Derivative of the cofactors (xx, xy, yx, yy) by the deformation gradient.
TURNING = np.fliplr(np.diag([1.0, -1.0, -1.0, 1.0]))


@dataclass(frozen=True)
class PoreStress:
    """The stress of the pore pressure at material points.

    Attributes
    ----------
    matter
        The material points.
    stress_at
        The isotropic stress of the pressure, see `Effect.stress_at`.
    """

    matter: FiniteMatter
    stress_at: StressAt

    def at(self, time: float) -> Floats:
        """Return ``b p`` (Q,) at the points (Pa)."""
        rule = self.matter.points.rule
        return -self.stress_at(rule.owner, rule.points, time)[:, 0]

    def force(self, state: State, end: Instant) -> Floats:
        """See `Effect.force`."""
        return self._force(self.at(end.time), state.deformation)

    def step_force(self, before: State, after: State, span: Span) -> StepForce:
        """See `Effect.step_force`: in time, the means of both ends, whose work is ``b p dJ``."""
        pressure, place, share = self.at(after.time), after.deformation, 1.0
        if span.weight < 1:
            pressure, share = (self.at(before.time) + pressure) / 2, 0.5
            place = (before.deformation + place) / 2
        turning = -share * pressure[:, None, None] * TURNING
        return StepForce(self._force(pressure, place), lambda: self.matter.stiffness(turning))

    def work(self, before: State, after: State) -> float:
        """Work (J) of the mean pressure on the change of volume."""
        mean, points = (self.at(before.time) + self.at(after.time)) / 2, self.matter.points
        ends = (volumes(points.strain(one.deformation)) for one in (before, after))
        first, last = ends
        return self.matter.thickness * float((points.rule.weights * mean) @ (last - first))

    def mean(self, state: State) -> Floats:
        """Mean Cauchy stress (E, 3) of the elements in global axes (Pa)."""
        points, volume = self.matter.points, volumes(self.matter.points.strain(state.deformation))
        _, found = points.means((self.at(state.time) * volume)[:, None])
        _, area = points.means(volume[:, None])
        return np.asarray(-found / area * ISOTROPIC)

    def _force(self, pressure: Floats, deformation: Floats) -> Floats:
        a, b, c, d = self.matter.points.strain(deformation).T
        cofactors = np.stack([1 + d, -c, -b, 1 + a], axis=1)
        return self.matter.force(deformation, pressure[:, None] * cofactors)
