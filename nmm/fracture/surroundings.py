"""The surroundings of a crack tip: other tips, and the faces that are not straight behind it."""

import numpy as np

from covers.cutting.components import components, unique_rows
from covers.cutting.cut_cells import CutCells
from integration.arrays import Bools, Floats

# Faces off the line behind the tip by more than this share of their distance count as bent.
BENT = 0.02
# Largest radius of a domain as a share of the distance to the far end of its crack.
OPEN = 0.95


def farthest_face(cut: CutCells, tip: int) -> float:
    """Return the distance (m) from a tip to the far end of its crack, with all that joins it.

    About a domain that contained all of it no angle about the tip would be continuous.
    """
    edges = cut.boundary
    vertex = unique_rows(np.concatenate([edges.start, edges.end]))[1]
    start, end = vertex.reshape(2, -1)
    part = components(int(vertex.max(initial=-1)) + 1, start, end)
    away = np.hypot(*(edges.start - cut.tips.point[tip]).T)
    return float(away[part[start] == part[start[away.argmin()]]].max())


def domain_radius(cut: CutCells, tip: int, wanted: float) -> float:
    """Return the radius of the domain about a tip (m): at most as ``wanted``, within its crack.

    It stays clear of the boundary and of other cracks as long as that leaves half of ``wanted``.
    """
    edges, point = cut.boundary, cut.tips.point[tip]
    bent = off_line(edges.start, edges.end, point, cut.tips.direction[tip], BENT)
    others = (edges.body == cut.element_body[cut.tips.element[tip]]) & bent
    others &= edges.crack != cut.tips.crack[tip]
    nearest = nearest_points(point, edges.start[others], edges.end[others])
    clear = float(np.hypot(*(nearest - point).T).min(initial=np.inf))
    return min(max(min(wanted, clear), wanted / 2), OPEN * farthest_face(cut, tip))


def nearest_points(point: Floats, start: Floats, end: Floats) -> Floats:
    """Points (n, 2) nearest to a point (2,) on segments from ``start`` to ``end`` (n, 2) (m)."""
    along = end - start
    share = np.sum((point - start) * along, axis=1) / np.maximum(np.sum(along**2, axis=1), 1e-300)
    return np.asarray(start + np.clip(share, 0.0, 1.0)[:, None] * along)


def off_line(start: Floats, end: Floats, point: Floats, ahead: Floats, share: float) -> Bools:
    """Segments (n,) with an end that lies off the line behind a tip (2,), or their own tips (n, 2).

    Off is what lies aside by more than a ``share`` of its distance, or ahead of it.
    """
    off = np.zeros(len(start), dtype=bool)
    for place in (start - point, end - point):
        along = (place * ahead).sum(axis=1)
        across = np.abs(place[:, 0] * ahead[..., 1] - place[:, 1] * ahead[..., 0])
        reach = share * np.hypot(*place.T)
        off |= (across > reach) | (along > reach)
    return off
