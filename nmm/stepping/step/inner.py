"""Forces that bend within a step: of matter that is not linear, and of effects that are not.

Effects stand in the equations of a step with their line at its start (`Effect.force`, `matrix`).
What their force through the step has beyond it joins the internal forces, over the weight that the
integrator gives to the end of the step, so that it enters the step as it is.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache, partial
from typing import TYPE_CHECKING, cast

import numpy as np
from scipy.sparse import csc_array

from integration.arrays import Floats
from nmm.assembly.kinematics import Kinematics
from nmm.assembly.matter import STRESS
from nmm.assembly.motion import State, coordinate_rounding
from nmm.effects.base import Instant, Span, StepForce, defines
from nmm.integrators.base import Integrator
from nmm.model.discretisation import Current
from nmm.stepping.step.clock import Clock
from nmm.stepping.step.equations import BALANCED

if TYPE_CHECKING:
    from nmm.assembly.finite_strain.finite_matter import FiniteMatter

# Out-of-balance force of a step whose energy is kept: what it leaves adds up over steps.
CONSERVED = 1e-13
# Share of the largest stress by which one that stays is off for rounding.
STAYS = 1e-13
# Forces of effects below this share of those of a step count as so large.
HARDLY = 1e-6
# What effects miss is rounding up to so many times that of their stiffness times the motion.
ROUNDED_STIFFNESS = 1e3 * float(np.finfo(float).eps)
# ... and up to so many times what rounding of places makes of their forces.
ROUNDED_FORCES = 10.0


@dataclass(frozen=True)
class InnerPart:
    """Internal force (n,) of one kind at an iterate, and what makes its tangent (n, n)."""

    force: Floats
    make: Callable[[], csc_array]

    @cached_property
    def stiffness(self) -> csc_array:
        """Tangent (n, n)."""
        return self.make()

    def missed(self, now: "InnerPart", way: Floats) -> Floats:
        """What the tangent of another iterate, ``way`` (n,) from here, missed of the force (n,)."""
        return np.asarray(self.force - now.force - now.stiffness @ way)


@dataclass(frozen=True)
class Iterate:
    """An increment (n,) of the step with its internal forces.

    Attributes
    ----------
    matter, effects
        Their parts; of effects beyond their line at the start of the step.
    pull
        (n,) force of effects through the step.
    rounding
        (n,) what of it rounding of places makes.
    history, memory
        What matter and effects remember at the end of the step.
    """

    increment: Floats
    matter: InnerPart
    effects: InnerPart
    pull: Floats
    rounding: Floats
    history: Mapping[str, Floats]
    memory: Mapping[str, Floats]

    @property
    def force(self) -> Floats:
        """(n,) of both."""
        return self.matter.force + self.effects.force

    @property
    def stiffness(self) -> csc_array:
        """(n, n) of both; that of matter itself where effects add nothing."""
        if not self.effects.stiffness.nnz:
            return self.matter.stiffness
        return csc_array(self.matter.stiffness + self.effects.stiffness)

    def with_tangent_of(self, other: "Iterate") -> "Iterate":
        """Return the iterate with the tangent that effects have at another one."""
        known = other.effects
        effects = InnerPart(self.effects.force, lambda: known.stiffness)
        return replace(self, effects=effects)


class Inner:
    """Internal forces of one step that starts at a state.

    Parameters
    ----------
    kinematics
        How bodies move.
    symmetric
        Whether tangents are to be.

    Attributes
    ----------
    start
        (n,) internal force of matter at the start of the step.
    elastic
        (n, n) elastic stiffness of matter.
    symmetric
        Whether tangents are.
    flows
        Whether matter may flow.
    searches
        Whether iterations are shortened where forces overshoot: not under finite strain, whose
        tangents foresee how slender bodies stretch as they turn.
    tolerance
        Out-of-balance force, as a share of the forces, at which an iterate is the solution.
    """

    def __init__(
        self,
        current: Current,
        state: State,
        end: Instant,
        step: float | None,
        rule: Integrator,
        kinematics: Kinematics,
        symmetric: bool,
        clock: Clock,
    ) -> None:
        self._model, self._plan, self._clock = current.model, current.plan, clock
        self._state, self._end, self._step, self._kinematics = state, end, step, kinematics
        weight = 1.0 if step is None else rule.end_weight
        self._span = Span(step, weight, half=step is not None and not rule.carries)
        matter = self._model.matter
        self.flows = matter is not None and matter.flows
        self._conserves = step is not None and rule.conserves
        self.tolerance = CONSERVED if self._conserves else BALANCED
        self.searches = matter is None or matter.flows
        even = matter is None or (matter.symmetric and not self._conserves)
        self._even = all(one.symmetric for one in self._plan.bent.values())
        self.symmetric = symmetric or (even and self._even)
        if matter is None:
            self.elastic = self._model.stiffness
            self.start = self.elastic @ state.deformation
        else:
            self.elastic = matter.elastic_stiffness
            self.start = self._model.internal(state)
        self._lines = {name: self._line(name) for name in self._plan.bent}
        self._lined = all(defines(one, "matrix") for one in self._plan.bent.values())

    def _line(self, name: str) -> tuple[Floats, csc_array]:
        """Force (n,) and matrix (n, n) of an effect in the equations of the step."""
        effect, n = self._plan.bent[name], len(self.start)
        matrix = effect.matrix(self._state) if defines(effect, "matrix") else csc_array((n, n))
        if not defines(effect, "force"):
            return np.zeros(n), matrix
        force, weight = effect.force(self._state, self._end), self._span.weight
        if weight < 1 and not effect.steady:
            begun = effect.force(self._state, Instant.of(self._state))
            force = weight * force + (1 - weight) * begun
        return force, matrix

    def at(
        self, increment: Floats, before: Iterate | None = None, after: State | None = None
    ) -> Iterate:
        """Return the internal forces at an increment (n,) of the step.

        ``before`` is the iterate from which it was found, ``after`` the state that it leads to
        where that is known.

        Raises
        ------
        SolveError
            Where an effect has none.
        """
        with self._clock.phase("material"):
            matter, history = self._of_matter(increment, before)
        if self._lined and not increment.any():
            return self._first(increment, matter, history)
        pulls = self._pulls(increment, after)
        memory = dict(self._state.memory)
        total, beyond, rounding = (np.zeros_like(increment) for _ in range(3))
        for name, one in pulls.items():
            start, matrix = self._lines[name]
            total = total + one.force
            beyond = beyond + (start - one.force) / self._span.weight - matrix @ increment
            memory |= one.memory
            if one.rounding is not None:
                rounding += np.abs(one.rounding)
        effects = InnerPart(beyond, lambda: self._beyond(pulls))
        return Iterate(increment, matter, effects, total, rounding, history, memory)

    def _first(self, still: Floats, matter: InnerPart, history: Mapping[str, Floats]) -> Iterate:
        """Return the iterate at no increment, where effects are on their lines."""
        zero = np.zeros_like(still)
        pull = sum((force for force, _ in self._lines.values()), start=zero)
        effects = InnerPart(zero, partial(_nothing, len(still)))
        return Iterate(still, matter, effects, pull, zero, history, self._state.memory)

    def imbalance(
        self,
        now: Iterate,
        then: Iterate,
        scale: Floats,
        applied: Floats,
        touching: Floats | None = None,
    ) -> float:
        """Return what the tangents at ``now`` missed at ``then``, as a share of the forces.

        Effects are held to their own forces: those that hold supports may be far larger.
        ``scale`` (n,) are factors by which forces compare, ``applied`` (n,) those of the step,
        ``touching`` (n,) what contact missed of its own.
        """
        way, shares = then.increment - now.increment, [0.0]
        if self._model.matter is not None:
            missed = then.matter.missed(now.matter, way)
            if touching is not None:
                missed = missed + touching / self._span.weight
            size = max(_size(scale * one) for one in (then.matter.force, self.start, applied))
            shares.append(_size(scale * missed) / size if size else 0.0)
        if self._lines:
            missed = then.effects.missed(now.effects, way)
            known = now.pull, then.pull, HARDLY * applied
            size = max(_size(scale * one) for one in known)
            left = _size(scale * missed)
            rounded = (
                ROUNDED_STIFFNESS * self._gross(then.increment),
                ROUNDED_FORCES * then.rounding,
            )
            least = sum(_size(scale * one) for one in rounded)
            if left > least and left > least + ROUNDED_FORCES * _size(scale * self._of_places):
                shares.append(left / size if size else np.inf)
        return max(shares)

    def _gross(self, increment: Floats) -> Floats:
        """(n,) what stiffnesses of effects times the motion are made of."""
        return np.asarray(self._sizes @ np.abs(increment))

    @cached_property
    def _sizes(self) -> csc_array:
        """(n, n) sum of the entries of the stiffnesses of effects, without their signs."""
        matrices = [matrix for _, matrix in self._lines.values()]

        def made() -> csc_array:
            return sum((abs(one) for one in matrices), start=_nothing(len(self.start)))

        return self._plan.total("sizes of lines", matrices, made)

    @cached_property
    def _of_places(self) -> Floats:
        """(n,) what stiffnesses of effects make of a motion by the rounding of coordinates."""
        return self._gross(coordinate_rounding(self._model.manifold))

    def _of_matter(
        self, increment: Floats, before: Iterate | None
    ) -> tuple[InnerPart, Mapping[str, Floats]]:
        state, matter = self._state, self._model.matter
        whole = state.deformation + increment
        if matter is None:
            stiffness = self._model.stiffness
            return InnerPart(stiffness @ whole, lambda: stiffness), state.history
        if self._conserves:
            return self._conserving(whole), state.history
        last = None if before is None else state.deformation + before.increment
        answer = matter.at_rest(state.history) if before is None and not increment.any() else None
        if answer is None:
            answer = matter.update(whole, state.history, self._step or 0.0, last)
        stays = not increment.any() and _rounding(answer.stress, state.history.get(STRESS))
        force = self.start if stays else matter.force(whole, answer.stress)
        tangent = answer.tangent
        return InnerPart(force, lambda: matter.stiffness(tangent, self.symmetric)), answer.history

    def _conserving(self, whole: Floats) -> InnerPart:
        """Return the force that, weighed with that of the start, is the one of the whole step."""
        matter, weight = cast("FiniteMatter", self._model.matter), self._span.weight
        answer = matter.conserving(self._state.deformation, whole)
        force = matter.force(whole, answer.stress)
        tangent = answer.tangent / weight
        return InnerPart(
            (force - (1 - weight) * self.start) / weight,
            lambda: matter.stiffness(tangent, self.symmetric),
        )

    def _pulls(self, increment: Floats, after: State | None) -> dict[str, StepForce]:
        if not self._lines:
            return {}
        state = self._state
        if after is None:
            moved = self._kinematics.move(self._model, state, increment)
            after = replace(moved, time=self._end.time, load_factor=self._end.load_factor)
        return {name: self._plan.through(name, state, after, self._span) for name in self._lines}

    def _beyond(self, pulls: Mapping[str, StepForce]) -> csc_array:
        """Stiffness of effects beyond their matrices in the equations."""
        total = csc_array(self.elastic.shape)
        for name, one in pulls.items():
            total = total + one.stiffness() / self._span.weight - self._lines[name][1]
        return csc_array((total + total.T) / 2 if self.symmetric and not self._even else total)


@lru_cache(maxsize=2)
def _nothing(n: int) -> csc_array:
    """Return the matrix (n, n) without entries, which nobody changes."""
    return csc_array((n, n))


def _rounding(stress: Floats, known: Floats | None) -> bool:
    """Whether a stress is one that is known, to rounding."""
    if known is None:
        return False
    if stress is known:
        return True
    off, size = (float(np.abs(one).max(initial=0.0)) for one in (stress - known, known))
    return off <= STAYS * size


def _size(force: Floats) -> float:
    return float(np.linalg.norm(force))
