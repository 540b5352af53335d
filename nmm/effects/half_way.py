"""Dead forces where bodies are half way through a step.

The exact rotation of a step moves a point of a body from ``x0`` to ``x1`` with

    x1 - x0 = R0 u + Rm (r (X + T qm)^perp + T dq) + O(r^3),

``u``, ``r`` the body's mean motion, ``dq`` the rest of the increment, ``Rm`` and ``qm`` half way. A
force on the unknowns whose work is the one on this motion does in a step, to that order, what the
force does. A step that goes on turning as it began is the leapfrog of Stoermer and Verlet: what it
makes of the energy of a dead couple comes and goes.
"""

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Floats
from nmm.assembly.model import Model
from nmm.assembly.moving.momenta import resultants
from nmm.assembly.state import Frames, State
from nmm.effects.given.steps import Instant
from nmm.solvers.unchecked import product

if TYPE_CHECKING:
    from nmm.effects.base import Effect


@dataclass(frozen=True)
class HalfWay:
    """Where the bodies of a model are half way through a step, as its start foresees it."""

    model: Model
    place: State

    def force(self, effect: "Effect", start: State, end: Instant) -> Floats:
        """Return the dead force (n,) of an effect in the axes of a step's ``start``."""
        manifold, place, frames = self.model.manifold, self.place, self.place.frames
        every = np.arange(manifold.n_bodies)
        acting = effect.force(place, end)
        resultant = resultants(self.model, acting)[:, :2]
        turned = start.frames.to_body(every, frames.to_global(every, resultant))
        # Against axes a quarter ahead a force does on strains its moment about strained arms.
        ahead = replace(place, frames=Frames(frames.centre, frames.angle + np.pi / 2))
        parts = effect.force(ahead, end) * place.deformation
        moment = np.bincount(manifold.unknown_body, parts, manifold.n_bodies)
        more = np.column_stack([turned - resultant, moment])
        return np.asarray(acting + product(self.model.rigid_spread, more.ravel()))
