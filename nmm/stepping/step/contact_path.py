"""A step of statics with contact whose load factor is found with the unknowns."""

from dataclasses import replace
from typing import TYPE_CHECKING

from nmm.contact.detection.tolerances import FURTHER
from nmm.contact.following.path_solution import path_solution
from nmm.contact.solution.request import StepRequest
from nmm.effects.base import Instant
from nmm.solvers.linear import LinearSolver
from nmm.stepping.step.contact_search import ContactSearch
from nmm.stepping.step.equations import Equations
from nmm.stepping.step.mover import Mover
from nmm.stepping.step.trial import Attempt

if TYPE_CHECKING:
    from nmm.controls.path_equation import PathEquation

# Solutions of a step along a path, each with contacts sought further.
PATH_SOLUTIONS = 4


def step_along(
    search: ContactSearch,
    mover: Mover,
    solver: LinearSolver,
    equations: Equations,
    path: "PathEquation",
    reach: float,
) -> Attempt:
    """Solve the step.

    Contacts are sought up to ``reach`` (m) at first. The equations are of the load factor that the
    step begins with.

    Raises
    ------
    SolveError
        Where nothing holds a part.
    """
    state, still, contact = equations.state, equations.end, search.contact
    request = StepRequest(equations.matrix, equations.force, solver, time=still.time)
    given, joints = (state, request, path), contact.record.book.points
    for _ in range(PATH_SOLUTIONS):
        contacts = search.candidates(state, reach, None)
        solved, change = path_solution(contact.steps, contacts, *given, joints)
        end = Instant(still.time, still.load_factor + change)
        result = mover.after(replace(equations, end=end), solved.answer.increment)
        if result.motion <= reach or not solved.answer.verdict.converged:
            break
        reach = FURTHER * result.motion
    verdict = solved.answer.verdict
    return result.told(verdict.converged, verdict.sentence, solved, solved.passes)
