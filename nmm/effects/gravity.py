"""The effect: gravity."""

from functools import cached_property
from typing import Self

import numpy as np

from integration.arrays import Floats, Ints
from nmm.assembly.kept import forget_kept, kept_of_place
from nmm.assembly.model import Model
from nmm.assembly.state import State
from nmm.effects.base import Effect, Instant, Setup
from nmm.effects.loading.dead_loads import DeadLoad


class Gravity(Effect):
    """Body force ``rho g``, of fixed direction while bodies turn."""

    name = "gravity"
    external = False
    placed = False

    def __init__(self, model: Model, acceleration: Floats) -> None:
        self._model = model
        self._acceleration = acceleration
        self._volume = DeadLoad(model, model.density[:, None] * acceleration)

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build from ``[gravity]``."""
        assert setup.scene.gravity is not None
        return cls(setup.model, np.array(setup.scene.gravity.acceleration))

    @property
    def dead(self) -> bool:
        """See `Effect.dead`: where it has a moment; what acts at centroids turns with nothing."""
        return self._volume.has_moment

    def force(self, state: State, end: Instant) -> Floats:
        """Return the load vector (n,) of the weight in the axes of the bodies."""
        return self._weight(state)

    @kept_of_place
    def _weight(self, state: State) -> Floats:
        body, along_x, along_y = self._unit
        down = state.frames.to_body(*self._everywhere)
        return np.asarray(along_x * down[body, 0] + along_y * down[body, 1])

    @cached_property
    def _everywhere(self) -> tuple[Ints, Floats]:
        """Numbers (B,) of all bodies, and the acceleration (B, 2) of each in global axes."""
        bodies = np.arange(self._model.manifold.n_bodies)
        return bodies, np.tile(self._acceleration, (len(bodies), 1))

    @cached_property
    def _unit(self) -> tuple[Ints, Floats, Floats]:
        """Body (n,) of each unknown, and load vectors (n,) of unit accelerations along its axes."""
        manifold, density = self._model.manifold, self._model.density[:, None]
        along_x, along_y = (self._model.body_load(density * axis) for axis in np.eye(2))
        return manifold.unknown_body, along_x, along_y

    def work(self, before: State, after: State) -> float:
        """Work (J) of the weight on the motion of axes and unknowns."""
        return self._volume.work(before, after, (self._weight(before), self._weight(after)))

    def forget(self) -> None:
        forget_kept(self)
