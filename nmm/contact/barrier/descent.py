"""Newton's method inside the walls of a barrier, with line searches that never cross one."""

from dataclasses import dataclass

import numpy as np

from integration.arrays import Bools, Floats
from nmm.contact.barrier.potential import Potential, Pull
from nmm.contact.problem.balance import length, relative_residual
from nmm.contact.problem.matrix_pattern import SpringPattern
from nmm.solvers.linear import LinearSolver

NEAR = 0.9
"""Part of the distance to a wall that a step may use up."""
FLAT = 0.1
"""Part of the slope that a line search may leave."""
TRIALS = 40
"""Most points that a line search looks at."""
SHORT = 1e-3
"""Shortest step of the coupled iteration: below, the friction bound is better held."""
SHARES = (3, 1.0), (10, 0.5), (np.inf, 0.2)
"""Part of the new friction bound that is taken, up to so many updates."""
FEWER = 0.2
"""Part of the out-of-balance force at the last coupled iteration at which another is tried."""
FIRM, LOOSE = 0.1, 3e-2
"""A minimum is found to this part of the last out-of-balance force, and at first to `LOOSE`."""
HOPELESS = 0.5
"""Out-of-balance force after two bounds at which nothing holds a part."""
QUICK = 30
"""Most steps of one coupled iteration."""


@dataclass
class Descent:
    """Newton's method on a `Potential`, with the count of its factorisations.

    The potential is convex for a given bound of the friction; its line searches look for the zero
    of the slope, which grows along the line. Differences of the energy would be lost to rounding
    at 1e-7 of the load, with stiff barriers and thousands of contacts.
    """

    pattern: SpringPattern
    linear: LinearSolver
    weight: Floats
    factorisations: int = 0

    def balanced(
        self, well: Potential, increment: Floats, bound: Floats, tolerance: float, passes: int
    ) -> tuple[Floats, float, int]:
        """Unknowns (n,), their relative out-of-balance force, and updates of the bound.

        Minimises for the ``bound`` (m,), tries the coupled iteration from there, and takes the
        new bound, until both agree or ``passes`` updates are spent.
        """
        size = tried = np.inf
        for count in range(1, passes + 1):
            rough = max(0.01 * tolerance, min(LOOSE, FIRM * size))
            increment = self.minimum(well, increment, bound, rough, passes)
            size = self.size(well, increment)
            if size <= FEWER * tried:
                tried = size
                near = self.coupled(well, increment, tolerance, min(passes, QUICK))
                if self.size(well, near) <= tolerance:
                    return near, self.size(well, near), count
            if size <= tolerance or (count > 1 and size > HOPELESS):
                break
            share = next(part for until, part in SHARES if count <= until)
            now = well.bound(well.normal(well.problem.gaps(increment))[0])
            before = np.where(np.isfinite(bound), bound, 0.0)  # springs may have no limit
            bound = share * now + (1 - share) * before
        return increment, size, count

    def size(self, well: Potential, increment: Floats) -> float:
        """Relative out-of-balance force, friction bounded by its own normal force."""
        return well.imbalance(increment, self.weight)

    def minimum(
        self, well: Potential, increment: Floats, bound: Floats, tolerance: float, budget: int
    ) -> Floats:
        """Unknowns (n,) of least potential for a given bound (m,)."""
        problem = well.problem
        for _ in range(budget):
            pull = well.pull(problem.gaps(increment), problem.slips(increment), bound)
            size = relative_residual(problem, self.weight, increment, pull.normal, pull.shear)
            if size <= tolerance:
                break
            step = self._step(well, increment, pull, self.linear)
            t = _lowest(well, increment, step, bound)
            if t == 0.0 or not np.isfinite(step).all():
                break
            increment = increment + t * step
        return increment

    def coupled(self, well: Potential, increment: Floats, tolerance: float, budget: int) -> Floats:
        """Unknowns (n,) in balance with friction that follows the normal force, if near.

        The matrix is unsymmetric and there is no potential: steps must shorten the out-of-balance
        force, and the iteration ends where only short ones do.
        """
        problem, linear = well.problem, self.linear.unsymmetric()
        for _ in range(budget):
            pull = well.pull(problem.gaps(increment), problem.slips(increment))
            size = relative_residual(problem, self.weight, increment, pull.normal, pull.shear)
            if size <= tolerance:
                break
            step = self._step(well, increment, pull, linear)
            if not np.isfinite(step).all():
                break
            rest = self._rest(well, increment)
            t = _longest(well, increment, step)
            while t >= SHORT and not self._rest(well, increment + t * step) < (1 - 0.1 * t) * rest:
                t /= 2
            if t < SHORT:
                break
            increment = increment + t * step
        return increment

    def _step(self, well: Potential, increment: Floats, pull: Pull, linear: LinearSolver) -> Floats:
        problem = well.problem
        stiffness = (pull.normal_stiffness, pull.shear_stiffness, pull.mixed_stiffness)
        rest = problem.out_of_balance(increment, pull.normal, pull.shear)
        self.factorisations += 1
        return -linear.factorise(self.pattern.matrix(problem, *stiffness)).refined(rest)

    def _rest(self, well: Potential, increment: Floats) -> float:
        problem = well.problem
        pull = well.pull(problem.gaps(increment), problem.slips(increment))
        rest = problem.out_of_balance(increment, pull.normal, pull.shear)
        return length(self.weight * rest)


def _lowest(well: Potential, increment: Floats, step: Floats, bound: Floats) -> float:
    """Part of ``step`` at which the slope of the potential vanishes, or all that is feasible."""
    problem = well.problem
    gap, slip = problem.gaps(increment), problem.slips(increment)
    opening, sliding = problem.normal_rows @ step, problem.tangent_rows @ step
    bent = step @ (problem.matrix @ step)
    start = step @ (problem.matrix @ increment - problem.force)

    def slope(t: float) -> float:
        pull = well.pull(gap + t * opening, slip + t * sliding, bound)
        return float(start + t * bent + opening @ pull.normal + sliding @ pull.shear)

    low, high = 0.0, _longest(well, increment, step)
    at_low, at_high = slope(low), slope(high)
    flat = FLAT * abs(at_low)
    if at_low >= 0 or at_high <= flat:
        return high if at_low < 0 else 0.0
    for _ in range(TRIALS):
        # regula falsi, kept from the ends: the slope is steep at the wall
        share = min(max(at_low / (at_low - at_high), 0.1), 0.9)
        middle = low + share * (high - low)
        at_middle = slope(middle)
        if abs(at_middle) <= flat:
            return middle
        if at_middle < 0:
            low, at_low = middle, at_middle
        else:
            high, at_high = middle, at_middle
    return low


def _longest(well: Potential, increment: Floats, step: Floats) -> float:
    now = well.problem.gaps(increment) + well.offset
    change = np.asarray(well.problem.normal_rows @ step)
    near: Bools = (change < 0) & ~well.spring
    if not near.any():
        return 1.0
    return min(1.0, NEAR * float((-now[near] / change[near]).min()))
