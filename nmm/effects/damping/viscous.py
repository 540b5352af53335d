"""Rayleigh damping, proportional to mass and stiffness."""

from collections.abc import Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Self

import numpy as np
from scipy.sparse import csc_array

from integration.arrays import Floats
from nmm.assembly.applied_forces import AppliedForces, joined
from nmm.assembly.model import Model
from nmm.assembly.state import State
from nmm.effects.base import Effect, Instant, Setup
from nmm.effects.loading.dead_loads import turned
from nmm.solvers.unchecked import product

if TYPE_CHECKING:
    from nmm.effects.motion.record import GroundMotion


class ViscousDamping(Effect):
    """Force ``-(a M + b K) v`` with the mass and the elastic stiffness of the material.

    A mode of angular frequency ``w`` has the damping ratio ``a / (2 w) + b w / 2``. The mass term
    damps all absolute motion, free flight too; the stiffness term damps strain alone, not the
    springs of joints and supports.
    """

    name = "viscous damping"
    placed = False

    def __init__(self, model: Model, mass: float, stiffness: float) -> None:
        self._mass, self._stiffness = mass, stiffness
        self._matrix = csc_array(mass * model.mass + stiffness * model.stiffness)

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build from ``[damping]``."""
        assert setup.scene.damping is not None
        coefficients = setup.scene.damping.coefficients
        assert coefficients is not None
        return cls(setup.model, *coefficients)

    @property
    def about(self) -> str:
        return f"{self._mass:.6g} 1/s of the mass and {self._stiffness:.6g} s of the stiffness"

    @property
    def turns_with_bodies(self) -> str:
        """See `Effect.turns_with_bodies`: the stiffness is that of the reference configuration."""
        return "damping by stiffness" if self._stiffness > 0 else ""

    @property
    def external(self) -> bool:  # type: ignore[override]
        """Whether momentum is lost: by the mass term."""
        return self._mass > 0

    def applied_forces(self, state: State) -> AppliedForces:
        """See `Effect.applied_forces`: the inertia of ``a v`` and the stress of ``b v``."""
        return self._forces(state, state.velocity)

    def _forces(self, state: State, damped: Floats) -> AppliedForces:
        """Those of a velocity that the mass term damps, unknowns (n,)."""
        parts = []
        if self._mass:
            parts.append(AppliedForces.of_acceleration(self._mass * damped))
        if self._stiffness:
            parts.append(AppliedForces.of_strain(self._stiffness * state.velocity))
        return joined(parts)

    def damping(self, state: State) -> csc_array:
        """See `Effect.damping`; always the same object."""
        return self._matrix


class GroundDamping(ViscousDamping):
    """Rayleigh damping relative to moving ground: its velocity ``v`` adds the force ``a M v``."""

    name = "damping against the ground"

    def __init__(
        self, model: Model, mass: float, stiffness: float, motions: "Mapping[int, GroundMotion]"
    ) -> None:
        super().__init__(model, mass, stiffness)
        self._model, self._motions = model, motions

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build from ``[damping]`` and the support that it names."""
        from nmm.effects.motion.record import motions_of

        damping = setup.scene.damping
        assert damping is not None
        assert damping.coefficients is not None
        named = [one.motion for one in setup.scene.supports if one.name == damping.ground]
        motions = motions_of(setup.scene, named[0]) if named else {}
        return cls(setup.model, *damping.coefficients, motions)

    @property
    def steady(self) -> bool:
        return False

    def force(self, state: State, end: Instant) -> Floats:
        """Return the force (n,) of the velocity of the ground, in the axes of the bodies."""
        return self._push(state, self._velocity(end.time))

    def applied_forces(self, state: State) -> AppliedForces:
        """See `Effect.applied_forces`: of the velocity against that of the ground."""
        ground = self._carried(state, self._velocity(state.time))
        return self._forces(state, state.velocity - ground)

    def work(self, before: State, after: State) -> float:
        """Work (J) of the mean of that force at both ends of the step."""
        mean = (self._velocity(before.time) + self._velocity(after.time)) / 2
        heavy, arm = self._masses
        way = heavy[:, None] * (after.frames.centre - before.frames.centre)
        way += np.einsum("bij,bj->bi", turned(after) - turned(before), arm)
        strained = self._push(after, mean) @ after.deformation
        strained -= self._push(before, mean) @ before.deformation
        return self._mass * float(way.sum(axis=0) @ mean) + float(strained)

    def _velocity(self, time: float) -> Floats:
        """Velocity (2,) of the ground (m/s)."""
        from nmm.effects.motion.record import velocity_of

        return velocity_of(self._motions, time)

    @cached_property
    def _masses(self) -> tuple[Floats, Floats]:
        """Mass (B,) of the bodies (kg), and its first moment about the centroid (B, 2) (kg m)."""
        modes = self._model.manifold.rigid_modes
        moments = modes.T @ (self._model.mass @ modes)
        arm = np.stack([moments.diagonal(1)[1::3], -moments.diagonal(2)[::3]], axis=1)
        return moments.diagonal()[::3], arm

    def _push(self, state: State, velocity: Floats) -> Floats:
        """Force (n,) of the mass term of bodies that move with a velocity (2,) (m/s)."""
        return self._mass * product(self._model.mass, self._carried(state, velocity))

    def _carried(self, state: State, velocity: Floats) -> Floats:
        """Unknowns (n,) of bodies that all move with a velocity (2,)."""
        bodies = self._model.manifold.n_bodies
        way = np.zeros((bodies, 3))
        way[:, :2] = state.frames.to_body(np.arange(bodies), np.tile(velocity, (bodies, 1)))
        return product(self._model.manifold.rigid_modes, way.ravel())
