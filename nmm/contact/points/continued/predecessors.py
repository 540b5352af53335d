"""Which points of the last accepted step those found now continue."""

from dataclasses import dataclass

import numpy as np

from integration.arrays import Bools, Ints
from nmm.contact.points.contact_points import ContactPoints


@dataclass(frozen=True)
class Predecessors:
    """What the points found now (m,) continue.

    Attributes
    ----------
    old
        Points of the last accepted step, with gaps as counted (m); none before the first.
    number
        (m,) which of them each new point continues, -1 where it is new.
    lasting
        (m,) springs that stay as they are while they push.
    """

    old: ContactPoints
    number: Ints
    lasting: Bools

    @property
    def known(self) -> Bools:
        """(m,) points that continue one."""
        return self.number >= 0

    @property
    def source(self) -> Ints:
        """(m,) numbers of the old points, 0 for those that continue none."""
        return self.number.clip(0)

    def stay(self, new: ContactPoints) -> Bools:
        """Which of the new points (m,) are the same pair as the old one that they continue."""
        return np.asarray(self.known & (self.old.key[self.source] == new.key))
