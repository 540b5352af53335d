"""Stress of an effect in finite strain, where it turns and stretches with the material."""

from collections.abc import Callable
from functools import partial
from typing import Self

from integration.arrays import Floats
from nmm.assembly.finite_strain.given_stress import GivenStress
from nmm.assembly.model import Model
from nmm.assembly.state import State
from nmm.assembly.stress_points import StressAt
from nmm.effects.base import Instant, Span, StepForce


class TurningStress:
    """A stress given at the material points.

    Parameters
    ----------
    given
        Forces, stiffness and energy of stresses at the points.
    at
        Function of time (s) that returns the stress (Q, 3) (Pa).
    """

    def __init__(self, given: GivenStress, at: Callable[[float], Floats]) -> None:
        self._given, self._at = given, at

    @classmethod
    def of(cls, model: Model, stress_at: StressAt, constant: bool = False) -> Self:
        """Return the stress of an effect by its `Effect.stress_at`, called once if ``constant``."""
        matter = model.finite_matter
        rule = matter.points.rule
        at = partial(stress_at, rule.owner, rule.points)
        if constant:
            once = at(0.0)
            return cls(GivenStress(matter), lambda time: once)
        return cls(GivenStress(matter), at)

    def force(self, state: State, end: Instant) -> Floats:
        """See `Effect.force`."""
        return -self._given.force(self._at(end.time), state.deformation)

    def step_force(self, before: State, after: State, span: Span) -> StepForce:
        """See `Effect.step_force`: in time, the means of both ends, which conserve energy."""
        stress, ends, share = self._at(after.time), [after.deformation], 1.0
        if span.weight < 1:
            stress, share = (self._at(before.time) + stress) / 2, 0.5
            ends.append(before.deformation)
        force = -self._given.force(stress, *ends)
        return StepForce(force, lambda: self._given.stiffness(stress, share))

    def energy(self, state: State) -> float:
        """Energy (J) that it adds to the elastic one."""
        return self._given.energy(self._at(state.time), state.deformation)

    def work(self, before: State, after: State) -> float:
        """Work (J) of the change of the stress at the mean strain of both ends."""
        change = self._at(after.time) - self._at(before.time)
        ends = (self._given.energy(change, one.deformation) for one in (before, after))
        return sum(ends) / 2

    def mean(self, state: State) -> Floats:
        """Mean Cauchy stress (E, 3) of the elements in global axes (Pa)."""
        return self._given.mean(self._at(state.time), state.deformation)
