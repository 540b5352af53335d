"""Blocks that new pieces of cracks come to: a crack ends where its block meets another one."""

from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Bools, Floats, Ints

if TYPE_CHECKING:
    from nmm.effects.base import Setup

# Distance, as a share of a new piece, within which an end that was laid on an edge lies on it.
ON_EDGE = 1e-6


def blocks_met(setup: "Setup", tips: Ints, ends: Floats, length: float) -> tuple[str, ...]:
    """Return the names of other blocks on which new pieces end, in words; "" where on none.

    Parameters
    ----------
    tips
        (k,) tips of the cut from which the pieces go.
    ends
        (k, 2) their ends as drawn (m).
    length
        Of a piece (m).
    """
    cut, region = setup.model.cut, setup.model.manifold.element_region
    edges, mine = cut.boundary, region[cut.tips.element[tips]]
    said = []
    for end, own in zip(ends, mine, strict=True):  # a handful of fronts
        there = _on(end, edges.start, edges.end, ON_EDGE * length)
        others = np.unique(region[edges.element[there]])
        said.append(" and ".join(setup.region_name[one] for one in others if one != own))
    return tuple(said)


def _on(point: Floats, start: Floats, end: Floats, within: float) -> Bools:
    """Which segments (m,) from ``start`` to ``end`` (m, 2) come as near to a point (2,)."""
    way, to = end - start, point - start
    share = np.clip((to * way).sum(axis=1) / (way**2).sum(axis=1), 0.0, 1.0)
    return np.asarray(np.hypot(*(to - share[:, None] * way).T) <= within)
