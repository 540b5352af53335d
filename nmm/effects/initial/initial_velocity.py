"""The effect: velocity of blocks at the start of a run."""

from dataclasses import replace
from typing import Self

import numpy as np

from integration.arrays import Floats
from nmm.assembly.model import Model
from nmm.assembly.motion import State
from nmm.effects.base import Effect, Setup


class InitialVelocity(Effect):
    """Rigid motion (vx, vy, omega about the centroid) of each body at the start."""

    name = "initial velocity"
    external = False
    placed = False

    def __init__(self, model: Model, motion: Floats) -> None:
        self._model = model
        self._motion = motion

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build from ``[[initial_velocities]]``; later tables overwrite earlier ones."""
        manifold = setup.model.manifold
        motion = np.zeros((manifold.n_bodies, 3))
        for item in setup.scene.initial_velocities:  # a handful of tables
            regions = setup.regions(item.block)
            chosen = slice(None) if regions is None else regions[manifold.element_region]
            motion[np.unique(manifold.element_body[chosen])] = [
                *item.velocity,
                item.angular_velocity,
            ]
        return cls(setup.model, motion)

    def begin(self, state: State) -> State:
        """Return the state with the velocities set."""
        return replace(state, velocity=self._model.manifold.rigid_modes @ self._motion.ravel())
