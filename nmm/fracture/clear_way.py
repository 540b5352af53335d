"""How far a new piece of a crack goes: to what it meets, or would end just short of."""

import numpy as np

from integration.arrays import Floats

# Part of the growth length up to which a ligament that would be left is cut through.
LIGAMENT = 0.25
# Segments that begin nearer to a tip than this part of the growth length are its own faces.
OWN = 1e-6


def clear_length(begin: Floats, way: Floats, start: Floats, end: Floats, length: float) -> float:
    """Length to the first segment (m, 2) on the way, or the whole where it is far beyond."""
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
