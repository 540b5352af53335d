"""Solve cut springs: first with one kept factor, then, by rule, with the interior point."""

from dataclasses import dataclass, replace

import numpy as np

from integration.arrays import Floats
from nmm.contact.chord import Chord
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
RESIGNED = 20
"""Solves with one factor after a step in which that did not suffice."""


@dataclass(frozen=True)
class Budget:
    """How long each method may try.

    Attributes
    ----------
    solves
        Most solves with one factor.
    trial
        Solves after which the progress is extrapolated: when the tolerance would not be met
        within ``solves``, the interior point takes over.
    interior
        Most factorisations of the interior point.
    """

    solves: int = 300
    trial: int = 60
    interior: int = 100


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
    start = near if start is None else start
    increment = np.zeros_like(springs.problem.force) if start is None else start
    if len(increment) <= SMALL or (near is not None and springs.problem.n_contacts <= FEW):
        pattern = memory.pattern_of(springs.problem)
        quick = polish(springs, pattern, linear.unsymmetric(), increment, FINE)
        if quick.size <= tolerance:
            return quick
    kept, new = memory.factor_of(springs, linear)
    chord = Chord(springs, kept.factor, increment, springs.defect(increment))
    if new:
        kept.factor.solve(springs.problem.force)
    factorisations = int(new)
    patience = budget.trial if new else 2 * kept.solves_when_new + 8
    done = chord.run(min(patience, RESIGNED if kept.stalled else budget.solves), tolerance)
    if not done and not new and not kept.as_new(springs.problem):
        memory.forget_factor()
        kept, new = memory.factor_of(springs, linear)
        chord.factor, factorisations = kept.factor, 1
        done = chord.run(budget.trial, tolerance)
    left = budget.solves - chord.solves
    if not done and not kept.stalled and _hopeful(chord, tolerance, left):
        done = chord.run(left, tolerance)
    kept.stalled = not done
    if new:
        kept.solves_when_new = chord.solves
    story = f"{chord.solves} solves with {'a new' if factorisations else 'the kept'} factor"
    found = Settled(
        springs, chord.increment, chord.defect.size, chord.solves, factorisations, story
    )
    if done and len(increment) <= SMALL:
        pattern = memory.pattern_of(springs.problem)
        end = polish(springs, pattern, linear.unsymmetric(), found.increment, FINE)
        return replace(found, increment=end.increment, size=end.size)
    if done or budget.interior <= 0:
        return found
    pattern = memory.pattern_of(springs.problem)
    inner = InteriorPoint(springs, pattern, linear).run(found, budget.interior, tolerance)
    best = inner if inner.size < found.size else found
    return replace(
        best,
        solves=found.solves + inner.solves,
        factorisations=found.factorisations + inner.factorisations,
        story=f"{found.story}, then {inner.story}",
    )


def _hopeful(chord: Chord, tolerance: float, solves: int) -> bool:
    rate = chord.rate(30)
    if not 0 < rate < 1:
        return False
    return bool(np.log(tolerance / chord.defect.size) / np.log(rate) <= solves)
