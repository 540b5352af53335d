"""Friction of a whole step of statics that is corrected in the moved place: its force on the way.

First solutions know the weight of a light block to a share of the far larger forces beside it, and
so do corrections but the last one: what friction took is the force that lasts on the whole slip. It
counts by the mean of its limit where the step began and its force at the end where contacts slide
from the start, else by the latter. A correction may find other contacts, between the same bodies:
the limits of the start are then those of the bodies in sum.
"""

from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from covers.concatenate import concatenate, some_of
from integration.arrays import Bools, Floats, Ints


@dataclass(frozen=True)
class StepFriction:
    """What friction does at the contacts of a step, and what a solution counted of it.

    Attributes
    ----------
    key, bodies
        (m,) identity, and one number for each pair of bodies.
    limit, from_start
        (m,) largest shear force where the step began (N), and whether it acted then.
    force, slid
        (m,) shear force at the end (N) and slip since the step began (m), without signs.
    counted
        Energy (J) that the solution itself counted for its own slip.
    """

    key: Ints
    bodies: Ints
    limit: Floats
    from_start: Bools
    force: Floats
    slid: Floats
    counted: float

    @property
    def taken(self) -> float:
        """Energy (J) that friction took in the step."""
        mean = np.where(self.from_start, (self.limit + self.force) / 2, self.force)
        return float(mean @ self.slid)

    def corrected(self, then: Self) -> Self:
        """Return the friction of the step after the correction ``then``.

        Bodies that it finds apart took what they did.
        """
        if np.array_equal(self.key, then.key):
            limit, from_start = self.limit, self.from_start
        else:
            limit, from_start = self._in_sum(then)
        apart = ~np.isin(self.bodies, then.bodies[then.force > 0])
        lasts = np.isin(then.bodies, self.bodies[apart], invert=True)
        given = replace(then, limit=limit, from_start=from_start)
        return concatenate([some_of(given, lasts), some_of(self, apart)], {})

    def _in_sum(self, then: Self) -> tuple[Floats, Bools]:
        """Limits (m,) at the contacts of ``then``, shared as its forces are, and whether acting."""
        pairs, place = np.unique(np.concatenate([self.bodies, then.bodies]), return_inverse=True)
        mine, its = place[: len(self.key)], place[len(self.key) :]
        limit, end = (
            np.bincount(at, value, len(pairs))
            for at, value in ((mine, self.limit), (its, then.force))
        )
        late = np.bincount(mine, np.where(self.from_start, 0.0, self.limit), len(pairs))
        # Forces of rounding may be all that is left of a pair: their shares stay below one. Limits
        # of whole bonds are infinite, and a share of nothing is nothing.
        none = np.zeros(len(its))
        share = np.divide(then.force, end[its], out=none.copy(), where=end[its] > 0)
        shared = np.multiply(share, limit[its], out=none, where=share > 0)
        return shared, (late < limit / 2)[its] | (limit == 0)[its]
