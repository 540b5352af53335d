"""Energy of contacts that end is handed to other springs between the same two bodies.

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
    at_most: bool = False,
) -> ContactPoints:
    """Return new points that hold what the old ones held between every two bodies, if they push.

    With ``at_most`` they hold no more: springs whose stiffness is one by area grow with the area,
    with no work that pays for it. What these hold of slip falls by the same factor. Gaps of both
    are counted from their references; ``body`` (E,) is of the boundary edges.
    """
    parts, pairs = (old, new), matched(old, new, body)
    count = 1 + int(max(pair.max(initial=0) for pair in pairs))
    energies = (stiffness(part) / 2 * np.minimum(part.gap, 0.0) ** 2 for part in parts)
    held, left = (
        np.bincount(pair, energy, count).astype(float)
        for pair, energy in zip(pairs, energies, strict=True)
    )
    wrong = left > held if at_most else (left > 0) & (left < held)
    factor = np.sqrt(np.divide(held, left, out=np.ones(count), where=wrong))
    return stretched(new, factor[pairs[1]], slip=at_most)


def stretched(points: ContactPoints, factor: Floats, slip: bool = False) -> ContactPoints:
    """Return points whose springs, those of ``slip`` too, are stretched by a factor (m,)."""
    more = (factor - 1) * np.minimum(points.gap, 0.0)
    slid = factor * points.slip if slip else points.slip
    return with_parts(points, gap=points.gap + more, reference=points.reference - more, slip=slid)
