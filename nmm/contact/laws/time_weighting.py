"""Springs of contacts stretched by a weighted mean of the start and the end of a step.

A spring of stiffness ``k`` whose gap goes from ``g0`` to ``g1`` pushes through the whole step with

    N = k min(w g1 + (1 - w) min(g0, 0), 0),        1/2 <= w <= 1.

Its work ``N (g1 - g0)`` never exceeds what the spring gives back, ``k min(g0, 0)^2 / 2`` less
``k min(g1, 0)^2 / 2``: closed at both ends it misses it by ``(w - 1/2) k (g1 - g0)^2``, closing by
at least ``w k |g1| g0``, opening by the rest of what was stored. So no step gains energy, however
stiff the spring and long the step, and with ``w = 1/2`` a contact that stays closed keeps all of
it. The same holds of shear springs that slide at a limit. ``w = 1`` is Shi's spring.
"""

from dataclasses import dataclass

import numpy as np

from integration.arrays import Bools, Floats
from nmm.contact.problem.step_problem import BROKEN, OPEN, StepAnswer, StepProblem
from nmm.contact.problem.transform import Transform
from nmm.frozen import with_parts


@dataclass(frozen=True)
class TimeWeighting(Transform):
    """Springs stretched by a weighted mean of the start and the end of the step.

    Attributes
    ----------
    weight
        (m,) weight of the end of the step.
    lift
        (m,) lift of the faces by sliding at the start (m), which does not stretch the spring.
    pulls
        (m,) whose springs pull at the start, as intact bonds do; the others push alone.
    """

    weight: Floats
    lift: Floats
    pulls: Bools

    def apply(self, problem: StepProblem) -> StepProblem:
        return with_parts(
            problem,
            normal_stiffness=self.weight * problem.normal_stiffness,
            shear_stiffness=self.weight * problem.shear_stiffness,
            gap=problem.gap + self._lead(problem),
            slip=problem.slip / self.weight,
        )

    def undo(self, answer: StepAnswer, problem: StepProblem) -> StepAnswer:
        """Return the answer with the gap and the elastic slip at the end of the step."""
        parted = (answer.state == OPEN) | (answer.state == BROKEN)
        lead = (1 / self.weight - 1) * problem.slip
        slip = np.where(parted, answer.slip, answer.slip - lead)
        return with_parts(answer, gap=answer.gap - self._lead(problem), slip=slip)

    def missed(
        self, answer: StepAnswer, problem: StepProblem, damper: Floats | float
    ) -> Floats | None:
        """Return the error (m,) of linearised spring forces; None, for these springs are linear.

        ``damper`` (m,) is the force beside each spring (N).
        """
        return None

    def _lead(self, problem: StepProblem) -> Floats:
        stretch = problem.gap - self.lift
        carried = np.where(self.pulls, stretch, np.minimum(stretch, 0.0))
        return np.asarray((1 / self.weight - 1) * carried)


@dataclass(frozen=True)
class RaisedFaces(Transform):
    """Dilation: faces ride up on each other as they slide, and gaps are counted from there.

    Attributes
    ----------
    lift
        (m,) at the end of the step (m).
    """

    lift: Floats

    def apply(self, problem: StepProblem) -> StepProblem:
        return with_parts(problem, gap=problem.gap - self.lift)

    def undo(self, answer: StepAnswer, problem: StepProblem) -> StepAnswer:
        return with_parts(answer, gap=answer.gap + self.lift)


def end_shares(weight: float, exact: bool, own: Bools, soft: Bools) -> Floats:
    """Weight (m,) of the end of the step in the stretch of each contact.

    Exact contacts, which are no springs, and softening bonds act as at the end of the step.
    """
    return np.where(soft | (exact & ~own), 1.0, weight)
