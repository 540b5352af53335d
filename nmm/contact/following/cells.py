"""A step along a path from cell to cell of contact states: a piecewise linear homotopy.

From an iterate whose forces are out of balance by ``r`` there is a line of problems that lack
``(1 - t) r``, and as much of the path's target. It is straight as long as no contact changes its
tangent; where the first of them does the next cell begins (Katzenelson 1965). Where the line goes
on into it only with a falling ``t``, as friction lets it, ``t`` turns round for a while (Chien and
Kuh 1976). Ends of cells are sought by the tangents alone, as laws name none.
"""

from dataclasses import dataclass, replace

import numpy as np

from integration.arrays import Bools, Floats
from nmm.contact.following.linear_step import linear_step
from nmm.contact.following.path_problem import PathProblem, PathStep
from nmm.controls.path_equation import PathEquation
from nmm.errors import SolveError
from nmm.solvers.linear import LinearSolver

# Cells for each contact, and how far `t` may fall below its start; a step beyond is given up.
EACH, BEHIND = 10, 1e3
# Halvings that find the end of a cell to the last digit.
HALVINGS = 60
# Tangents that differ by less, relative to each contact's largest, are one; those on both sides of
# the end of a cell differ by more, unless a law is curved.
SAME, OTHER = 1e-9, 1e-6
# Share of the stiffest that less stiff contacts count as, so that rounding makes no cells: beside
# springs of 1e12 N/m it leaves some 0.01 of tangents that are none.
FELT = 1e-4


def from_cell_to_cell(
    problem: PathProblem, path: PathEquation, solver: LinearSolver, begin: PathStep
) -> PathStep | None:
    """Return the end of the line from an iterate.

    None where it has none: in a cell without stiffness, after too many cells, or under a law that
    is curved.
    """
    line = _Line(problem, path, solver, begin)
    at, slopes, share, turn = begin, begin.contacts.tangent, 0.0, 1.0
    try:
        way = line.way(slopes)
        for count in range(1, EACH * max(len(slopes), 1) + 1):
            left = 1 - share if turn > 0 else share + BEHIND
            length, beyond = line.leaves(at, turn * way, slopes, left)
            at, share = line.on(at, turn * way, length), share + turn * length
            if beyond is None:
                return replace(at, iterations=count) if turn > 0 else None
            if not _differ(beyond, slopes, OTHER).any():
                return None
            jump, last = beyond - slopes, way
            slopes, way = beyond, line.way(beyond)
            # What leaves one cell goes on in the next.
            if np.vdot(line.forces(jump, last), line.forces(jump, way)) < 0:
                turn = -turn
    except SolveError:
        return None
    return None


@dataclass(frozen=True)
class _Line:
    """Iterates of the problems between that of an iterate and the step's own.

    Ways are increments and changes of the load factor (n + 1,).
    """

    problem: PathProblem
    path: PathEquation
    solver: LinearSolver
    begin: PathStep

    def way(self, slopes: Floats) -> Floats:
        """Return the way (n + 1,) of a whole ``t`` in the cell of tangents (m, 2, 2)."""
        path, begin = self.path, self.begin
        tangent = self.problem.tangent(begin, slopes)
        still, along = linear_step(self.solver, tangent, path, begin)
        change = path.change(along, begin.increment + still, begin.change)
        return np.append(still + change * along, change)

    def on(self, at: PathStep, way: Floats, part: float) -> PathStep:
        """Return the iterate a part of a way (n + 1,) further."""
        ends = at.increment + part * way[:-1], at.change + part * float(way[-1])
        return self.problem.at(self.path, *ends)

    def leaves(
        self, at: PathStep, way: Floats, slopes: Floats, left: float
    ) -> tuple[float, Floats | None]:
        """Return how far along a way a cell goes, and tangents beyond; None where none is left."""
        low, high = 0.0, left
        beyond = self.on(at, way, high).contacts.tangent
        if not _differ(beyond, slopes, SAME).any():
            return left, None
        for _ in range(HALVINGS):
            middle = (low + high) / 2
            found = self.on(at, way, middle).contacts.tangent
            if _differ(found, slopes, SAME).any():
                high, beyond = middle, found
            else:
                low = middle
        return high, beyond

    def forces(self, slopes: Floats, way: Floats) -> Floats:
        """Return forces (m, 2) by tangents (m, 2, 2) on a way."""
        rows = self.problem.rows
        rates = np.stack([part @ way[:-1] for part in (rows.normal, rows.tangent)], axis=1)
        return np.asarray(np.einsum("mij,mj->mi", slopes, rates))


def _differ(some: Floats, others: Floats, share: float) -> Bools:
    """Which tangents (m, 2, 2) differ by more than a share of the larger ones that are felt."""
    size = np.maximum(np.abs(some), np.abs(others)).max(axis=(1, 2))
    size = np.maximum(size, FELT * size.max(initial=0.0))
    return np.asarray(np.abs(some - others).max(axis=(1, 2)) > share * size)
