"""What springs store goes on in those beside them where contacts end: none is lost with a corner.

A corner that leaves the end of an edge, or that becomes one with another corner, takes its spring
with it. The springs that still push between the same two bodies are stretched by one factor, so
that together they hold the energy ``V = sum k min(g, 0)^2 / 2`` that all had before. No force acts
in this instant: momenta are what they were. Where none pushes any longer the energy is lost.
"""

from collections.abc import Callable

import numpy as np

from integration.arrays import Floats, Ints
from nmm.contact.points.contact_points import ContactPoints
from nmm.contact.points.continued.of_neighbours import matched
from nmm.frozen import with_parts


def kept_energy(
    new: ContactPoints,
    old: ContactPoints,
    stiffness: Callable[[ContactPoints], Floats],
    body: Ints,
) -> ContactPoints:
    """Return new points that hold what the old ones held between every two bodies.

    Gaps of both are counted from their references; ``body`` (E,) is of the boundary edges.
    """
    parts, pairs = (old, new), matched(old, new, body)
    count = 1 + int(max(pair.max(initial=0) for pair in pairs))
    held, left = (
        np.bincount(pair, stiffness(part) / 2 * np.minimum(part.gap, 0.0) ** 2, count)
        for part, pair in zip(parts, pairs, strict=True)
    )
    lost = (left > 0) & (left < held)
    factor = np.sqrt(np.divide(held, left, out=np.ones(count), where=lost))[pairs[1]]
    more = (factor - 1) * np.minimum(new.gap, 0.0)
    return with_parts(new, gap=new.gap + more, reference=new.reference - more)
