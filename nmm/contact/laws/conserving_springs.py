"""Springs whose mean force over a step does the work that they store, closing and opening too.

A spring that pushes alone has the energy ``V = k min(g, 0)^2 / 2``. Through a step from ``g0`` to
``g1`` it pushes with ``N = (V(g1) - V(g0)) / (g1 - g0)`` (Simo and Tarnow 1992), that is

    k (g0 + g1) / 2              closed at both ends,
    k g1^2 / (2 (g1 - g0))       closing,
    -k g0^2 / (2 (g1 - g0))      opening.

It grows with ``g1`` and has a slope everywhere, so that a problem of contact gets the line at a gap
that is foreseen, and iterations that foresee better find the force (Newton's method).
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
    """Springs of the mean of both ends, those that push alone by the line at a gap.

    Attributes
    ----------
    foreseen
        (m,) gaps at the end of the step (m), from references as those of the problem.
    lifted
        (m,) by how much sliding will have lifted the faces there (m).
    """

    foreseen: Floats
    lifted: Floats

    def apply(self, problem: StepProblem) -> StepProblem:
        """See `Transform.apply`."""
        found = super().apply(problem)
        lines, slope = self._lines(problem), found.normal_stiffness.copy()
        slope[lines] = self._slope(problem)[lines]
        return replace(found, normal_stiffness=slope)

    def missed(self, answer: StepAnswer, problem: StepProblem, damper: Floats | float) -> Floats:
        """Force (m,) at the gap that was found less that of the line which found it (N)."""
        true = mean_force(problem.normal_stiffness, *self._stretches(problem, answer.gap))
        true = np.minimum(true + damper, 0.0)
        return np.where(self._acts, true - answer.normal_force, 0.0)

    @property
    def _acts(self) -> Bools:
        """Which springs have the potential above: they push alone, on the mean of both ends."""
        return np.asarray(~self.pulls & (self.weight == 0.5))

    def _lines(self, problem: StepProblem) -> Bools:
        """Which springs close or open from the start to what is foreseen."""
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
