"""Blocks that new pieces of cracks come to: a crack ends where its block meets another one."""

from typing import TYPE_CHECKING

import numpy as np
import shapely

from integration.arrays import Floats, Ints

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
    lines = shapely.linestrings(np.stack([edges.start, edges.end], axis=1))
    said = []
    for end, own in zip(ends, mine, strict=True):  # a handful of fronts
        there = shapely.dwithin(shapely.points(end), lines, ON_EDGE * length)
        others = np.unique(region[edges.element[there]])
        said.append(" and ".join(setup.region_name[one] for one in others if one != own))
    return tuple(said)
