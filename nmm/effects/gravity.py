"""Weight: a constant acceleration of all mass."""

from typing import Self

import numpy as np

from integration.arrays import Floats
from nmm.assembly.model import Model
from nmm.assembly.motion import State
from nmm.effects.base import Effect, Instant, Setup


class Gravity(Effect):
    """Force density ``rho g``, fixed in space while bodies turn."""

    name = "gravity"

    def __init__(self, model: Model, acceleration: Floats) -> None:
        self._model = model
        self._acceleration = acceleration
        body = model.manifold.element_body
        weight = model.density[:, None] * acceleration
        self._body_of_element = body
        self._density = weight
        total = weight * (model.element_area * model.thickness)[:, None]
        self._weight = np.stack(
            [np.bincount(body, total[:, i], minlength=model.manifold.n_bodies) for i in (0, 1)], 1
        )

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build from ``[gravity]``."""
        assert setup.scene.gravity is not None
        return cls(setup.model, np.array(setup.scene.gravity.acceleration))

    def relaid(self, model: Model) -> Effect:
        """See `Effect.relaid`."""
        return Gravity(model, self._acceleration)

    def force(self, state: State, end: Instant) -> Floats:
        """Return the weight in the bodies' axes."""
        return self._model.body_load(state.frames.to_body(self._body_of_element, self._density))

    def work(self, before: State, after: State) -> float:
        """Weight times the motion of the centres of mass."""
        return float(np.sum(self._weight * (after.frames.centre - before.frames.centre)))
