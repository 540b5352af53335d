"""Internal forces of matter in a step, linear or not."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, cast

import numpy as np

from integration.arrays import Floats
from nmm.assembly.laws_at_points import STRESS, SWELLING
from nmm.assembly.model import Model
from nmm.assembly.state import State
from nmm.solvers.unchecked import product
from nmm.stepping.step.nonlinear.iterate import InternalForcePart, size

if TYPE_CHECKING:
    from nmm.assembly.finite_strain.finite_matter import FiniteMatter

# Share of the largest stress by which one that stays is off for rounding.
STAYS = 1e-13


class MatterForces:
    """Internal forces of matter in one step that starts at a state.

    Parameters
    ----------
    step
        Length of the step (s); None in statics.
    weight
        Weight of the end of the step in its equations.
    conserves
        Whether forces are those of the whole step, which keep energy.
    symmetric
        Whether tangents are to be.
    swelling
        (Q, 1) strain of material points at the end of the step, free of stress; None is none.

    Attributes
    ----------
    start
        (n,) internal force at the start of the step.
    elastic
        (n, n) elastic stiffness.
    """

    def __init__(
        self,
        model: Model,
        state: State,
        step: float | None,
        weight: float,
        conserves: bool,
        symmetric: bool,
        swelling: Floats | None = None,
    ) -> None:
        self._model, self._state, self._step = model, state, step
        self._weight, self._conserves, self._symmetric = weight, conserves, symmetric
        self.elastic = model.elastic_stiffness
        if model.matter is None:
            self.start = product(self.elastic, state.deformation)
        else:
            self.start = model.internal(state)
        self._history = _swollen(state.history, swelling)

    def at(
        self, increment: Floats, before: Floats | None
    ) -> tuple[InternalForcePart, Mapping[str, Floats]]:
        """Return the forces at an increment (n,) of the step, and what matter then remembers.

        ``before`` (n,) is the increment of the last iterate; None in the first one.
        """
        state, matter = self._state, self._model.matter
        whole = state.deformation + increment
        if matter is None:
            stiffness = self._model.stiffness
            return InternalForcePart(product(stiffness, whole), lambda: stiffness), state.history
        if self._conserves:
            return self._conserving(whole), state.history
        last = None if before is None else state.deformation + before
        rests = before is None and not increment.any() and self._history is state.history
        answer = matter.at_rest(state.history) if rests else None
        if answer is None:
            answer = matter.update(whole, self._history, self._step or 0.0, last)
        stays = not increment.any() and _rounding(answer.stress, state.history.get(STRESS))
        force = self.start if stays else matter.force(whole, answer.stress)
        tangent = answer.tangent
        return InternalForcePart(
            force, lambda: matter.stiffness(tangent, self._symmetric)
        ), answer.history

    def _conserving(self, whole: Floats) -> InternalForcePart:
        """Return the force that, weighed with that of the start, is the one of the whole step."""
        matter, weight = cast("FiniteMatter", self._model.matter), self._weight
        answer = matter.conserving(self._state.deformation, whole)
        force = matter.force(whole, answer.stress)
        tangent = answer.tangent / weight
        return InternalForcePart(
            (force - (1 - weight) * self.start) / weight,
            lambda: matter.stiffness(tangent, self._symmetric),
        )

    def imbalance(
        self,
        now: InternalForcePart,
        then: InternalForcePart,
        way: Floats,
        scale: Floats,
        applied: Floats,
        touching: Floats | None,
    ) -> float:
        """Return what the tangent at ``now`` missed at ``then``; see `InternalForces.imbalance`."""
        if self._model.matter is None:
            return 0.0
        missed = then.missed(now, way)
        if touching is not None:
            missed = missed + touching / self._weight
        whole = max(size(scale * one) for one in (then.force, self.start, applied))
        return size(scale * missed) / whole if whole else 0.0


def _swollen(history: Mapping[str, Floats], swelling: Floats | None) -> Mapping[str, Floats]:
    """Return what matter remembers with what it swells by at the end; the same where that stays."""
    if swelling is None or np.array_equal(history.get(SWELLING, 0.0 * swelling), swelling):
        return history
    return {**history, SWELLING: swelling}


def _rounding(stress: Floats, known: Floats | None) -> bool:
    """Whether a stress is one that is known, to rounding."""
    if known is None:
        return False
    if stress is known:
        return True
    off, largest = (float(np.abs(one).max(initial=0.0)) for one in (stress - known, known))
    return off <= STAYS * largest
