"""Rounds of multipliers: springs that give way until they carry no more than the multipliers."""

from dataclasses import dataclass, replace

import numpy as np
from scipy.sparse import csr_array

from integration.arrays import Floats
from nmm.contact.iteration.answers import judge
from nmm.contact.iteration.cut_spring_solver import solve_springs
from nmm.contact.iteration.interior.interior_point import Goal
from nmm.contact.iteration.options.budgets import SMALL, IterationBudget
from nmm.contact.iteration.tools import Tools
from nmm.contact.problem.cut_springs import CutSprings, IterationResult
from nmm.contact.problem.row_products import terms_of_stretches
from nmm.contact.problem.step_problem import StepProblem, Verdict

UNHELD = 1e13
"""Compliance times stiffness of a contact from which an unknown is held by rounding alone."""
UNKNOWN = 1e-15
"""Share of the motion of a contact below which a gap is rounding: bodies that fall side by side."""


@dataclass(frozen=True)
class MultiplierIterate:
    """Where the rounds stand.

    Attributes
    ----------
    result
        Springs shifted by the multipliers of this round, unknowns, out-of-balance force.
    count
        Rounds so far.
    gap
        Largest gap, slip or opening that should not be (m).
    error
        ``gap`` over what the largest force would press into the contact alone (its compliance
        times the force): the part of a force that is still missing where forces are determined.
    """

    result: IterationResult
    count: int = 0
    gap: float = np.inf
    error: float = np.inf

    def meets(self, goal: Goal) -> bool:
        """Whether balance and error are within their tolerances."""
        return self.result.size <= goal.balance and self.error <= goal.error


def compliances(problem: StepProblem) -> Floats:
    """(2, m) compliance ``c = g^T diag(K)^-1 g`` (m/N) of normal and tangent rows ``g``.

    Only unknowns that the matrix holds count, against the problem's stiffness ``k`` at the contact.
    Where there are none or their hold is weak ``k`` stands in, so that ``c <= 1e4 / k``; where that
    is the joint's own, ``c = 1 / k``.
    """
    diagonal = problem.matrix.diagonal()
    unknowns = np.divide(1.0, diagonal, out=np.zeros_like(diagonal), where=diagonal > 0)

    def of(rows: csr_array, stiffness: Floats) -> Floats:
        owner = np.repeat(np.arange(len(stiffness)), np.diff(rows.indptr))
        each = rows.data**2 * unknowns[rows.indices]
        each[each * stiffness[owner] > UNHELD] = 0.0
        found = np.bincount(owner, each, len(stiffness))
        held = (found > 0) & ~problem.own_stiffness
        return np.where(held, np.minimum(found, 1e4 / stiffness), 1 / stiffness)

    return np.stack(
        [
            of(problem.normal_rows, problem.normal_stiffness),
            of(problem.tangent_rows, problem.shear_stiffness),
        ]
    )


def stiff_springs(problem: StepProblem, scale: float | None) -> CutSprings:
    """Springs of stiffness ``scale / c``, shifted by the forces of the step before.

    Contacts whose stiffness is the joint's own keep it, without shift. With ``scale`` None all
    stiffnesses are the problem's.
    """
    exact, stiffness = ~problem.own_stiffness, problem.stiffness
    if scale is not None:
        stiffness = np.where(exact, scale / compliances(problem), stiffness)
    forces = np.stack([problem.normal_force, problem.shear_force])
    return CutSprings(problem, stiffness, np.where(exact, forces, 0.0))


def exact_goal(problem: StepProblem, tolerance: float, gap_tolerance: float) -> Goal:
    """Goal with the tolerance of balance for gaps where a small problem makes it cost nothing."""
    small = len(problem.force) <= SMALL
    return Goal(tolerance, min(tolerance, gap_tolerance) if small else gap_tolerance)


def first_round(springs: CutSprings) -> MultiplierIterate:
    """Round zero: no unknowns yet."""
    return MultiplierIterate(
        IterationResult(springs, np.zeros_like(springs.problem.force), 1.0, 0, 0, "")
    )


def multiplier_round(
    last: MultiplierIterate, tools: Tools, tolerance: float, budget: IterationBudget
) -> MultiplierIterate:
    """Settle the springs and measure by how much their forces differ from the multipliers."""
    before = last.result
    start = before.increment if last.count else None
    found = solve_springs(before.springs, tools, tolerance, start, budget)
    return measured(found.at_cost_of(before), last.count + 1)


def measured(found: IterationResult, count: int) -> MultiplierIterate:
    """Iterate whose springs are in balance, with what its multipliers lack beyond rounding."""
    springs, problem = found.springs, found.springs.problem
    forces = springs.forces(found.increment)
    jump = np.abs(np.where(problem.own_stiffness, 0.0, forces - springs.shift))
    gap = jump / springs.stiffness
    # Bodies that fall side by side: their faces move along each other, and gaps round as they do.
    moved = terms_of_stretches(*problem.rows, found.increment).max(axis=0)
    counts = gap > UNKNOWN * moved
    gap = np.where(counts, gap, 0.0)
    part = gap / compliances(problem)
    size = float(np.abs(forces).max(initial=0.0))
    largest = [float(quantity.max(initial=0.0)) for quantity in (gap, part)]
    return MultiplierIterate(found, count, largest[0], largest[1] * (1.0 / size if size else 0.0))


def updated(last: MultiplierIterate, growth: float) -> MultiplierIterate:
    """Springs of the next round, ``growth`` times as stiff.

    ``lambda <- lambda + p d``, cut at the limits.
    """
    springs, own = last.result.springs, last.result.springs.problem.own_stiffness
    forces = springs.forces(last.result.increment)
    stiffness = np.where(own, 1.0, growth) * springs.stiffness
    springs = replace(springs, stiffness=stiffness, shift=np.where(own, 0.0, forces))
    return replace(last, result=replace(last.result, springs=springs))


def converged_rounds(
    at: MultiplierIterate,
    tools: Tools,
    goal: Goal,
    max_rounds: int,
    growth: float,
    budget: IterationBudget,
) -> MultiplierIterate:
    """Repeat rounds until balance and error meet their tolerances; return the last.

    Balance is sought no finer than the error allows, and to its tolerance in the end.

    Raises
    ------
    SolveError
        When even with all springs acting the load moves a free part.
    """
    steer = tools.options.rounds
    inner, stiffness, failures = max(1e-4, goal.balance), 1.0, 0
    while at.count < max_rounds:
        last, at = at, multiplier_round(at, tools, inner, budget)
        failures += at.result.size > inner
        if at.meets(goal) or failures > steer.failures or at.count == max_rounds:
            break
        fine = at.error <= steer.near * goal.error
        inner = goal.balance if fine else float(np.clip(0.1 * at.error, goal.balance, inner))
        if at.error <= goal.error:
            continue
        times = (
            min(growth, steer.stiffest / stiffness) if at.error > steer.gain * last.error else 1.0
        )
        at = updated(at, times)
        stiffness *= times
    return at


def rounds_verdict(at: MultiplierIterate, tools: Tools, goal: Goal, how: str) -> Verdict:
    """Verdict on balance and on what the multipliers still lack; ``how`` they were found."""
    found = replace(at.result, story=f"{how}, {at.result.solves} solves")
    verdict = judge(found, tools, goal.balance)
    if not verdict.converged:
        return verdict
    if at.error > goal.error:
        sentence = (
            f"gaps of {at.gap:.1e} m left after {how}, {at.error:.1e} of what the largest force "
            "would press in: allow more rounds, raise the scale or shorten the step"
        )
        return Verdict(False, "passes", sentence)
    return replace(verdict, sentence=f"{verdict.sentence}, gaps within {at.gap:.1e} m")
