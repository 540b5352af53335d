"""The equations of one step but for contact: elasticity, inertia, supports and loads."""

from dataclasses import dataclass
from operator import is_not
from typing import TYPE_CHECKING

import numpy as np
from scipy.sparse import csc_array

from integration.arrays import Floats
from nmm.assembly.model import Model
from nmm.assembly.motion import State
from nmm.effects.base import Instant
from nmm.stepping.integrators import Integrator
from nmm.stepping.relay import Laid

if TYPE_CHECKING:
    from nmm.effects.inertia import Inertia


@dataclass(frozen=True)
class Equations:
    """``matrix @ d = force`` for the unknowns ``d`` of a step.

    Attributes
    ----------
    state, end
        Where the step starts, and when it ends.
    step
        Its length (s); None in statics.
    rule
        How rates follow from the increment.
    matrix, force
        (n, n) and (n,).
    """

    state: State
    end: Instant
    step: float | None
    rule: Integrator
    matrix: csc_array
    force: Floats


class Assembly:
    """Makes the equations of steps; a matrix of the same parts is the same object."""

    def __init__(self, laid: Laid) -> None:
        self._laid = laid
        self._kept: tuple[float, tuple[csc_array, csc_array], csc_array] | None = None
        self._weighted: tuple[csc_array, float, csc_array] | None = None
        self._soft: tuple[Model, csc_array] | None = None

    def of(
        self, state: State, end: Instant, step: float | None, rule: Integrator, anchored: bool
    ) -> Equations:
        """Return the equations of a step; ``anchored``: see `nmm.stepping.loose`."""
        model, plan = self._laid.model, self._laid.plan
        force = self._applied(state, end)
        if step is None or plan.inertia is None:
            held = self._anchored() if anchored else model.stiffness
            return Equations(state, end, step, rule, plan.matrix(state, held), force)
        matrix, force = self._in_time(state, step, rule, plan.inertia, force)
        return Equations(state, end, step, rule, matrix, force)

    def _applied(self, state: State, end: Instant) -> Floats:
        """Return the forces (n,) of all effects less those of elasticity at the start."""
        model, plan = self._laid.model, self._laid.plan
        return np.asarray(plan.force(state, end) - model.stiffness @ state.deformation)

    def _in_time(
        self, state: State, step: float, rule: Integrator, inertia: "Inertia", force: Floats
    ) -> tuple[csc_array, Floats]:
        """Return matrix and force with inertia, over the factor of contact forces."""
        plan, weight = self._laid.plan, rule.end_weight
        if weight < 1:
            earlier = self._applied(state, Instant(state.time, state.load_factor))
            force = weight * force + (1 - weight) * earlier
        velocity = rule.kinetic_factor * state.velocity
        momentum = rule.momentum(velocity, state.acceleration, step)
        base = self._base(rule.mass_factor(step) / weight, inertia.mass)
        share = 1.0 if plan.contact is None else rule.contact_factor
        matrix = self._times(weight / share, plan.matrix(state, base))
        return matrix, (force + inertia.mass @ momentum) / share

    def _anchored(self) -> csc_array:
        """Return elasticity with anchors."""
        model = self._laid.model
        if self._soft is None or self._soft[0] is not model:
            from nmm.stepping.loose import anchors

            self._soft = model, csc_array(model.stiffness + anchors(model))
        return self._soft[1]

    def _base(self, mass_factor: float, mass: csc_array) -> csc_array:
        """Return elasticity and inertia, which stay as long as the step's length does."""
        parts = (self._laid.model.stiffness, mass)
        kept = self._kept
        if kept is None or kept[0] != mass_factor or any(map(is_not, kept[1], parts)):
            kept = mass_factor, parts, csc_array(parts[0] + mass_factor * mass)
            self._kept = kept
        return kept[2]

    def _times(self, factor: float, matrix: csc_array) -> csc_array:
        """Return ``factor * matrix``."""
        if factor == 1:
            return matrix
        kept = self._weighted
        if kept is None or kept[0] is not matrix or kept[1] != factor:
            kept = self._weighted = matrix, factor, csc_array(factor * matrix)
        return kept[2]
