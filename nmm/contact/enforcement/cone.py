"""Exact contact on Coulomb's cone: no penetration, no regularised friction."""

from dataclasses import dataclass
from typing import ClassVar

from nmm.contact.enforcement.iterative import ExactEnforcement
from nmm.contact.iteration.exact import exact_round
from nmm.contact.iteration.interior.interior_point import Goal
from nmm.contact.iteration.multiplier_rounds import MultiplierIterate
from nmm.contact.iteration.tools import Tools
from nmm.contact.problem.step_problem import StepProblem
from nmm.registry import above_zero


@dataclass(frozen=True)
class Cone(ExactEnforcement):
    """Forces in the cone ``|T| <= c - mu N, N <= t``, gaps and slips exactly complementary to them.

    An interior point finds them from nowhere in fifteen to thirty factorisations, whatever the
    contacts do (`nmm.contact.iteration.exact`). Friction is not associated: the bound moves with
    the normal force, no dilatancy. Contacts whose stiffness is the joint's own are springs.

    Where blocks have more contacts than unknowns forces are not unique; those found lie in the
    middle of what is admissible, and do not depend on the step before.

    Attributes
    ----------
    max_factorisations
        Most factorisations of the interior point.
    """

    name: ClassVar[str] = "cone"
    max_factorisations: int = above_zero(100)

    def forces(
        self, problem: StepProblem, tools: Tools, goal: Goal
    ) -> tuple[MultiplierIterate, str]:
        return exact_round(problem, tools, goal, self.max_factorisations)
