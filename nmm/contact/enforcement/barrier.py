"""Incremental potential contact on the linearised gaps of a step."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from nmm.contact.barrier.potential import Potential
from nmm.contact.barrier.search import Search
from nmm.contact.enforcement.iterative import IterativeEnforcement
from nmm.contact.iteration.answers import singular_answer, unsettled
from nmm.contact.iteration.cut_spring_solver import solve_springs
from nmm.contact.iteration.memory import Memory
from nmm.contact.iteration.multiplier_rounds import compliances, stiff_springs
from nmm.contact.iteration.options.budgets import IterationBudget
from nmm.contact.iteration.tools import Tools
from nmm.contact.problem.coulomb import label
from nmm.contact.problem.cut_springs import IterationResult
from nmm.contact.problem.refusal import refuse
from nmm.contact.problem.step_problem import StepAnswer, StepProblem, Verdict
from nmm.errors import SolveError
from nmm.registry import above_zero
from nmm.solvers.linear import LinearSolver

TOO_THIN = 1e-2
"""A kept width below this part of the one that fits a step is given up for it."""


@dataclass(frozen=True)
class Barrier(IterativeEnforcement):
    """A smooth barrier in place of the constraint (Li et al. 2020, equations 5, 6, 11, 14).

    Normal forces follow ``b(x) = -(x - w)^2 ln(x / w)``, ``x = gap + w/2``: they act within
    half a width ``w`` of touching and grow without bound at ``gap = -w/2``, which no step reaches.
    Friction is a smooth function of the slip that meets Coulomb's bound at a slip of ``w/2``.
    Newton's method on unknowns and forces together finds the balance (`Search`), from the last step
    or from where the interior point of `Cone` stands once it has found most states.

    Gaps are wrong by up to ``w/2`` and sticking slips by up to ``w/2``: these are the numbers to
    choose ``w`` by. Contacts with a tension limit or a stiffness of their own are springs.

    Attributes
    ----------
    width
        ``w`` (m); None takes a thousandth of what the largest contact force of the first step
        with contact would press in (compliance times force); before, of the largest motion; and
        anew where that turns out a hundred times as large.
    max_passes
        Most Newton steps of each attempt.
    tolerance
        Largest relative out-of-balance force (-).
    """

    name: ClassVar[str] = "barrier"
    ahead: ClassVar[bool] = True
    width: float | None = None
    max_passes: int = above_zero(100)
    tolerance: float = above_zero(1e-7)

    def solve(
        self, problem: StepProblem, linear_solver: LinearSolver, memory: Memory | None = None
    ) -> StepAnswer:
        """Balance the step from roughly settled springs, or in the end from no motion."""
        refuse(problem)
        tools = self.tools(linear_solver, memory)
        springs, memory = stiff_springs(problem, 1.0), tools.memory
        try:
            rough = solve_springs(springs, tools, 1e-2, budget=IterationBudget(20, 2, 0))
        except SolveError as fault:
            return singular_answer(springs, linear_solver, fault)
        force = float(np.abs(springs.forces(rough.increment)).max(initial=0.0))
        compliance = float(np.mean(compliances(problem)[0])) if problem.n_contacts else 1.0
        moved = float(np.abs(problem.normal_rows @ rough.increment).max(initial=0.0))
        fit = 1e-3 * (force * compliance or moved or compliance)
        # A first touch that hardly presses says little of what is to come.
        kept = memory.barrier_width if (memory.barrier_width or 0.0) > TOO_THIN * fit else None
        width = self.width or kept or fit
        if force > 0:  # blocks that fly do not yet say how hard they will meet
            memory.barrier_width = width
        well = Potential(problem, width, max(force, width / compliance) / width)
        search = Search(well, tools, self.tolerance)
        found = search.run(rough, self.max_passes, memory.again(problem))
        return _answer(well, tools, found, self.tolerance)


def _answer(well: Potential, tools: Tools, found: IterationResult, tolerance: float) -> StepAnswer:
    """Forces under the bound of their own normal force, and the verdict on them."""
    problem = well.problem
    gap, slip = problem.jumps(found.increment)
    pull = well.pull(gap, slip)
    reach = np.where(well.spring, well.bound(pull.normal) / problem.shear_stiffness, well.width / 2)
    is_open = np.where(well.spring, gap > well.stretch, well.distance(gap) >= 1)
    loose = is_open & (problem.limits.tension <= 0)
    return StepAnswer(
        increment=found.increment,
        normal_force=pull.normal,
        shear_force=pull.shear,
        gap=gap,
        slip=np.where(loose, 0.0, np.clip(slip, -reach, reach)),
        state=label(problem, is_open, np.abs(slip) > reach),
        passes=found.solves,
        residual=found.size,
        verdict=_verdict(well, tools, found, tolerance),
        factorisations=found.factorisations,
        solver=tools.linear.name,
        stored=well.stored(gap, slip),
    )


def _verdict(well: Potential, tools: Tools, found: IterationResult, tolerance: float) -> Verdict:
    if not found.size <= tolerance:
        return unsettled(found, tools, "widen the barrier")
    deep = f"; {well.deep} contacts began deeper than that" if well.deep else ""
    within = f"gaps and slips within {well.width / 2:.1e} m{deep}"
    return Verdict(True, "converged", f"settled by {found.story}, {within}")
