"""Modified Newton (fixed tangent) with Anderson acceleration.

``d <- d - M^-1 F(d)`` with ``M`` the matrix of all springs acting contracts for every convex
problem because the tangent never exceeds ``M``; acceleration over the last steps (Anderson 1965;
Walker, Ni 2011) in the inner product of ``M`` makes it fast where few contacts change their state.
"""

from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats
from nmm.contact.iteration.newton import compiled_newton
from nmm.contact.iteration.options import DEFAULT
from nmm.contact.iteration.options.budgets import Patience
from nmm.contact.iteration.options.springs import AlternationOptions
from nmm.contact.problem.cut_springs import CutSprings, Residual
from nmm.solvers.anderson import Anderson
from nmm.solvers.linear import Factor


@dataclass
class ModifiedNewton:
    """State of the iteration; `run` may be called again with another factor.

    Attributes
    ----------
    springs
        The equations.
    factor
        Factor of a matrix near that of all springs acting.
    increment, residual
        Best unknowns so far and their out-of-balance force.
    solves
        Linear solves so far.
    """

    springs: CutSprings
    factor: Factor
    increment: Floats
    residual: Residual
    options: AlternationOptions = DEFAULT.alternation
    solves: int = 0

    def run(self, budget: int, tolerance: float, patience: Patience | None = None) -> bool:
        """Take at most ``budget`` solves; return whether ``tolerance`` was reached.

        Without ``patience`` slow runs go on as well.
        """
        if compiled_newton.serves(self.factor):
            start = self.increment, self.residual.force, self.residual.size
            steer = self.options.depth, self.options.growth
            increment, force, size, solves = compiled_newton.run(
                self.factor, self.springs.columns, start, budget, tolerance, patience, steer
            )
            self.increment, self.residual = increment, Residual(force, size)
            self.solves += solves
            return size <= tolerance
        return self._plain(budget, tolerance, patience)

    def _plain(self, budget: int, tolerance: float, patience: Patience | None) -> bool:
        """Do the same by a loop in Python, for any factor."""
        most, sizes = self.solves + budget, [self.residual.size]
        terms = compiled_newton.terms(patience)
        history = Anderson(self.options.depth)
        history.start(len(self.increment))
        at, residual = self.increment, self.residual
        correction = None
        while self.residual.size > tolerance and self.solves < most:
            if correction is None:
                correction = self._correction(residual)
            step = history.mixed(correction, residual.force)
            found = self.springs.residual(at + step)
            if history.count and not found.size < self.options.growth * self.residual.size:
                history.count = 0
                at, residual, correction = self.increment, self.residual, None
                continue
            if found.size <= tolerance:
                self.increment, self.residual = at + step, found
                break
            new = self._correction(found)
            history.add(step, new, correction, found.force, residual.force)
            at, residual, correction = at + step, found, new
            if not np.isfinite(found.size):
                break
            if found.size < self.residual.size:
                self.increment, self.residual = at, found
            sizes.append(self.residual.size)
            if compiled_newton.lost(np.array(sizes), terms, tolerance):
                break
        return self.residual.size <= tolerance

    def _correction(self, residual: Residual) -> Floats:
        self.solves += 1
        return -self.factor.rough(residual.force)
