"""The effect: velocity of blocks at the start of a run."""

from dataclasses import replace
from typing import Self

import numpy as np

from covers.approximation.manifold import Manifold
from integration.arrays import Bools, Floats
from integration.plane_vectors import counterclockwise
from nmm.assembly.model import Model
from nmm.assembly.state import State
from nmm.effects.base import Effect, Setup


class InitialVelocity(Effect):
    """Rigid motion (vx, vy, omega about the centroid) of each block at the start.

    Bodies into which cracks part a block begin with the motion of the whole.
    """

    name = "initial velocity"
    external = False
    placed = False

    def __init__(self, model: Model, motion: Floats) -> None:
        self._model = model
        self.motion = motion

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build from ``[[initial_velocities]]``; later tables overwrite earlier ones."""
        manifold = setup.model.manifold
        motion, apart = np.zeros((manifold.n_bodies, 3)), from_middle(manifold)
        for item in setup.scene.initial_velocities:  # a handful of tables
            regions = setup.regions(item.block)
            chosen = slice(None) if regions is None else regions[manifold.element_region]
            bodies, spin = np.unique(manifold.element_body[chosen]), item.angular_velocity
            around = spin * counterclockwise(apart[bodies])
            motion[bodies] = np.column_stack([item.velocity + around, np.full(len(bodies), spin)])
        return cls(setup.model, motion)

    def begin(self, state: State) -> State:
        """Return the state with the velocities set."""
        return replace(state, velocity=self._model.manifold.rigid_modes @ self.motion.ravel())


def setting_out(setup: Setup, state: State, blocks: Bools) -> State:
    """Return a state in which some blocks (N,) begin to move as ``[[initial_velocities]]`` say.

    A stage at rest before has left them without a velocity of their own.
    """
    manifold = setup.model.manifold
    bodies = np.zeros(manifold.n_bodies, dtype=bool)
    bodies[manifold.element_body] = blocks[manifold.element_region]
    begun = InitialVelocity.from_setup(setup).begin(state).velocity
    return replace(state, velocity=np.where(bodies[manifold.unknown_body], begun, state.velocity))


def from_middle(manifold: Manifold) -> Floats:
    """Return how far the centroids (B, 2) of bodies are from those of their blocks (m)."""
    block = np.empty(manifold.n_bodies, dtype=np.int64)
    block[manifold.element_body] = manifold.element_region
    first, number = np.unique(block, return_index=True, return_inverse=True)[1:]
    # From the first body of a block, so that a block of one body is at its middle to the last bit.
    apart = manifold.body_centroid - manifold.body_centroid[first[number]]
    area = np.bincount(number, manifold.body_area)
    moment = [np.bincount(number, manifold.body_area * along) for along in apart.T]
    return np.asarray(apart - (np.array(moment) / area).T[number])
