"""The stress of an effect on bodies that bend by any angle: it turns and stretches with them."""

from collections.abc import Callable
from functools import partial
from typing import Self

from integration.arrays import Floats
from nmm.assembly.finite_strain.finite_matter import finite_matter
from nmm.assembly.finite_strain.given_stress import GivenStress
from nmm.assembly.model import Model
from nmm.assembly.motion import State
from nmm.assembly.stress_points import StressAt
from nmm.effects.base import Instant, Span, StepForce


class TurningStress:
    """A stress that is given at material points.

    Parameters
    ----------
    given
        What stresses at the points do.
    at
        From a time of the run (s) to the stress (Q, 3).
    """

    def __init__(self, given: GivenStress, at: Callable[[float], Floats]) -> None:
        self._given, self._at = given, at

    @classmethod
    def of(cls, model: Model, stress_at: StressAt, stands: bool = False) -> Self:
        """Return that of an effect, see `Effect.stress_at`; one that ``stands`` is asked once."""
        matter = finite_matter(model)
        rule = matter.points.rule
        at = partial(stress_at, rule.owner, rule.points)
        if stands:
            once = at(0.0)
            return cls(GivenStress(matter), lambda time: once)
        return cls(GivenStress(matter), at)

    def force(self, state: State, end: Instant) -> Floats:
        """See `Effect.force`."""
        return -self._given.force(self._at(end.time), state.deformation)

    def step_force(self, before: State, after: State, span: Span) -> StepForce:
        """See `Effect.step_force`: by the means of both ends in time, which conserve energy."""
        stress, ends, share = self._at(after.time), [after.deformation], 1.0
        if span.weight < 1:
            stress, share = (self._at(before.time) + stress) / 2, 0.5
            ends.append(before.deformation)
        force = -self._given.force(stress, *ends)
        return StepForce(force, lambda: self._given.stiffness(stress, share))

    def energy(self, state: State) -> float:
        """Energy (J) that it adds to that of the strain."""
        return self._given.energy(self._at(state.time), state.deformation)

    def work(self, before: State, after: State) -> float:
        """Work (J) of the change of the stress, on the mean strain of both ends."""
        change = self._at(after.time) - self._at(before.time)
        ends = (self._given.energy(change, one.deformation) for one in (before, after))
        return sum(ends) / 2

    def mean(self, state: State) -> Floats:
        """Mean Cauchy stress (E, 3) of the elements in global axes (Pa)."""
        return self._given.mean(self._at(state.time), state.deformation)
