"""What lies about the tip of a crack: other tips, and faces off the line behind it."""

import numpy as np

from covers.cutting.cut_cells import CutCells
from integration.arrays import Bools, Floats

# Faces off the line behind the tip by more than this part of their distance are bent.
BENT = 0.02
# Part of the distance of another tip that a domain may fill.
ALONE = 0.95


def nearest_tip(cut: CutCells, tip: int) -> float:
    """Return the distance of the nearest other tip (m); infinite without one."""
    others = np.delete(cut.tips.point, tip, axis=0)
    return float(np.hypot(*(others - cut.tips.point[tip]).T).min(initial=np.inf))


def domain_radius(cut: CutCells, tip: int, wanted: float) -> float:
    """Return the radius of a domain about a tip: as wanted, but short of other tips (m).

    It keeps clear of the boundary and of other cracks as long as half of what is wanted is left.
    """
    edges, point = cut.boundary, cut.tips.point[tip]
    bent = off_line(edges.start, edges.end, point, cut.tips.direction[tip], BENT)
    others = (edges.body == cut.element_body[cut.tips.element[tip]]) & bent
    others &= edges.crack != cut.tips.crack[tip]
    gap = _distances(point, edges.start[others], edges.end[others])
    clear = float(gap.min(initial=np.inf))
    return min(max(min(wanted, clear), wanted / 2), ALONE * nearest_tip(cut, tip))


def _distances(point: Floats, start: Floats, end: Floats) -> Floats:
    """Distances (n,) of a point from segments (m)."""
    along = end - start
    share = np.sum((point - start) * along, axis=1) / np.maximum(np.sum(along**2, axis=1), 1e-300)
    nearest = start + np.clip(share, 0.0, 1.0)[:, None] * along
    return np.asarray(np.hypot(*(point - nearest).T))


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
