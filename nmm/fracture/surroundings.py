"""What lies about the tip of a crack: other tips, and faces off the line behind it."""

import numpy as np

from covers.cutting.cut_cells import CutCells
from integration.arrays import Bools, Floats


def nearest_tip(cut: CutCells, tip: int) -> float:
    """Return the distance of the nearest other tip (m); infinite without one."""
    others = np.delete(cut.tips.point, tip, axis=0)
    return float(np.hypot(*(others - cut.tips.point[tip]).T).min(initial=np.inf))


def off_line(start: Floats, end: Floats, point: Floats, ahead: Floats, share: float) -> Bools:
    """Segments (n,) with an end that lies off the line behind a tip, or ahead of it.

    Off is what lies aside by more than a ``share`` of its distance.
    """
    off = np.zeros(len(start), dtype=bool)
    for place in (start - point, end - point):
        along = place @ ahead
        across = np.abs(place[:, 0] * ahead[1] - place[:, 1] * ahead[0])
        reach = share * np.hypot(*place.T)
        off |= (across > reach) | (along > reach)
    return off
