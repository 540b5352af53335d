"""Anderson's acceleration (1965; Walker, Ni 2011) of fixed-point iterations, in compiled code."""

from dataclasses import dataclass, field

import numpy as np

from integration.arrays import Floats
from nmm.compiled import compiled
from nmm.solvers.kernels.dot import dot
from nmm.solvers.kernels.gauss import ridged

RIDGE = 1e-12
"""Part of the trace that keeps the least squares regular."""


@dataclass
class Anderson:
    """Least squares over the last iterates of ``x <- x + correction(x)``.

    The correction of an iteration ``x <- x - M^-1 F(x)`` is ``-M^-1 F``: inner products in ``M``
    of corrections are products of a correction with a residual ``F``, so that no product with
    ``M`` is needed. A plain fixed point has ``M = 1``: its residual is minus its correction.
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

    def add(self, step: Floats, new: Floats, old: Floats, after: Floats, before: Floats) -> None:
        """Remember a step in the place of the oldest.

        ``new`` and ``old`` are the corrections, ``after`` and ``before`` the residuals.
        """
        at, self.count = self.count % self.depth, self.count + 1
        used = min(self.count, self.depth)
        add_step(self.sums, self.corrections, self.gram, at, used, step, new, old, after, before)

    def mixed(self, correction: Floats, residual: Floats) -> Floats:
        """Step that combines ``correction`` with the remembered ones (least squares in ``M``)."""
        used = min(self.count, self.depth)
        return np.asarray(
            mixed_step(self.sums, self.corrections, self.gram, used, correction, residual)
        )


@dataclass
class FixedPoint:
    """Solve ``x = image(x)`` for a short vector.

    Attributes
    ----------
    history
        Differences of iterates that are combined.
    """

    history: Anderson = field(default_factory=lambda: Anderson(8))
    _last: tuple[Floats, Floats] | None = None

    def next(self, point: Floats, image: Floats) -> Floats:
        """Return where to evaluate the image next, given that of ``point``."""
        correction = image - point
        if self._last is None:
            self.history.start(len(point))
        else:
            before, old = self._last
            self.history.add(point - before, correction, old, -correction, -old)
        self._last = point, correction
        return np.asarray(point + self.history.mixed(correction, -correction))


@compiled
def add_step(
    sums: Floats,
    corrections: Floats,
    gram: Floats,
    at: int,
    used: int,
    step: Floats,
    new: Floats,
    old: Floats,
    force_new: Floats,
    force_old: Floats,
) -> None:
    """Put step, change of correction and their products in place ``at`` of ``used``."""
    for i in range(len(step)):
        corrections[at, i] = new[i] - old[i]
        sums[at, i] = step[i] + corrections[at, i]
    gained = force_new - force_old
    for j in range(used):
        gram[at, j] = gram[j, at] = -dot(corrections[j], gained)


@compiled
def mixed_step(
    sums: Floats, corrections: Floats, gram: Floats, used: int, correction: Floats, force: Floats
) -> Floats:
    """``correction`` combined with the remembered steps; as it is where these say nothing."""
    table, load = np.empty((used, used)), np.empty(used)
    for k in range(used):
        for j in range(used):
            table[k, j] = gram[k, j]
        load[k] = -dot(corrections[k], force)
    result, shares = correction.copy(), ridged(table, load, RIDGE)
    for k in range(used):
        for i in range(len(result)):
            result[i] -= shares[k] * sums[k, i]
    return result
