"""Springs whose mean force over a step conserves energy, also while contacts close or open.

A spring that pushes alone has the energy ``V = k min(g, 0)^2 / 2``. Through a step from ``g0`` to
``g1`` it pushes with ``N = (V(g1) - V(g0)) / (g1 - g0)`` (Simo and Tarnow 1992), that is

    k (g0 + g1) / 2              closed at both ends,
    k g1^2 / (2 (g1 - g0))       closing,
    -k g0^2 / (2 (g1 - g0))      opening.

It grows with ``g1`` and is differentiable, so that a contact problem gets its tangent at a
predicted gap. Repeated with the gap that was found this is Newton's method.
"""

from dataclasses import dataclass, replace

import numpy as np

from integration.arrays import Bools, Floats
from nmm.contact.laws.time_weighting import TimeWeighting
from nmm.contact.problem.step_problem import StepAnswer, StepProblem

# Least slope of a line, as a share of the spring: one without would be no spring.
LEAST = 1e-6


@dataclass(frozen=True)
class ConservingSprings(TimeWeighting):
    """Midpoint springs; those that only push are linearised at a predicted gap.

    Attributes
    ----------
    foreseen
        (m,) predicted gaps at the end of the step (m), counted as those of the problem.
    lifted
        (m,) predicted lift of the faces by sliding (m).
    """

    foreseen: Floats
    lifted: Floats

    def apply(self, problem: StepProblem) -> StepProblem:
        found = super().apply(problem)
        lines, slope = self._lines(problem), found.normal_stiffness.copy()
        slope[lines] = self._slope(problem)[lines]
        return replace(found, normal_stiffness=slope)

    def missed(self, answer: StepAnswer, problem: StepProblem, damper: Floats | float) -> Floats:
        """Error (m,) of the linearised force at the gap that was found (N)."""
        true = mean_force(problem.normal_stiffness, *self._stretches(problem, answer.gap))
        true = np.minimum(true + damper, 0.0)
        return np.where(self._acts, true - answer.normal_force, 0.0)

    @property
    def _acts(self) -> Bools:
        """Which springs have the potential above: they only push, and act at the midpoint."""
        return np.asarray(~self.pulls & (self.weight == 0.5))

    def _lines(self, problem: StepProblem) -> Bools:
        """Which springs close or open between the start and the predicted end."""
        start, end = self._stretches(problem, self.foreseen)
        return np.asarray(self._acts & ((start < 0) != (end < 0)))

    def _slope(self, problem: StepProblem) -> Floats:
        stiffness = problem.normal_stiffness
        slope = force_slope(stiffness, *self._stretches(problem, self.foreseen))
        return np.maximum(slope, LEAST * stiffness)

    def _stretches(self, problem: StepProblem, end: Floats) -> tuple[Floats, Floats]:
        """Return stretches (m,) at the start and at gaps (m,) of the end (m)."""
        return problem.gap - self.lift, end - self.lifted

    def _lead(self, problem: StepProblem) -> Floats:
        force = mean_force(problem.normal_stiffness, *self._stretches(problem, self.foreseen))
        line = force / self._slope(problem) - self.foreseen
        return np.where(self._lines(problem), line + self.lifted, super()._lead(problem))


def mean_force(stiffness: Floats, start: Floats, end: Floats) -> Floats:
    """Return the force (m,) of springs through a step between two stretches (m)."""
    low, high = np.minimum(start, 0.0), np.minimum(end, 0.0)
    way = end - start
    both = (start < 0) == (end < 0)
    share = np.divide(high - low, way, out=np.ones_like(way), where=~both & (way != 0))
    return np.asarray(stiffness * (low + high) / 2 * share)


def force_slope(stiffness: Floats, start: Floats, end: Floats) -> Floats:
    """Return its derivative (m,) by the stretch at the end."""
    closed, way = end < 0, end - start
    way = np.where(way == 0, 1.0, way)
    change = np.where(closed, end * (end - 2 * start), start**2) / way**2
    free = (start >= 0) & (end >= 0)
    both = (start < 0) & closed
    return np.asarray(stiffness / 2 * np.where(both, 1.0, np.where(free, 0.0, change)))
