"""Crossings in a step among all pairs that can meet in it, which no candidate search has chosen."""

import numpy as np

from integration.arrays import Ints
from nmm.contact.detection.crossing import Crossings, crossings_in, motion_of
from nmm.contact.detection.surface import Surface
from nmm.contact.detection.tolerances import DEPTH
from nmm.testing.detection.search import near_pairs


def find_crossings(before: Surface, after: Surface) -> Crossings:
    """Return the vertices that crossed an edge between two places of the same edges."""
    return crossings_in(motion_of(before, after, _meeting(before, after), DEPTH), DEPTH)


def _meeting(before: Surface, after: Surface) -> tuple[Ints, Ints]:
    """Pairs whose distance is not more than two points can move apart."""
    if not len(before):
        return np.empty(0, np.int64), np.empty(0, np.int64)
    moved = after.start - before.start
    return near_pairs(before, float(np.hypot(*np.ptp(moved, axis=0))))
