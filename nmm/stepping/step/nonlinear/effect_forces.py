"""Nonlinear forces of effects within a step.

Effects stand in the equations of a step with their line at its start (`Effect.force`, `matrix`).
What their force through the step has beyond it joins the internal forces, over the weight that the
integrator gives to the end of the step, so that it enters the step as it is. Under a rule without
such a weight, an explicit one, forces are those of the start.
"""

from collections.abc import Mapping
from dataclasses import replace
from functools import cached_property, lru_cache, partial

import numpy as np
from scipy.sparse import csc_array

from integration.arrays import Floats
from nmm.assembly.moving.kinematics import Kinematics
from nmm.assembly.moving.motion import coordinate_rounding
from nmm.assembly.state import State
from nmm.effects.base import Instant, Span, StepForce, defines
from nmm.model.discretisation import CurrentDiscretisation
from nmm.stepping.step.nonlinear.iterate import EffectPart, size

# Forces of effects below this share of those of a step count as so large.
HARDLY = 1e-6
# What effects miss is rounding up to so many times that of their stiffness times the motion.
ROUNDED_STIFFNESS = 1e3 * float(np.finfo(float).eps)
# ... and up to so many times what rounding of places makes of their forces.
ROUNDED_FORCES = 10.0


class EffectForces:
    """Forces of effects, beyond their lines, in one step that starts at a state.

    Parameters
    ----------
    kinematics
        How bodies move.
    symmetrised
        Whether the symmetric part of the tangent is taken.
    """

    def __init__(
        self,
        current: CurrentDiscretisation,
        state: State,
        end: Instant,
        span: Span,
        kinematics: Kinematics,
        symmetrised: bool,
    ) -> None:
        self._model, self._plan, self._kinematics = current.model, current.plan, kinematics
        self._state, self._end, self._span = state, end, span
        self._symmetrised, self._n = symmetrised, len(state.deformation)
        self._lines = {name: self._line(name) for name in self._plan.bent}
        self._lined = all(defines(one, "matrix") for one in self._plan.bent.values())

    def _line(self, name: str) -> tuple[Floats, csc_array]:
        """Force (n,) and matrix (n, n) of an effect in the equations of the step."""
        effect, n = self._plan.bent[name], self._n
        force = np.zeros(n)
        if defines(effect, "force"):  # before the matrix, which may depend on the end of the step
            force, weight = effect.force(self._state, self._end), self._span.weight
            if weight < 1 and not effect.steady:
                begun = effect.force(self._state, Instant.of(self._state))
                force = weight * force + (1 - weight) * begun
        return force, effect.matrix(self._state) if defines(effect, "matrix") else _nothing(n)

    def at(self, increment: Floats, after: State | None) -> tuple[EffectPart, Mapping[str, Floats]]:
        """Return the forces at an increment (n,) of the step, and what effects then remember.

        ``after`` is the state that it leads to, where that is known. A correction of statics that
        moves nothing still remembers what its step did: its memory is that of the step's start.

        Raises
        ------
        SolveError
            Where an effect has none.
        """
        if self._lined and after is None and not increment.any():
            return self._first(), self._state.memory
        pulls = self._pulls(increment, after)
        memory = dict(self._state.memory)
        if not self._span.weight:
            for one in pulls.values():
                memory |= one.memory
            return self._first(), memory
        total, beyond, rounding = (np.zeros_like(increment) for _ in range(3))
        for name, one in pulls.items():
            start, matrix = self._lines[name]
            total = total + one.force
            beyond = beyond + (start - one.force) / self._span.weight - matrix @ increment
            memory |= one.memory
            if one.rounding is not None:
                rounding += np.abs(one.rounding)
        return EffectPart(beyond, lambda: self._beyond(pulls), total, rounding), memory

    def _first(self) -> EffectPart:
        """Return the forces at no increment, where effects are on their lines."""
        zero = np.zeros(self._n)
        pull = sum((force for force, _ in self._lines.values()), start=zero)
        return EffectPart(zero, partial(_nothing, self._n), pull, zero)

    def _pulls(self, increment: Floats, after: State | None) -> dict[str, StepForce]:
        if not self._lines:
            return {}
        state = self._state
        if after is None:
            moves = increment.any()  # else places stay those that effects know
            moved = self._kinematics.move(self._model, state, increment) if moves else state
            after = replace(moved, time=self._end.time, load_factor=self._end.load_factor)
        return {name: self._plan.step_force(name, state, after, self._span) for name in self._lines}

    def _beyond(self, pulls: Mapping[str, StepForce]) -> csc_array:
        """Stiffness of effects beyond their matrices in the equations; kept with its parts."""
        weight, even = self._span.weight, self._symmetrised
        pairs = [(one.stiffness(), self._lines[name][1]) for name, one in pulls.items()]

        def made() -> csc_array:
            total = csc_array((self._n, self._n))
            for stiffness, matrix in pairs:
                total = total + stiffness / weight - matrix
            return csc_array((total + total.T) / 2) if even else total

        name = f"beyond lines, {weight}, {even}"
        return self._plan.total(name, [one for pair in pairs for one in pair], made)

    def imbalance(
        self,
        now: EffectPart,
        then: EffectPart,
        way: Floats,
        increment: Floats,
        scale: Floats,
        applied: Floats,
    ) -> float:
        """Return what the tangent at ``now`` missed at ``then``; see `InternalForces.imbalance`.

        ``increment`` (n,) is that of ``then``.
        """
        if not self._lines:
            return 0.0
        left = size(scale * then.missed(now, way))
        rounded = ROUNDED_STIFFNESS * self._gross(increment), ROUNDED_FORCES * then.rounding
        least = sum(size(scale * one) for one in rounded)
        if left <= least or left <= least + ROUNDED_FORCES * size(scale * self._of_places):
            return 0.0
        whole = max(size(scale * one) for one in (now.pull, then.pull, HARDLY * applied))
        return left / whole if whole else np.inf

    def _gross(self, increment: Floats) -> Floats:
        """(n,) what stiffnesses of effects times the motion are made of."""
        return np.asarray(self._sizes @ np.abs(increment))

    @cached_property
    def _sizes(self) -> csc_array:
        """(n, n) sum of the entries of the stiffnesses of effects, without their signs."""
        matrices = [matrix for _, matrix in self._lines.values()]

        def made() -> csc_array:
            return sum((abs(one) for one in matrices), start=_nothing(self._n))

        return self._plan.total("sizes of lines", matrices, made)

    @cached_property
    def _of_places(self) -> Floats:
        """(n,) what stiffnesses of effects make of a motion by the rounding of coordinates."""
        return self._gross(coordinate_rounding(self._model.manifold))


@lru_cache(maxsize=2)
def _nothing(n: int) -> csc_array:
    """Return the matrix (n, n) without entries, which nobody changes."""
    return csc_array((n, n))
