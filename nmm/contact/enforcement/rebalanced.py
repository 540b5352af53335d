"""Solve again when the componentwise backward error of a body is too large."""

from dataclasses import replace

from integration.arrays import Ints
from nmm.contact.enforcement.base import Enforcement
from nmm.contact.iteration.memory import Memory
from nmm.contact.iteration.options.budgets import SMALL
from nmm.contact.problem.residual_kernel import unevenness
from nmm.contact.problem.row_products import compressed
from nmm.contact.problem.step_problem import StepAnswer, StepProblem
from nmm.frozen import with_parts
from nmm.solvers.linear import LinearSolver

UNEVEN = 1e-3
"""Share of its own forces by which an unknown may be out of balance."""
UNEVEN_SMALL = 1e-6
"""The same in problems of up to `SMALL` unknowns, where more costs nothing."""
FINE = 1e-11
"""Least tolerance of a further solution."""
FLOOR = 1e-14
"""Share of the whole scene's forces that rounding leaves. More adds up over steps: 1e-11 of them is
a thousandth of a block of 1e-8 of the weight, and made it 12 % too heavy in eighty steps."""
FINER = 1e-3
"""Part of its tolerance that the next solution of a step is requested."""


def solve_rebalanced(
    enforcement: Enforcement,
    problem: StepProblem,
    linear: LinearSolver,
    memory: Memory,
    body: Ints,
) -> StepAnswer:
    """Solve a step, and again by finer tolerances, down to `FINE`, while the answer is uneven.

    A tolerance relative to the largest force says nothing of a part whose own forces are as
    small as that: a block of 0.1 mm on one of 1 m has 1e-8 of its weight.
    """
    answer = enforcement.solve(problem, linear, memory)
    allowed = UNEVEN_SMALL if len(problem.force) <= SMALL else UNEVEN
    tolerance, passes = float(getattr(enforcement, "tolerance", 0.0)), answer.passes
    while answer.verdict.converged and tolerance > FINE:
        if imbalance_of_bodies(problem, answer, body) <= allowed:
            break
        memory.answered, tolerance = (problem, answer), max(FINE, FINER * tolerance)
        finer = replace(enforcement, **{"tolerance": tolerance}).solve(
            memory.started(problem), linear, memory
        )
        passes += finer.passes
        if not finer.verdict.converged:
            break
        answer = finer
    return with_parts(answer, passes=passes)


def imbalance_of_bodies(problem: StepProblem, answer: StepAnswer, body: Ints) -> float:
    """Largest out-of-balance force of an unknown over the forces that meet in its ``body`` (n,).

    These are ``|F| + |K| |d| + (|N| + |T|)`` through both rows of each contact, so that a block
    pressed from above alone is not asked for rest aside to the last digit (componentwise backward
    error: Oettli, Prager 1964), weighted so that unknowns compare, the largest of its body: a
    brick that falls upright is not asked for rest aside. What is in balance beside the whole
    scene to `FLOOR` does not count.
    """
    forces = answer.normal_force, answer.shear_force
    given = answer.increment, problem.force, problem.weight, forces, compressed(problem.matrix)
    return float(unevenness(*given, problem.compressed_rows, body, FLOOR))
