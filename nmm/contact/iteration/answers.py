"""Answers and verdicts of the enforcements that balance cut springs."""

import numpy as np

from integration.arrays import Floats
from nmm.contact.iteration.cut_spring_solver import solve_springs
from nmm.contact.iteration.tools import Tools
from nmm.contact.problem.answer_kernel import ended
from nmm.contact.problem.balance import cancelling, rounding
from nmm.contact.problem.cut_springs import CutSprings, IterationResult
from nmm.contact.problem.step_problem import StepAnswer, Verdict
from nmm.errors import SolveError
from nmm.solvers.linear import LinearSolver
from nmm.solvers.unchecked import magnitudes

PASSES = 3
"""Open-close passes after a failure, to see whether a part came free."""


def spring_answer(springs: CutSprings, tools: Tools, tolerance: float) -> StepAnswer:
    """Settle ``springs`` and judge the outcome."""
    try:
        found = solve_springs(springs, tools, tolerance)
    except SolveError as fault:
        return singular_answer(springs, tools.linear, fault)
    return answer(found, tools.linear, judge(found, tools, tolerance))


def answer(found: IterationResult, linear: LinearSolver, verdict: Verdict) -> StepAnswer:
    """Answer with the forces of the springs at what was found."""
    springs = found.springs
    gap, slip, normal, shear, state = ended(found.increment, springs.columns, springs.problem.state)
    return StepAnswer(
        increment=found.increment,
        normal_force=normal,
        shear_force=shear,
        gap=gap,
        slip=slip,
        state=state,
        passes=found.solves,
        residual=found.size,
        verdict=verdict,
        factorisations=found.factorisations,
        solver=linear.name,
    )


def judge(found: IterationResult, tools: Tools, tolerance: float) -> Verdict:
    """Verdict on unknowns whose forces are admissible by construction."""
    if found.size <= tolerance or found.size <= rounding(found.springs, found.increment):
        return Verdict(True, "converged", f"settled by {found.story}")
    return unsettled(found, tools, "soften the contacts")


def unsettled(found: IterationResult, tools: Tools, remedy: str) -> Verdict:
    """Verdict on unknowns that are out of balance: a part is free, or the search has stalled."""
    free = _free_part(found, tools)
    if free is not None:
        return free
    worst = _worst_contacts(found.springs, found.increment)
    named = ", ".join(str(i) for i in worst[:5])
    sentence = (
        f"out of balance by {found.size:.1e} after {found.story}, most at contacts {named}; "
        f"shorten the step or {remedy}"
    )
    return Verdict(False, "stalled", sentence, worst)


def _worst_contacts(springs: CutSprings, increment: Floats) -> tuple[int, ...]:
    """Up to ten contacts on whose unknowns the out-of-balance force is largest."""
    problem = springs.problem
    rest = np.abs(springs.weight**2 * springs.residual(increment).force)
    felt = sum(magnitudes(part) @ rest for part in problem.rows)
    return tuple(int(i) for i in np.argsort(-felt)[:10])


def singular_answer(springs: CutSprings, linear: LinearSolver, fault: SolveError) -> StepAnswer:
    """Answer to a step in which a part is free to move."""
    problem = springs.problem
    found = IterationResult(springs, np.zeros_like(problem.force), 1.0, 0, 1, "")
    sentence = f"with all {problem.n_contacts} contacts acting: {fault}"
    return answer(found, linear, Verdict(False, "singular", sentence))


def _free_part(found: IterationResult, tools: Tools) -> Verdict | None:
    """Verdict "singular" when open-close passes from what was found set a part free."""
    springs, increment = found.springs, found.increment
    problem = springs.problem
    pattern = tools.memory.pattern_of(problem)
    for _ in range(PASSES):
        is_open, sliding = springs.states(increment)
        normal = np.where(is_open, 0.0, springs.stiffness[0])
        shear = np.where(is_open | sliding, 0.0, springs.stiffness[1])
        try:
            factor = tools.linear.factorise(pattern.matrix(problem, normal, shear))
            rest = springs.residual(increment).force
            increment = increment - factor.solve(rest, cancelling(springs, increment))
        except SolveError as fault:
            sentence = (
                f"{int(is_open.sum())} of {problem.n_contacts} contacts open, "
                f"{int((sliding & ~is_open).sum())} slide and nothing else holds a part: {fault}"
            )
            return Verdict(False, "singular", sentence)
    return None
