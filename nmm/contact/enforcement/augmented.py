"""Augmented Lagrangian: penalty springs relieved by multipliers."""

from dataclasses import dataclass
from typing import ClassVar

from nmm.contact.enforcement.iterative import ExactEnforcement
from nmm.contact.iteration.exact import exact_round
from nmm.contact.iteration.interior.interior_point import Goal
from nmm.contact.iteration.multiplier_rounds import (
    MultiplierIterate,
    converged_rounds,
    first_round,
    stiff_springs,
)
from nmm.contact.iteration.options.budgets import IterationBudget
from nmm.contact.iteration.tools import Tools
from nmm.contact.problem.step_problem import StepProblem
from nmm.registry import above_zero


@dataclass(frozen=True)
class Augmented(ExactEnforcement):
    """Uzawa's iteration on penalty springs (Lin 1995; Amadei, Lin, Dwyer 1996).

    ``lambda <- lambda + p d`` after every round, the shear multiplier cut at Coulomb's bound; a
    round settles springs shifted by the multipliers. For one contact of compliance ``c`` the
    error of the force falls by exactly ``1/(1 + p c)`` a round, so the result does not depend on
    ``p``, only the number of rounds does. The multipliers are the contact forces.

    Attributes
    ----------
    scale
        ``p c`` (-), from which ``p`` of each contact follows; None takes the stiffnesses of the
        problem.
    growth
        Factor on ``p`` (-) after a round that reduced the error by less than fifty, up to 100
        times the first ``p``; 1 keeps ``p``.
    max_rounds
        Most updates of the multipliers a step.
    rescue
        Most factorisations of the interior point, which takes over when the rounds fail; 0
        reports the failure instead.
    """

    name: ClassVar[str] = "augmented"
    scale: float | None = 10.0
    growth: float = above_zero(10.0)
    max_rounds: int = above_zero(50)
    rescue: int = 100

    def forces(
        self, problem: StepProblem, tools: Tools, goal: Goal
    ) -> tuple[MultiplierIterate, str]:
        """Alternate solving and updating until forces and multipliers agree."""
        budget = IterationBudget(400, 20, 0) if self.rescue else IterationBudget()
        first = first_round(stiff_springs(problem, self.scale))
        at = converged_rounds(first, tools, goal, self.max_rounds, self.growth, budget)
        how = f"{at.count} rounds"
        if self.rescue and not at.meets(goal):
            at, rest = exact_round(problem, tools, goal, self.rescue)
            how = f"{how}, then {rest}"
        return at, how
