"""A step along a path, whole, from cell to cell, or in parts that Newton's method can solve.

Contacts that stick and slide, open and close in turn can make Newton's method cycle. It is tried
with more patience, then cells of contact states are followed (`cells`): from the start of the step,
and from where Newton's method ended. A law that is curved has no cells. There, from an iterate
whose forces are out of balance by ``r``, there is a line of problems that want ``t r`` less than
all of it, with the path's target as far on: at ``t = 0`` the iterate solves its problem, and each
solution is a guess near that of a slightly larger ``t`` (Newton homotopy; Allgower and Georg 1990).
Where no part of the way can be gone, however small, solutions turn back before the target, as
friction lets them: the step is given up.
"""

from dataclasses import replace

import numpy as np

from nmm.contact.following.cells import from_cell_to_cell
from nmm.contact.following.newton import newton
from nmm.contact.following.path_problem import PathProblem, PathStep
from nmm.controls.path_equation import PathEquation
from nmm.solvers.linear import LinearSolver

# The first part of the way, and the smallest.
FIRST_PART, LEAST_PART = 0.25, 2.0**-20
# Solutions of parts after which a step is given up.
WAYPOINTS = 60


def follow(problem: PathProblem, path: PathEquation, solver: LinearSolver) -> PathStep:
    """Solve a step along a path.

    Raises
    ------
    SolveError
        Where nothing holds a part.
    """
    begin = problem.at(path, np.zeros_like(problem.force), 0.0)
    if begin.converged and path.target == 0:
        return begin
    if path.target and path.row.any():
        begin = problem.loaded_further(begin)
    begin = problem.touching_stick(begin)
    found = newton(problem, path, solver, begin)
    if not found.converged:
        again = newton(problem, path, solver, begin, patient=True)
        found = replace(again, iterations=found.iterations + again.iterations)
    if found.converged:
        return found
    for start in (begin, found):
        end = from_cell_to_cell(problem, path, solver, start)
        if end is not None and end.converged:
            return replace(end, iterations=found.iterations + end.iterations)
    return _by_parts(problem, path, solver, begin, found)


def _by_parts(
    problem: PathProblem,
    path: PathEquation,
    solver: LinearSolver,
    begin: PathStep,
    lost: PathStep,
) -> PathStep:
    """Return the solution at the end of the way from the start, or the one that was lost."""
    at, gone, part, iterations = begin, 0.0, FIRST_PART, lost.iterations
    for _ in range(WAYPOINTS):
        ahead = min(gone + part, 1.0)
        short = replace(problem, force=problem.force - (1 - ahead) * begin.rest)
        guess = short.at(path, at.increment, at.change)
        found = newton(short, replace(path, target=ahead * path.target), solver, guess)
        iterations += found.iterations
        if not found.converged:
            part /= 4
        elif ahead == 1.0:
            return replace(found, iterations=iterations)
        else:
            at, gone, part = found, ahead, 2 * part
        if part < LEAST_PART:
            break
    return replace(lost, iterations=iterations)
