"""The length of a new crack segment: up to the boundary that it meets or would nearly reach."""

import numpy as np

from integration.arrays import Floats

# Ligaments shorter than this share of the growth length are cut through.
LIGAMENT = 0.25
# Edges that begin nearer to the tip than this share of the growth length are the crack's own faces.
OWN = 1e-6
# A segment that would pass a tip ahead by less than this share of its distance runs into it.
HEAD_ON = 0.1


def free_length(begin: Floats, way: Floats, start: Floats, end: Floats, length: float) -> float:
    """Return the length (m) of a segment from ``begin`` (2,) in the unit direction ``way`` (2,).

    It ends on the first of the edges from ``start`` to ``end`` (m, 2) that it crosses within
    ``length`` and a ligament; where there is none, it has the whole ``length`` (m).
    """
    one, two = start - begin, end - begin
    own = np.minimum(np.hypot(*one.T), np.hypot(*two.T)) < OWN * length
    one, two = one[~own], two[~own]
    side_one = way[0] * one[:, 1] - way[1] * one[:, 0]
    side_two = way[0] * two[:, 1] - way[1] * two[:, 0]
    crossed = side_one * side_two <= 0
    with np.errstate(divide="ignore", invalid="ignore"):
        share = side_one / (side_one - side_two)
        along = (one + share[:, None] * (two - one)) @ way
    hits = along[crossed & np.isfinite(along) & (along > OWN * length)]
    first = float(hits.min(initial=np.inf))
    return first if first <= (1 + LIGAMENT) * length else length


def tip_ahead(begin: Floats, way: Floats, tips: Floats, length: float) -> Floats | None:
    """Return the first of ``tips`` (m, 2) that a segment as in `free_length` runs into; or None.

    Two cracks on one line meet so: neither crosses a face of the other.
    """
    away = tips - begin
    along, aside = away @ way, np.abs(way[0] * away[:, 1] - way[1] * away[:, 0])
    near = (along > OWN * length) & (along <= (1 + LIGAMENT) * length) & (aside <= HEAD_ON * along)
    return tips[near][along[near].argmin()] if near.any() else None
