"""In time the cohesion of a joint without bond is lost a step after the joint has opened.

Such a joint carries ``c`` along itself while it is closed and nothing once it is open, however
little either is. A step that has to choose may have no answer: with the cohesion the block turns
and opens the joint, without it it falls back and closes it. The solution of such laws (Filippov
1960) is a share of the cohesion, which steps find in turns of with and without it when each goes
by what the joint was at its start; the error is that of one step. Statics takes the law as it is.
"""

from dataclasses import dataclass
from typing import Self

import numpy as np

from integration.arrays import Bools, Floats
from integration.contraction import some
from nmm.contact.points.contact_points import ContactPoints
from nmm.contact.problem.step_problem import BROKEN, OPEN, Limits, StepAnswer, StepProblem
from nmm.contact.problem.transform import Transform
from nmm.frozen import with_parts

# Joints that are open by less than this share of their length are closed but for rounding.
CLOSED = 1e-9
# Pull beside the cohesion up to which a point counts as joined to the end of the step.
ADHERES = 1e-9


@dataclass(frozen=True)
class LateCohesion(Transform):
    """Cohesion of joints without bond, fixed for a step by whether they are closed at its start.

    Attributes
    ----------
    unbonded
        (m,) joints without bond that have a cohesion.
    cohesion
        (m,) theirs in this step (N), none where they are open at its start.
    """

    unbonded: Bools
    cohesion: Floats

    @classmethod
    def of(cls, limits: Limits, contacts: ContactPoints) -> Self | None:
        """Return the transform of a step; None where no contact has cohesion without tension."""
        unbonded = (limits.tension == 0) & (limits.cohesion > 0)
        if not some(unbonded):
            return None
        parted = (contacts.gap > CLOSED * contacts.length) & (contacts.normal_force >= 0)
        return cls(unbonded, np.where(parted, 0.0, limits.cohesion))

    def apply(self, problem: StepProblem) -> StepProblem:
        limits = problem.limits
        cohesion = np.where(self.unbonded, self.cohesion, limits.cohesion)
        tension = np.where(self.unbonded, ADHERES * cohesion, limits.tension)
        return with_parts(problem, limits=with_parts(limits, cohesion=cohesion, tension=tension))

    def undo(self, answer: StepAnswer, problem: StepProblem) -> StepAnswer:
        """Return the answer with opened joints marked as open: they had no bond to break."""
        opened = self.unbonded & (answer.state == BROKEN) & (problem.state != BROKEN)
        return with_parts(answer, state=np.where(opened, int(OPEN), answer.state))
