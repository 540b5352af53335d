"""New segments of cohesive zones: polylines whose faces are bonded at first."""

from dataclasses import replace

import numpy as np

from covers.cutting.cut_cells import CutCells
from integration.arrays import Floats, Ints
from integration.plane_vectors import cross
from nmm.fracture.growth.advance import extended_lines
from nmm.fracture.growth.fronts import CrackFronts
from nmm.geometry.geometry import Geometry


def extended(
    geometry: Geometry,
    cut: CutCells,
    fronts: CrackFronts,
    growing: Ints,
    tips: Ints,
    ways: Floats,
    length: float,
) -> Geometry:
    """Return the geometry with new segments at some fronts.

    The first segment at the tip of an open crack is a polyline of its own. Later ones, and those
    of bonded cracks, extend their polyline.

    Parameters
    ----------
    growing, tips
        (k,) fronts that grow, and their tips in the cut.
    ways
        (k, 2) unit vectors along the planes in which they grow, of either sign.
    length
        Of each segment (m).
    """
    ahead = cut.tips.direction[tips]
    angle = _angle(ahead, ways)
    lines = extended_lines(cut, geometry.cracks, fronts, growing, tips, angle, length)
    cracks, bonded = list(geometry.cracks), list(geometry.bonded)
    for number in np.unique(fronts.crack[growing]):  # a handful of cracks
        if number in geometry.bonded:
            cracks[number] = lines[number]
    for front in growing:  # a handful of fronts
        number = fronts.crack[front]
        if number not in geometry.bonded:
            piece = lines[number][-2:] if fronts.last[front] else lines[number][1::-1]
            bonded.append(len(cracks))
            cracks.append(piece)
    return replace(geometry, cracks=tuple(cracks), bonded=tuple(bonded))


def with_nucleus(geometry: Geometry, line: Floats) -> Geometry:
    """Return the geometry with a new zone along a polyline (n, 2)."""
    bonded = (*geometry.bonded, len(geometry.cracks))
    return replace(geometry, cracks=(*geometry.cracks, line), bonded=bonded)


def _angle(ahead: Floats, ways: Floats) -> Floats:
    """Smallest angle (k,) from directions ahead (k, 2) to planes along ``ways`` (k, 2) (rad)."""
    along = np.einsum("ij,ij->i", ahead, ways)
    across = cross(ahead, ways)
    forward = np.where(along < 0, -1.0, 1.0)
    return np.asarray(np.arctan2(forward * across, forward * along))
