"""Modified Newton (fixed tangent) with Anderson acceleration.

``d <- d - M^-1 F(d)`` with ``M`` the matrix of all springs acting contracts for every convex
problem because the tangent never exceeds ``M``; acceleration over the last steps (Anderson 1965;
Walker, Ni 2011) in the inner product of ``M`` makes it fast where few contacts change their state.
"""

from dataclasses import dataclass, field

import numpy as np

from integration.arrays import Floats
from nmm.contact.iteration import anderson_kernel as mixing_kernel
from nmm.contact.problem.cut_springs import CutSprings, Defect
from nmm.solvers.linear import Factor

GROWTH = 3.0
"""An accelerated step that multiplies the best defect by more than this is taken back."""


@dataclass(frozen=True)
class Patience:
    """How long an iteration may go on that gets on slowly.

    Attributes
    ----------
    ahead
        Most solves that may lie ahead at the rate of the last ones.
    below
        Relative out-of-balance force below which it is judged.
    look
        Solves over which the rate is taken.
    """

    ahead: float
    below: float = np.inf
    look: int = 4

    def lost(self, sizes: list[float], tolerance: float) -> bool:
        """Whether the best ``sizes`` so far, one a solve, forecast too many solves."""
        if len(sizes) <= self.look or not sizes[-1] < self.below:
            return False
        gain = np.log(sizes[-1 - self.look] / sizes[-1]) / self.look
        return not gain * self.ahead >= np.log(sizes[-1] / tolerance)


@dataclass
class History:
    """Differences of the last iterates: corrections, and steps plus corrections.

    ``correction = -M^-1 defect``, so inner products in ``M`` of corrections are products of a
    correction with a defect: no product with ``M`` is needed.
    """

    depth: int
    sums: Floats = field(init=False)
    corrections: Floats = field(init=False)
    gram: Floats = field(init=False)
    count: int = 0

    def start(self, n: int) -> None:
        """Make room for vectors of ``n`` unknowns."""
        self.sums, self.corrections = np.empty((2, self.depth, n))
        self.gram = np.zeros((self.depth, self.depth))

    def add(
        self, step: Floats, new: Floats, old: Floats, force_new: Floats, force_old: Floats
    ) -> None:
        """Remember a step in the place of the oldest: corrections and defects after and before."""
        at, self.count = self.count % self.depth, self.count + 1
        used = min(self.count, self.depth)
        mixing_kernel.add(
            *(self.sums, self.corrections, self.gram, at, used),
            *(step, new, old, force_new, force_old),
        )

    def mixed(self, correction: Floats, defect: Floats) -> Floats:
        """Step that combines ``correction`` with the remembered ones (least squares in ``M``)."""
        used = min(self.count, self.depth)
        step = mixing_kernel.mixed(self.sums, self.corrections, self.gram, used, correction, defect)
        return np.asarray(step)


@dataclass
class Chord:
    """State of the iteration; `run` may be called again with another factor.

    Attributes
    ----------
    springs
        The equations.
    factor
        Factor of a matrix near that of all springs acting.
    increment, defect
        Best unknowns so far and their out-of-balance force.
    solves
        Linear solves so far.
    """

    springs: CutSprings
    factor: Factor
    increment: Floats
    defect: Defect
    depth: int = 10
    solves: int = 0

    def run(self, budget: int, tolerance: float, patience: Patience | None = None) -> bool:
        """Take at most ``budget`` solves; return whether ``tolerance`` was reached.

        Without ``patience`` slow runs go on as well.
        """
        most, sizes = self.solves + budget, [self.defect.size]
        history = History(self.depth)
        history.start(len(self.increment))
        at, defect = self.increment, self.defect
        correction = None
        while self.defect.size > tolerance and self.solves < most:
            if correction is None:
                correction = self._correction(defect)
            step = history.mixed(correction, defect.force)
            found = self.springs.defect(at + step)
            if history.count and not found.size < GROWTH * self.defect.size:
                history.count = 0
                at, defect, correction = self.increment, self.defect, None
                continue
            if found.size <= tolerance:
                self.increment, self.defect = at + step, found
                break
            new = self._correction(found)
            history.add(step, new, correction, found.force, defect.force)
            at, defect, correction = at + step, found, new
            if not np.isfinite(found.size):
                break
            if found.size < self.defect.size:
                self.increment, self.defect = at, found
            sizes.append(self.defect.size)
            if patience is not None and patience.lost(sizes, tolerance):
                break
        return self.defect.size <= tolerance

    def _correction(self, defect: Defect) -> Floats:
        self.solves += 1
        return -self.factor.apply(defect.force)
