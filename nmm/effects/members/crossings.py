"""Crossings of straight bars from one body into another."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np
import shapely

from covers.approximation.manifold import Manifold
from integration.arrays import Floats, Ints

# Rounding of the gap between two bodies in contact, over the length of the bar.
TOUCHING = 1e-9


@dataclass(frozen=True)
class JointsCrossed:
    """Places at which bars pass from one body into another.

    Attributes
    ----------
    share
        (k,) place along the bar as a share of its length, increasing along each bar.
    before, after
        (k,) elements that the bar leaves and enters.
    """

    share: Floats
    before: Ints
    after: Ints

    @classmethod
    def of(cls, manifold: Manifold, first: Floats, last: Floats, gap: float) -> Self:
        """Return the crossings of a bar between two points (2,), over gaps up to ``gap`` (m)."""
        length = float(np.hypot(*(last - first)))
        begin, end, element = _stretches(manifold, first, last)
        body = manifold.element_body[element]
        apart = begin[1:] - end[:-1]
        passes = (body[1:] != body[:-1]) & (apart >= -TOUCHING) & (apart <= gap / length)
        at = np.flatnonzero(passes)
        return cls((end[at] + begin[at + 1]) / 2, element[at], element[at + 1])

    @classmethod
    def joined(cls, parts: "Sequence[JointsCrossed]") -> Self:
        """Return the crossings of several bars, one after the other."""
        share, before, after = (
            np.concatenate([getattr(one, name) for one in parts])
            for name in ("share", "before", "after")
        )
        return cls(share, before, after)


def _stretches(manifold: Manifold, first: Floats, last: Floats) -> tuple[Floats, Floats, Ints]:
    """Begin and end (k,) of the bar in each element, as shares of its length, and the elements."""
    line = shapely.LineString([first, last])
    outlines = manifold.elements.to_shapely()
    near = shapely.STRtree(outlines).query(line, predicate="intersects")
    inside, owner = shapely.get_parts(shapely.intersection(outlines[near], line), return_index=True)
    long = shapely.length(inside) > TOUCHING * line.length
    inside, element = inside[long], near[owner[long]]
    ends = [shapely.get_point(inside, which) for which in (0, -1)]
    shares = np.array([shapely.line_locate_point(line, one, normalized=True) for one in ends])
    begin, end = shares.min(axis=0), shares.max(axis=0)
    order = np.lexsort((element, begin))
    return begin[order], end[order], element[order]
