"""Solve cut springs: by chord steps with two factors and, by rule, with the interior point."""

from dataclasses import replace

import numpy as np

from integration.arrays import Floats
from nmm.contact.alternation import Alternation, Budget
from nmm.contact.interior import InteriorPoint
from nmm.contact.memory import Memory
from nmm.contact.newton import polish
from nmm.contact.springs import CutSprings, Settled
from nmm.solvers.linear import LinearSolver

SMALL = 120
"""Unknowns up to which Newton's method is tried first."""
FEW = 200
"""Contacts up to which it is tried first from a start that is near."""
FINE = 1e-13
"""Relative out-of-balance force at which Newton's method need not go on."""


def settle(
    springs: CutSprings,
    linear: LinearSolver,
    memory: Memory,
    tolerance: float,
    start: Floats | None = None,
    budget: Budget | None = None,
) -> Settled:
    """Return unknowns whose cut spring forces balance the step within ``tolerance``, or the best.

    Raises
    ------
    SolveError
        When even with all springs acting the load moves a free part.
    """
    budget = budget or Budget()
    near, memory.start = memory.start, None
    increment = _start(springs, memory, near if start is None else start)
    small = len(increment) <= SMALL
    if small or (near is not None and springs.problem.n_contacts <= FEW):
        quick = _polished(springs, linear, memory, increment)
        if quick.size <= tolerance:
            return _kept(quick, memory)
    found = Alternation(springs, linear, memory, tolerance, increment).run(budget)
    if found.size <= tolerance and small:
        end = _polished(springs, linear, memory, found.increment)
        found = replace(found, increment=end.increment, size=end.size)
    elif not found.size <= tolerance and budget.interior > 0:
        pattern = memory.pattern_of(springs.problem)
        inner = InteriorPoint(springs, pattern, linear).run(found, budget.interior, tolerance)
        found = replace(
            inner if inner.size < found.size else found,
            solves=found.solves + inner.solves,
            factorisations=found.factorisations + inner.factorisations,
            story=f"{found.story}, then {inner.story}",
        )
    return _kept(found, memory)


def _start(springs: CutSprings, memory: Memory, given: Floats | None) -> Floats:
    """Unknowns to start from: those given, else none or those of the step before."""
    if given is not None:
        return given
    rest, last = np.zeros_like(springs.problem.force), memory.last
    if last is None or len(last) != len(rest):
        return rest
    return last if springs.defect(last).size < springs.defect(rest).size else rest


def _polished(
    springs: CutSprings, linear: LinearSolver, memory: Memory, increment: Floats
) -> Settled:
    pattern = memory.pattern_of(springs.problem)
    return polish(springs, pattern, linear.unsymmetric(), increment, FINE)


def _kept(found: Settled, memory: Memory) -> Settled:
    if np.isfinite(found.increment).all():
        memory.last = found.increment
    return found
