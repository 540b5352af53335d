"""A step along a path: balance, and one more equation that finds the load factor."""

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Floats
from nmm.assembly.motion import State
from nmm.contact.detection.tolerances import FURTHER
from nmm.contact.following.path_equation import PathEquation
from nmm.contact.solution.request import StepRequest
from nmm.effects.base import Instant
from nmm.errors import SolveError
from nmm.integrators.base import Integrator
from nmm.stepping.step.equations import Assembly
from nmm.stepping.step.trial import Attempt

if TYPE_CHECKING:
    from nmm.solvers.linear import LinearSolver
    from nmm.stepping.step.contact_step import Touching

# Searches for contacts with a longer reach.
LOOKS = 4


def unit_load(assembly: Assembly, state: State) -> Floats:
    """Return the force (n,) that a load factor of one more adds (N)."""
    plan = assembly.plan
    time, factor = state.time, state.load_factor
    more, now = (plan.force(state, Instant(time, at)) for at in (factor + 1.0, factor))
    return more - now


def path_step(
    assembly: Assembly,
    touching: "Touching",
    solver: "LinearSolver",
    rule: Integrator,
    state: State,
    path: PathEquation,
    reach: float,
) -> Attempt:
    """Solve a step along a path; what comes of it has the load factor found.

    Contacts are sought up to ``reach`` (m) at first.
    """
    still = Instant(state.time, state.load_factor)
    equations = assembly.of(state, still, None, rule, anchored=False)
    request = StepRequest(equations.matrix, equations.force, solver, time=state.time)
    contact = touching.contact
    try:
        for _ in range(LOOKS):
            contacts = touching.candidates(state, reach, None)
            solved, change = contact.solve_path(contacts, state, request, path)
            end = Instant(state.time, state.load_factor + change)
            result = touching.moved(replace(equations, end=end), solved.answer.increment)
            if result.motion <= reach or not solved.answer.verdict.converged:
                break
            reach = FURTHER * result.motion
    except SolveError as fault:
        rest = np.zeros_like(equations.force)
        why, singular = str(fault), fault.singular
        return Attempt(False, why, state, rest, 0.0, np.nan, 1, singular=singular)
    verdict = solved.answer.verdict
    return replace(
        result,
        converged=verdict.converged,
        sentence=verdict.sentence,
        residual=solved.answer.residual,
        passes=solved.passes,
        solved=solved,
    )
