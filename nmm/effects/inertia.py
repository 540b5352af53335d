"""The effect: inertia, with the centrifugal force in the rotating axes of bodies."""

from functools import cached_property
from typing import Self

import numpy as np

from integration.arrays import Floats
from integration.contraction import some
from integration.sparse import csc_array
from nmm.assembly.applied_forces import AppliedForces
from nmm.assembly.kept import kept_of_object
from nmm.assembly.model import Model
from nmm.assembly.moving.spin import SpinOfStep
from nmm.assembly.state import State
from nmm.effects.base import Effect, Instant, Setup
from nmm.solvers.unchecked import product


class Inertia(Effect):
    """Centrifugal force ``rho omega^2 (X - Xc)`` in the rotating axes of each body.

    The integrator adds the mass. In fixed axes, as in the classical update and for small
    displacements, there is no such force.

    The rate ``omega`` is the angular momentum ``L`` over the moment of inertia ``J0`` of the body
    as it was laid. A deformation makes it ``J = J0 + 2 s``, with ``s = int rho (X - Xc) . u``, and
    the energy of the rotation ``L^2 / (2 J)``, to first order ``J0 omega^2 / 2 - omega^2 s``: the
    work of the centrifugal force is taken from it, so that a body in free flight keeps its energy.
    Its axes turn by the derivative of that energy to ``L``, ``omega (1 - 2 s / J0)``, so that
    moments do the work that it gains.
    """

    name = "inertia"
    external = False
    placed = False

    def __init__(self, model: Model, axes_turn: bool = True) -> None:
        self._model = model
        self._axes_turn = axes_turn
        if model.lumped:  # refused here where it is not positive
            _ = self.mass

    @classmethod
    def beyond_strain(cls) -> bool:
        """See `Effect.beyond_strain`: it accelerates what edges hold."""
        return True

    @cached_property
    def mass(self) -> csc_array:
        """Mass (n, n) of the unknowns (kg)."""
        return self._model.mass

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build from ``[inertia]``."""
        return cls(setup.model, setup.kinematics.turns)

    def force(self, state: State, end: Instant) -> Floats:
        """Return the centrifugal force of the rotation at the start of the step."""
        return self._force(state)

    @kept_of_object
    def _force(self, state: State) -> Floats:
        outwards = self._centrifugal(state)
        return product(self.mass, outwards) if some(outwards) else outwards

    def applied_forces(self, state: State) -> AppliedForces:
        """See `Effect.applied_forces`: with the pull outwards, in axes that turn."""
        acceleration = state.acceleration - self._centrifugal(state)
        if not some(acceleration):
            return AppliedForces.of_densities()
        return AppliedForces.of_acceleration(acceleration)

    def through(
        self, state: State, step: float, share: float, end: State | None = None
    ) -> SpinOfStep | None:
        """Return what spin does to strained bodies through a step; None where no axes turn.

        It starts with a ``share`` of the velocity of ``state``. Without the ``end`` that a solution
        has found, bodies spin on, and their deformations go on.
        """
        if not self._axes_turn:
            return None
        spin = share * self.spin(state)
        if end is not None:
            last, half_way = self.spin(end), (state.deformation + end.deformation) / 2
            mean = (spin + last) / 2 * self._stretched(half_way)
            return SpinOfStep((spin**2 + last**2) / 2, mean)
        if not some(spin):
            return None
        half_way = state.deformation + step / 2 * state.velocity
        return SpinOfStep(spin**2, spin * self._stretched(half_way))

    def pull(self, spin: SpinOfStep) -> Floats:
        """Return the mean pull outwards (n,) of a step (N)."""
        return product(self.mass, product(self._model.manifold.stretch_modes, spin.squared))

    def turned_less(self, spin: SpinOfStep, step: float) -> Floats:
        """Return by how much less than their spin strained bodies turn in a step, in unknowns."""
        return np.asarray(step * spin.slower[self._model.manifold.unknown_body] * self._turns[1])

    def misjudged(
        self, used: SpinOfStep | None, before: State, after: State
    ) -> tuple[float, float]:
        """Return the energy (J) that a step made which ``used`` other means, and the kinetic one.

        That is the reference's, whatever the bodies' stretch.
        """
        if not self._axes_turn:
            return 0.0, 0.0
        first, last = self.spin(before), self.spin(after)
        begun, ended = self._stretched(before.deformation), self._stretched(after.deformation)
        more = (last - first) * (first + last) * (begun + ended) / 4
        more += (first**2 + last**2) * (ended - begun) / 4
        if used is not None:
            more -= (last - first) * used.slower + used.squared * (ended - begun) / 2
        moving = float(after.velocity @ product(self.mass, after.velocity)) / 2
        return abs(float(self._turns[0] @ more)), moving

    def turning(self, state: State) -> tuple[Floats, Floats] | None:
        """Return how fast axes turn (B,), and by how much slower than their spin (B,) (rad/s).

        None where no axes turn.
        """
        spin = self.spin(state)
        if not (self._axes_turn and some(spin)):
            return None
        slower = spin * self._stretched(state.deformation)
        return spin - slower, slower

    @kept_of_object
    def _stretched(self, deformation: Floats) -> Floats:
        """Return ``2 s / J0`` (B,) of the bodies with a deformation (n,)."""
        manifold = self._model.manifold
        parts = self._turns[2] * deformation
        return np.asarray(2.0 * np.bincount(manifold.unknown_body, parts, manifold.n_bodies))

    @cached_property
    def _turns(self) -> tuple[Floats, Floats, Floats]:
        """``J0`` (B,); unknowns (n,) of a turn of every body, and factors in its ``s / J0``."""
        manifold = self._model.manifold
        body, bodies = manifold.unknown_body, manifold.n_bodies
        turn = product(manifold.rigid_modes, np.tile([0.0, 0.0, 1.0], bodies))
        inertia = np.bincount(body, turn * product(self.mass, turn), bodies).astype(float)
        stretch = product(self.mass, product(manifold.stretch_modes, np.ones(bodies)))
        heavy = inertia[body] > 0  # what has no mass is not slowed
        factors = np.divide(stretch, inertia[body], out=np.zeros_like(stretch), where=heavy)
        return inertia, turn, factors

    @kept_of_object
    def _centrifugal(self, state: State) -> Floats:
        """Return ``omega^2 (X - Xc)`` in unknowns (n,); zero in axes that do not turn."""
        spin = self.spin(state)
        if not (self._axes_turn and some(spin)):
            return np.zeros(self._model.manifold.n_unknowns)
        return product(self._model.manifold.stretch_modes, spin**2)

    @kept_of_object
    def spin(self, state: State) -> Floats:
        """Return the mean angular velocity (B,) of the bodies (rad/s)."""
        return product(self._model.rigid_projection, state.velocity).reshape(-1, 3)[:, 2]

    def energy(self, state: State) -> float:
        """Kinetic energy (J), that of rotation with the moment of inertia of the stretched body."""
        reference = 0.5 * state.velocity @ product(self.mass, state.velocity)
        outwards = self.force(state, Instant.of(state))
        return float(reference - outwards @ state.deformation)
