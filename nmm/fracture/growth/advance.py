"""New segments of cracks, and where they end.

A segment goes straight from its tip by the growth length. One that would meet the boundary, a hole
or another crack, or end less than a quarter of that length short of it, ends on it. The front then
has no tip any more, and a part that is cut off becomes a body of its own.
"""

from collections.abc import Sequence

import numpy as np

from covers.cutting.cut_cells import CutCells
from integration.arrays import Floats, Ints
from nmm.fracture.free_length import LIGAMENT, free_length, tip_ahead
from nmm.fracture.growth.fronts import CrackFronts


def extended_lines(
    cut: CutCells,
    cracks: Sequence[Floats],
    fronts: CrackFronts,
    growing: Ints,
    tips: Ints,
    angle: Floats,
    length: float,
) -> tuple[Floats, ...]:
    """Return the polylines with new segments at some fronts.

    Parameters
    ----------
    growing, tips
        (k,) fronts that grow, and their tips in the cut.
    angle
        (k,) of each new segment from the direction ahead (rad).
    length
        Of each segment (m).
    """
    ends = new_ends(cut, fronts.points(cracks)[growing], tips, angle, length)
    return with_pieces(cracks, fronts, growing, ends)


def with_pieces(
    cracks: Sequence[Floats], fronts: CrackFronts, growing: Ints, ends: Floats
) -> tuple[Floats, ...]:
    """Return the polylines extended to ``ends`` (k, 2) at the fronts that grow (k,)."""
    grown = list(cracks)
    for front, last in zip(growing, ends, strict=True):  # a handful of fronts
        line = grown[fronts.crack[front]]
        if np.array_equal(last, line[-1 if fronts.last[front] else 0]):
            continue
        parts = [line, last[None]] if fronts.last[front] else [last[None], line]
        grown[fronts.crack[front]] = np.concatenate(parts)
    return tuple(grown)


def new_ends(cut: CutCells, begin: Floats, tips: Ints, angle: Floats, length: float) -> Floats:
    """Return the ends (k, 2) of new segments from tips; see `extended_lines`."""
    edges, ahead = cut.boundary, cut.tips.direction[tips]
    start, end, body = edges.start, edges.end, edges.body
    others, owner = cut.tips.point, cut.element_body[cut.tips.element]
    c, s = np.cos(angle), np.sin(angle)
    ways = np.stack([c * ahead[:, 0] - s * ahead[:, 1], s * ahead[:, 0] + c * ahead[:, 1]], axis=1)
    found: list[Floats] = []
    bodies = cut.element_body[cut.tips.element[tips]]
    for here, way, mine in zip(begin, ways, bodies, strict=True):  # a handful of fronts
        if any(np.array_equal(here, one) for one in found):
            found.append(here)  # a segment before has run into this tip
            continue
        near = body == mine
        free = free_length(here, way, start[near], end[near], length)
        met = tip_ahead(here, way, others[owner == mine], length)
        last = here + free * way
        if met is not None and np.hypot(*(met - here)) <= (1 + LIGAMENT) * free:
            last = met
        found.append(last)
        # The next segments may not cross this one.
        start, end = np.append(start, here[None], axis=0), np.append(end, last[None], axis=0)
        body, owner = np.append(body, mine), np.append(owner, mine)
        others = np.append(others, last[None], axis=0)
    return np.array(found).reshape(-1, 2)
