"""Where straight bars pass from one body into another."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np
import shapely

from covers.approximation.manifold import Manifold
from integration.arrays import Floats, Ints

# Of a bar's length: what rounding leaves between two bodies that touch.
TOUCHING = 1e-9


@dataclass(frozen=True)
class JointsCrossed:
    """Places of bars between two bodies.

    Attributes
    ----------
    share
        (k,) of a bar's length, rising along each.
    before, after
        (k,) elements that the bar leaves and enters there.
    """

    share: Floats
    before: Ints
    after: Ints

    @classmethod
    def of(cls, manifold: Manifold, first: Floats, last: Floats, gap: float) -> Self:
        """Return those of a bar from ``first`` to ``last`` (2,), over gaps of up to ``gap`` (m)."""
        length = float(np.hypot(*(last - first)))
        begin, end, element = _stretches(manifold, first, last)
        body = manifold.element_body[element]
        apart = begin[1:] - end[:-1]
        passes = (body[1:] != body[:-1]) & (apart >= -TOUCHING) & (apart <= gap / length)
        at = np.flatnonzero(passes)
        return cls((end[at] + begin[at + 1]) / 2, element[at], element[at + 1])

    @classmethod
    def joined(cls, parts: "Sequence[JointsCrossed]") -> Self:
        """Return those of all bars, one after the other."""
        share, before, after = (
            np.concatenate([getattr(one, name) for one in parts])
            for name in ("share", "before", "after")
        )
        return cls(share, before, after)


def _stretches(manifold: Manifold, first: Floats, last: Floats) -> tuple[Floats, Floats, Ints]:
    """Begin and end (k,) of the bar in each element, as shares of its length; and the elements."""
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
