"""What lies about the tip of a crack: how far the material is alone with a straight crack."""

from dataclasses import dataclass

import numpy as np

from covers.cutting.cut_cells import CutCells
from integration.arrays import Bools, Floats

# Faces that lie off the line behind the tip by more than this part of their distance are bent: a
# degree, less than the pieces of a crack that is drawn as a curve.
BENT = 0.02


@dataclass(frozen=True)
class Obstacle:
    """The nearest thing that a domain about a tip must not hold.

    Attributes
    ----------
    distance
        From the tip (m); infinite where there is none.
    what
        In words.
    """

    distance: float
    what: str


def nearest_obstacle(cut: CutCells, tip: int) -> Obstacle:
    """Return the boundary, another tip, another crack or a kink, whichever is nearest to a tip."""
    point, ahead = cut.tips.point[tip], cut.tips.direction[tip]
    edges, body = cut.boundary, cut.element_body[cut.tips.element[tip]]
    mine = edges.body == body
    away = distances(point, edges.start, edges.end)
    others = np.delete(cut.tips.point, tip, axis=0)
    crack = mine & (edges.crack >= 0)
    found = [
        Obstacle(_least(away[mine & (edges.crack < 0)]), "the boundary or another block"),
        Obstacle(_least(np.hypot(*(others - point).T)), "another tip"),
        Obstacle(
            _least(away[crack & off_line(edges.start, edges.end, point, ahead)]),
            "a kink of the crack or another crack",
        ),
    ]
    return min(found, key=lambda item: item.distance)


def off_line(start: Floats, end: Floats, point: Floats, ahead: Floats) -> Bools:
    """Segments (n,) with an end that lies off the line behind a tip, or ahead of it."""
    off = np.zeros(len(start), dtype=bool)
    for place in (start - point, end - point):
        along = place @ ahead
        across = np.abs(place[:, 0] * ahead[1] - place[:, 1] * ahead[0])
        reach = BENT * np.hypot(*place.T)
        off |= (across > reach) | (along > reach)
    return off


def distances(point: Floats, start: Floats, end: Floats) -> Floats:
    """Distances (n,) of a point from segments (m)."""
    along = end - start
    share = np.sum((point - start) * along, axis=1) / np.maximum(np.sum(along**2, axis=1), 1e-300)
    nearest = start + np.clip(share, 0.0, 1.0)[:, None] * along
    return np.asarray(np.hypot(*(point - nearest).T))


def _least(values: Floats) -> float:
    return float(values.min(initial=np.inf))
