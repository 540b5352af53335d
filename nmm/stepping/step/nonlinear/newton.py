"""Newton's method on forces that are not linear, about the solution of a step with its contacts.

Each iteration solves a whole linear step, contact, friction and supports included, with the tangent
at the iterate; its unknown is the whole increment. What is out of balance afterwards is only what
the tangent missed of the internal forces, those of matter and of effects (`inner`). What they
remember is read at the start of the step by all iterations and belongs to the state that is found:
nothing is kept by an attempt that fails.
"""

from dataclasses import replace

import numpy as np

from nmm.assembly.state import State
from nmm.frozen import with_parts
from nmm.solvers.unchecked import product
from nmm.stepping.step.clock import Clock
from nmm.stepping.step.linear.equations import Linearisation
from nmm.stepping.step.nonlinear.flow import flow, mechanism
from nmm.stepping.step.nonlinear.inner import InternalForces
from nmm.stepping.step.nonlinear.iterate import Iterate, Solution, Solve
from nmm.stepping.step.nonlinear.line_search import searched
from nmm.stepping.step.nonlinear.progress import balanced, falls, hopeless
from nmm.stepping.step.trial import Attempt


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
        lost = not found.converged and not _goes_on(found)
        flows = flow(elastic, line, way, softens) if lost else ""
        if elastic is not None and not flows and (lost or found.motion > inner.size):
            yields = mechanism(elastic, line, now, solve, inner.size)
            if yields:
                return equations, _mechanism(found, state, yields)
        if lost:
            return equations, _failed(found, found.sentence, flows)
        then = inner.at(found.increment, now, found.state)
        imbalances.append(inner.imbalance(now, then, scale, equations.force, found.missed))
        found = with_parts(found, imbalances=tuple(imbalances))
        if balanced(found, inner.tolerance):
            return equations, _accepted(found, then)
        way = then.increment - now.increment
        softens = softens or (inner.softens and float(way @ (line.stiffness @ way)) < 0)
        if hopeless(imbalances):
            return equations, _lost(found, state, flow(elastic, line, way, softens))
        now, before = searched(equations, line, now, then, inner) if inner.searches else then, now
        if inner.searches and not inner.flows and falls(imbalances):
            now = now.with_tangent_of(before)


def _accepted(found: Attempt, then: Iterate) -> Attempt:
    """Return the solution with what matter and effects remember at its end."""
    after = with_parts(found.state, history=then.history, memory=then.memory)
    return with_parts(found, state=after, residual=max(found.residual, found.imbalances[-1]))


def _mechanism(found: Attempt, state: State, yields: str) -> Attempt:
    """Return the failed result of matter that ``yields`` all along a motion."""
    still = replace(found, state=state, increment=np.zeros_like(found.increment), motion=0.0)
    return replace(still, converged=False, sentence=yields, singular=True, yields=True)


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


def _goes_on(found: Attempt) -> bool:
    """Whether to iterate on after an unacceptable solution: a bond may still hold."""
    return found.solved is not None and found.solved.stopped


def _line(inner: InternalForces, at: Iterate, clock: Clock) -> Linearisation:
    with clock.phase("assembly"):
        stiffness = inner.stiffness(at)
    force = at.force - product(stiffness, at.increment) if at.increment.any() else at.force
    return Linearisation(stiffness, force, inner.start, inner.symmetric)
