"""Newton's method on forces that are not linear, about the solution of a step with its contacts.

Each iteration solves a whole linear step, contact, friction and supports included, with the tangent
at the iterate; its unknown is the whole increment. What is out of balance afterwards is only what
the tangent missed of the internal forces, those of matter and of effects (`inner`). What they
remember is read at the start of the step by all iterations and belongs to the state that is found:
nothing is kept by an attempt that fails.
"""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from scipy.sparse import csc_array

from integration.arrays import Floats
from nmm.assembly.motion import State
from nmm.frozen import with_parts
from nmm.solvers.unchecked import product
from nmm.stepping.step.clock import Clock
from nmm.stepping.step.equations import Equations, Linearisation
from nmm.stepping.step.nonlinear.inner import InternalForces
from nmm.stepping.step.nonlinear.iterate import Iterate, size
from nmm.stepping.step.nonlinear.line_search import searched
from nmm.stepping.step.trial import Attempt

Solution = tuple[Equations, Attempt]
Solve = Callable[[Linearisation | None, Attempt | None], Solution]
"""From internal forces made lines, and what the last iteration found, to a solution."""

# Out-of-balance force of matter, as a share of the forces, that is taken for a solution where it
# falls no more for rounding.
ROUNDED = 1e-7
# Share of the contact forces that their linearisation may miss where the rest is rounding: as large
# a share of their work is stored nowhere.
MISSED_BY_CONTACT = 1e-6
# What rounding leaves of a linear solution moves forces by about so many times as much.
LEFT = 10.0
# Iterations of a step; plasticity takes four to eight.
MOST = 30
# Iterations go to and fro where so many of them leave more than this share of the least before.
FRUITLESS, FRUIT = 8, 0.7
# Below this imbalance the tangent of effects is kept, with the matrix and its factors: what it
# misses falls by as much again. Where it falls less than by this factor a new one is made.
NEARLY, FALLS = 1e-3, 0.1
# Stiffness against the last iteration's motion, as a share of the elastic one, that shows flow.
FLOWS = 1e-2

# Share of the elastic stiffness that shows what yielding matter moves along, and that may be left
# against a mechanism.
TRACE = 1e-6


def newton(
    inner: InternalForces,
    state: State,
    solve: Solve,
    clock: Clock,
) -> Solution:
    """Solve a step from ``state`` with its ``inner`` forces; ``solve`` does with these linearised.

    Returns
    -------
    The last equations and their solution, with what is remembered at its end.
    """
    elastic, scale = inner.elastic if inner.flows else None, inner.scale
    way, passes, softens = np.zeros_like(inner.start), 0, False
    now = inner.at(way)
    found: Attempt | None = None
    imbalances: list[float] = []
    while True:
        line = _line(inner, now, clock)
        equations, found = solve(line, found)
        passes += found.passes
        found = with_parts(found, passes=passes, imbalances=tuple(imbalances))
        if not found.converged and not _goes_on(found):
            flows = _flow(elastic, line, way, softens)
            yields = "" if flows or elastic is None else _mechanism(elastic, line, now, solve)
            if yields:
                return equations, replace(found, sentence=yields, singular=True, yields=True)
            return equations, _failed(found, found.sentence, flows)
        then = inner.at(found.increment, now, found.state)
        imbalances.append(inner.imbalance(now, then, scale, equations.force, found.missed))
        found = with_parts(found, imbalances=tuple(imbalances))
        patience = 1 if _settled(found) else FRUITLESS
        if _balanced(imbalances, inner.tolerance, found.residual, patience):
            return equations, _accepted(found, then)
        way = then.increment - now.increment
        softens = softens or (inner.softens and float(way @ (line.stiffness @ way)) < 0)
        if _hopeless(imbalances):
            return equations, _lost(found, state, _flow(elastic, line, way, softens))
        now, before = searched(equations, line, now, then, inner) if inner.searches else then, now
        if inner.searches and not inner.flows and _falls(imbalances):
            now = now.with_tangent_of(before)


def _accepted(found: Attempt, then: Iterate) -> Attempt:
    """Return the solution with what matter and effects remember at its end."""
    after = with_parts(found.state, history=then.history, memory=then.memory)
    return with_parts(found, state=after, residual=max(found.residual, found.imbalances[-1]))


def _lost(found: Attempt, state: State, flows: str) -> Attempt:
    """Return the result of a step from ``state`` whose iterations make no progress."""
    said = (
        f"internal forces are {found.imbalances[-1]:.1e} of all out of balance after "
        f"{len(found.imbalances)} iterations"
    )
    return _failed(replace(found, converged=False, state=state, singular=False), said, flows)


def _failed(found: Attempt, said: str, flows: str) -> Attempt:
    """Return a failed result with its reason; matter that ``flows`` is a mechanism."""
    sentence = f"{flows}; {said}" if flows else said
    return replace(found, sentence=sentence, singular=found.singular or bool(flows))


def _mechanism(elastic: csc_array, line: Linearisation, now: Iterate, solve: Solve) -> str:
    """Say that matter yields all along a motion; empty where none is found.

    With traces of its ``elastic`` stiffness besides, one twice the other, matter moves by what it
    does not resist once and half of it.
    """
    moved = []
    for trace in (TRACE * elastic, 2 * TRACE * elastic):
        force = line.force - product(trace, now.increment)
        moved.append(solve(replace(line, stiffness=line.stiffness + trace, force=force), None)[1])
    way = moved[0].increment - moved[1].increment
    left, whole = (float(way @ product(matrix, way)) for matrix in (line.stiffness, elastic))
    if not all(one.converged for one in moved) or left >= TRACE * whole:
        return ""
    return (
        f"matter yields all along a motion, against which less than {TRACE:.0e} of its elastic "
        "stiffness is left: its limit load is passed"
    )


def _goes_on(found: Attempt) -> bool:
    """Whether to iterate on after an unacceptable solution: a bond may still hold."""
    return found.solved is not None and found.solved.stopped


def _line(inner: InternalForces, at: Iterate, clock: Clock) -> Linearisation:
    with clock.phase("assembly"):
        stiffness = at.stiffness
    force = at.force - product(stiffness, at.increment) if at.increment.any() else at.force
    return Linearisation(stiffness, force, inner.start, inner.symmetric)


def _settled(found: Attempt) -> bool:
    """Whether contact forces are those of the gaps that were found."""
    if found.missed is None or found.solved is None:
        return True
    return size(found.missed) <= MISSED_BY_CONTACT * size(found.solved.push)


def _balanced(imbalances: list[float], tolerance: float, residual: float, patience: int) -> bool:
    """Whether forces balance, or as far as rounding lets them: that of the solutions too.

    Rounding is what has not fallen over so many iterations.
    """
    last = imbalances[-1]
    if last <= tolerance:
        return True
    stalls = len(imbalances) > patience and last > 0.5 * imbalances[-1 - patience]
    return stalls and last <= max(ROUNDED, LEFT * residual)


def _hopeless(imbalances: list[float]) -> bool:
    """Whether the iterations are used up, or the last ones made no progress."""
    last, before = imbalances[-FRUITLESS:], imbalances[:-FRUITLESS]
    fruitless = bool(before) and min(last) > FRUIT * min(before)
    return fruitless or len(imbalances) == MOST or not np.isfinite(imbalances[-1])


def _falls(imbalances: list[float]) -> bool:
    """Whether the residual is small, and falls with the last tangent."""
    last, before = imbalances[-1], imbalances[-2] if len(imbalances) > 1 else np.inf
    return last <= NEARLY and last <= FALLS * before


def _flow(elastic: csc_array | None, line: Linearisation, way: Floats, softens: bool) -> str:
    """Say how little of its elastic stiffness matter has against a motion (n,); empty if enough.

    Where it ``softens`` some motion of the iterations took work of second order below zero (Hill
    1958); the last one may be of matter that unloads again, with all of its stiffness.
    """
    if softens:
        return "matter softens faster than what is about it unloads"
    if elastic is None:
        return ""
    whole = float(way @ (elastic @ way))
    left = float(way @ (line.stiffness @ way)) / whole if whole > 0 else 1.0
    return (
        f"matter flows with {max(left, 0.0):.1e} of its elastic stiffness" if left < FLOWS else ""
    )
