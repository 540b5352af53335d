"""Holes beside crack tips that cells are too coarse for."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Floats, Ints
from integration.polygons import Polygons

if TYPE_CHECKING:
    from nmm.effects.base import Setup

# Cells across a hole from which on intensities beside it are right to 1 %; with two 4 %, with one
# up to 33 % off.
ACROSS = 2.5
# Diameters between a tip and the middle of a hole up to which it matters: without the hole a tip
# of a line through it is off by 11, 3.7, 1.0 and 0.3 % at 1, 1.5, 2 and 3 diameters.
BESIDE_HOLE = 2.5


def small_holes(setup: "Setup", tips: Ints, growth: float) -> str:
    """Return a warning about holes that tips come near to, in words; empty where there is none.

    Parameters
    ----------
    tips
        (k,) tips in the cut.
    growth
        How far each may grow (m).
    """
    cut, points = setup.model.cut, setup.model.cut.tips.point[tips]
    said = []
    for middle, across in _holes(setup.geometry.regions.polygons):  # those of the scene
        away = np.hypot(*(cut.boundary.start - middle).T)
        rim = cut.boundary.element[(away <= 0.51 * across) & (cut.boundary.crack < 0)]
        width = float(cut.cell_width[cut.element_cell[rim]].max(initial=0.0))
        near = (np.hypot(*(points - middle).T) < growth + BESIDE_HOLE * across).any()
        if near and across < ACROSS * width:
            x, y = middle + setup.origin
            said.append(
                f"a hole of {across:.3g} m about [{x:.4g}, {y:.4g}] lies in cells of {width:.3g} "
                "m: intensities of tips within two of its diameters are up to a third off; take "
                f'cells of {across / ACROSS:.2g} m, or type = "graded" with foci at it and the tip'
            )
    return "; ".join(said)


def _holes(polygons: Polygons) -> Iterator[tuple[Floats, float]]:
    """Yield the middle (2,) and the larger extent of every hole (m)."""
    first = set(polygons.polygon_offsets[:-1].tolist())
    pairs = zip(polygons.ring_offsets[:-1], polygons.ring_offsets[1:], strict=True)
    for ring, (start, stop) in enumerate(pairs):
        if ring not in first:
            low, high = (f(polygons.points[start:stop], axis=0) for f in (np.min, np.max))
            yield (low + high) / 2, float((high - low).max())
