"""The points whose places and velocities tell two solutions of one step from each other."""

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Floats
from nmm.assembly.moving.motion import rigid_rates
from nmm.assembly.state import State

if TYPE_CHECKING:
    from nmm.stepping.step.stepper import Stepper


@dataclass(frozen=True)
class FollowedPoints:
    """Points of a model, all vertices or two on each body as if it were rigid.

    Attributes
    ----------
    stepper
        Whose model they are of.
    rigid
        Whether they are the centroid of each body and a point that turns about it, as far away as
        the body reaches: waves within a body move neither.
    """

    stepper: "Stepper"
    rigid: bool

    def places(self, state: State) -> Floats:
        """Return where they are (m, 2)."""
        if not self.rigid:
            return self.stepper.vertices.place(state.frames, state.deformation)
        frames = state.frames
        heading = np.stack([np.cos(frames.angle), np.sin(frames.angle)], axis=1)
        return np.concatenate([frames.centre, frames.centre + self._radius[:, None] * heading])

    def velocities(self, state: State) -> Floats:
        """Return how fast they are (m, 2), along the global axes."""
        if not self.rigid:
            return self.stepper.velocity(state)
        frames = state.frames
        rates = rigid_rates(self.stepper.model, state)
        middle, spin = rates[:, :2], rates[:, 2]
        heading = np.stack([-np.sin(frames.angle), np.cos(frames.angle)], axis=1)
        return np.concatenate([middle, middle + (self._radius * spin)[:, None] * heading])

    @cached_property
    def _radius(self) -> Floats:
        """How far each body reaches from its centroid (B,) (m)."""
        vertices = self.stepper.vertices
        found = np.zeros(self.stepper.model.manifold.n_bodies)
        np.maximum.at(found, vertices.body, np.hypot(*vertices.arm.T))
        return found

    def apart(self, one: State, other: State) -> float:
        """Return the largest difference of places (m)."""
        return largest(self.places(one) - self.places(other))

    def faster(self, one: State, other: State) -> float:
        """Return the largest difference of velocities (m/s)."""
        return largest(self.velocities(one) - self.velocities(other))

    def sizes(self, state: State) -> tuple[float, float]:
        """Return the largest displacement since the start (m), and the largest speed (m/s)."""
        way = self.stepper.place(state) - self.stepper.reference
        return largest(way), largest(self.velocities(state))


def largest(vectors: Floats) -> float:
    """Return the largest length of vectors (m, 2)."""
    return float(np.sqrt((vectors**2).sum(axis=1).max(initial=0.0)))
