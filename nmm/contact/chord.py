"""Newton's chord method with one kept factor and Anderson acceleration.

``d <- d - M^-1 F(d)`` with ``M`` the matrix of all springs acting contracts for every convex
problem because the tangent never exceeds ``M``; acceleration over the last steps (Anderson 1965;
Walker, Ni 2011) in the inner product of ``M`` makes it fast where few contacts change their state.
"""

from dataclasses import dataclass, field

import numpy as np

from integration.arrays import Floats
from nmm.contact.springs import CutSprings, Defect
from nmm.solvers.linear import Factor

GROWTH = 3.0
"""An accelerated step that multiplies the best defect by more than this is taken back."""


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

    def add(self, step: Floats, correction: Floats, defect: Floats) -> None:
        """Remember one step in the place of the oldest."""
        at, self.count = self.count % self.depth, self.count + 1
        self.sums[at], self.corrections[at] = step + correction, correction
        used = min(self.count, self.depth)
        self.gram[at, :used] = self.gram[:used, at] = -_products(self.corrections[:used], defect)

    def mixed(self, correction: Floats, defect: Floats) -> Floats:
        """Step that combines ``correction`` with the remembered ones (least squares in ``M``)."""
        used = min(self.count, self.depth)
        if not used:
            return correction
        gram = self.gram[:used, :used]
        trace = float(np.trace(gram))
        if not (np.isfinite(trace) and trace > 0):
            return correction
        share = np.linalg.solve(
            gram + 1e-12 * trace * np.eye(used), -_products(self.corrections[:used], defect)
        )
        return np.asarray(correction - np.einsum("i,ij->j", share, self.sums[:used]))


def _products(vectors: Floats, vector: Floats) -> Floats:
    """Inner products, without the threads that BLAS starts for long vectors."""
    return np.asarray(np.einsum("ij,j->i", vectors, vector))


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
    sizes
        Relative defect after every solve.
    """

    springs: CutSprings
    factor: Factor
    increment: Floats
    defect: Defect
    depth: int = 10
    solves: int = 0
    sizes: list[float] = field(default_factory=list)

    def run(self, budget: int, tolerance: float) -> bool:
        """Take at most ``budget`` solves; return whether ``tolerance`` was reached."""
        history = History(self.depth)
        history.start(len(self.increment))
        at, defect = self.increment, self.defect
        correction = None
        while self.defect.size > tolerance and budget > 0:
            if correction is None:
                correction, budget = self._correction(defect), budget - 1
            step = history.mixed(correction, defect.force)
            found = self.springs.defect(at + step)
            if history.count and not found.size < GROWTH * self.defect.size:
                history.count = 0
                at, defect, correction = self.increment, self.defect, None
                continue
            new, budget = self._correction(found), budget - 1
            history.add(step, new - correction, found.force - defect.force)
            at, defect, correction = at + step, found, new
            if not np.isfinite(found.size):
                break
            if found.size < self.defect.size:
                self.increment, self.defect = at, found
        return self.defect.size <= tolerance

    def rate(self, window: int = 20) -> float:
        """Mean factor by which a solve reduced the best defect, over the last solves."""
        if len(self.sizes) < window + 1:
            return 0.0
        before, now = min(self.sizes[:-window]), min(self.sizes)
        return float((now / before) ** (1 / window))

    def _correction(self, defect: Defect) -> Floats:
        self.solves += 1
        self.sizes.append(defect.size)
        return -self.factor.apply(defect.force)
