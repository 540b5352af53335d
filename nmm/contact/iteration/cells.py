"""Cut springs solved from cell to cell of contact states: a piecewise linear homotopy.

With limits that are fixed the forces of cut springs are piecewise linear in gaps and slips, and so
is the out-of-balance force ``F``. From an iterate ``x0`` the line ``F(x) = (1 - t) F(x0)`` leads to
a solution at ``t = 1``. It is straight within a cell, where each contact is pressed, pulled or at
its tensile limit, and sticks or slides either way; where the first of them changes its state the
next cell begins (Katzenelson 1965). Where the determinant changes its sign ``t`` turns round for a
while (Chien and Kuh 1976). Stiffnesses may differ as they like: with springs of 1e4 of a penalty
beside others of less than one, Newton's method goes to and fro.
"""

from dataclasses import dataclass
from typing import Self

import numpy as np

from integration.arrays import Bools, Floats, Ints
from nmm.contact.iteration.tools import Tools
from nmm.contact.problem.coulomb import shear_bound, states
from nmm.contact.problem.cut_springs import CutSprings
from nmm.contact.problem.row_products import stretched
from nmm.solvers.factor import Factor

# Contacts up to which cells are followed, each by full matrices of all jumps, and cells for each.
FEW, EACH = 100, 10

PRESSED, PULLED, CUT = 0, 1, 2
# Sides of a cell: the normal or shear state beyond each of them, in the order of `_Cell.sides`.
BEHIND_SIDES = np.array((PULLED, PRESSED, CUT, PULLED, 1, -1, 0, 0))
NORMAL_SIDES = 4


def from_cell_to_cell(springs: CutSprings, tools: Tools, increment: Floats) -> Floats | None:
    """Return the unknowns (n,) at the end of the line from an increment (n,).

    None where it has no end within `EACH` cells a contact, or comes back to before its start.

    Raises
    ------
    SolveError
        When even with all springs acting the load moves a free part.
    """
    line = _Line.of(springs, tools, increment)
    jumps = line.end()
    return None if jumps is None else line.unknowns(jumps)


@dataclass(frozen=True)
class _Line:
    """The problem of the jumps (2 m,) alone, normal ones first.

    Attributes
    ----------
    factor
        Of the matrix with all springs acting.
    answers
        (2 m, 2 m) jumps that unit forces make, all springs acting (m/N).
    start
        (2 m,) jumps where the line begins (m).
    """

    springs: CutSprings
    factor: Factor
    answers: Floats
    start: Floats

    @classmethod
    def of(cls, springs: CutSprings, tools: Tools, increment: Floats) -> Self:
        problem = springs.problem
        pattern = tools.memory.pattern_of(problem)
        factor = tools.linear.factorise(pattern.matrix(problem, *springs.stiffness))
        each = (row for some in problem.rows for row in some.toarray())  # at most 2 `FEW`
        answers = np.array([_jumps(springs, factor.solve(row)) for row in each]).T
        return cls(springs, factor, answers, _jumps(springs, increment))

    def end(self) -> Floats | None:
        """Return the jumps (2 m,) at the end of the line; None without one."""
        jumps, share = self.start, 0.0
        rest = jumps - _jumps(self.springs, self.unknowns(jumps))
        cell = _Cell.at(self.springs, jumps)
        for _ in range(EACH * self.springs.problem.n_contacts):
            tangent = np.eye(len(jumps)) - self.answers @ cell.relief
            turn = float(np.linalg.slogdet(tangent)[0])
            if turn == 0:
                return None
            way = -turn * np.linalg.solve(tangent, rest).astype(np.float64)
            length, side, contact = cell.leaves(jumps, way)
            if turn > 0 and share + length >= 1:
                return np.asarray(jumps + (1 - share) * way)
            jumps, share = jumps + length * way, share + turn * length
            if not 0 <= share < np.inf:
                return None
            cell.enter(side, contact)
        return None

    def unknowns(self, jumps: Floats) -> Floats:
        """Return the unknowns (n,) under the forces that springs have at jumps (2 m,)."""
        springs, problem = self.springs, self.springs.problem
        given = springs.stiffness * jumps.reshape(2, -1)
        left = given - springs.cut(*_trial(springs, jumps))
        load = problem.force + problem.pushed(*left)
        return self.factor.solve(load, problem.among)


@dataclass
class _Cell:
    """States of contacts among which forces are linear in jumps.

    Attributes
    ----------
    normal
        (m,) `PRESSED`, `PULLED` or `CUT` at the tensile limit.
    shear
        (m,) direction of sliding, 0 where a contact sticks.
    """

    springs: CutSprings
    normal: Ints
    shear: Ints

    @classmethod
    def at(cls, springs: CutSprings, jumps: Floats) -> Self:
        """Return the cell of jumps (2 m,)."""
        pull, drag = _trial(springs, jumps)
        is_open, sliding, _ = states(pull, drag, springs.problem.limits)
        normal = np.where(is_open, CUT, np.where(pull < 0, PRESSED, PULLED))
        return cls(springs, normal, np.where(sliding, np.sign(drag), 0).astype(np.int64))

    @property
    def relief(self) -> Floats:
        """(2 m, 2 m) stiffness of all springs less that of the cell (N/m)."""
        normal, shear = self.springs.stiffness
        pressed, slides = self.normal == PRESSED, self.shear != 0
        friction = self.springs.problem.limits.friction
        found = np.diag(np.append(normal * (self.normal == CUT), shear * slides))
        m = np.arange(len(normal))
        found[m + len(m), m] = np.where(pressed, self.shear * friction * normal, 0.0)
        return found

    def leaves(self, jumps: Floats, way: Floats) -> tuple[float, int, int]:
        """Return how far along a way (2 m,) the cell goes, and the side and contact it ends at."""
        limits, moved = self.springs.problem.limits, self.springs.stiffness * way.reshape(2, -1)
        pressed, closed = self.normal == PRESSED, self.normal != CUT
        trial = _trial(self.springs, jumps)
        bound = shear_bound(np.where(pressed, trial[0], 0.0), closed, limits)
        rising = -limits.friction * np.where(pressed, moved[0], 0.0)
        within = _within(trial, limits.tension, bound)
        rate = _within(moved, np.zeros_like(rising), rising)
        length = np.full(rate.shape, np.inf)
        closes = self._sides & (rate < 0)
        np.divide(np.maximum(within, 0.0), -rate, out=length, where=closes)
        side, contact = np.unravel_index(int(np.argmin(length)), length.shape)
        return float(length[side, contact]), int(side), int(contact)

    def enter(self, side: int, contact: int) -> None:
        """Go on to the cell beyond a side, at which one contact changes its state."""
        state = self.normal if side < NORMAL_SIDES else self.shear
        state[contact] = BEHIND_SIDES[side]

    @property
    def _sides(self) -> Bools:
        """Which sides (8, m) the cell has."""
        pressed, pulled, cut = (self.normal == one for one in (PRESSED, PULLED, CUT))
        sticks, ahead, back = (self.shear == one for one in (0, 1, -1))
        return np.array((pressed, pulled, pulled, cut, sticks, sticks, ahead, back))


def _within(trial: Floats, tension: Floats, bound: Floats) -> Floats:
    """(8, m) how far trial forces (2, m) are within each side, or how fast they come from it."""
    pull, drag = trial
    room, ahead, back = tension - pull, bound - drag, bound + drag
    return np.array((-pull, pull, room, -room, ahead, back, -ahead, -back))


def _jumps(springs: CutSprings, increment: Floats) -> Floats:
    """Return how far (2 m,) contacts open and slip under unknowns (n,), in m."""
    return stretched(*springs.problem.rows, increment).ravel()


def _trial(springs: CutSprings, jumps: Floats) -> Floats:
    """Return normal and shear forces (2, m) of uncut springs at jumps (2 m,)."""
    problem = springs.problem
    stretch = np.array((problem.gap, problem.slip)) + jumps.reshape(2, -1)
    return np.asarray(springs.stiffness * stretch + springs.shift)
