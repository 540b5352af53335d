"""Re-entrant corners of a boundary and at kinks of cracks: their angle and bisector."""

from dataclasses import dataclass

import numpy as np

from covers.cutting.boundary import BoundaryEdges
from integration.arrays import Floats
from nmm.errors import FormulationError

NEAR = 1e-9
# Angle (rad) above a straight line below which singular fields cannot be told from smooth ones.
FLAT = 1e-3
# Kinks of a crack of at least this angle (rad) are enriched with corner functions. Without them,
# a kink of 34 degrees loses some 1e-4 of the energy on 20 cells, one of 70 degrees 4e-3.
SHARP = 0.5


@dataclass(frozen=True)
class Corner:
    """A re-entrant corner of the material.

    Attributes
    ----------
    point, angle
        Its place (2,) (m), and the angle that the material fills (rad).
    direction, element
        Unit vector (2,) along the bisector, into the material, and the element at the corner.
    """

    point: Floats
    angle: float
    direction: Floats
    element: int


def corner_at(boundary: BoundaryEdges, point: Floats) -> Corner:
    """Return the corner of the largest angle of a boundary at a point.

    Raises
    ------
    FormulationError
        The point is no vertex of the boundary, or the corner is not re-entrant.
    """
    corners = _corners(boundary, point)
    if not corners:
        away = float(np.hypot(*(boundary.start - point).T).min())
        raise FormulationError(
            f"[cover.enrichment] corners: {point.tolist()}: {away:.3g} m away from the "
            "nearest vertex of the boundary: expected a corner of a block: correct the point"
        )
    widest = max(corners, key=lambda one: one.angle)
    if widest.angle <= np.pi + FLAT:
        raise FormulationError(
            f"[cover.enrichment] corners: {point.tolist()}: the material fills "
            f"{np.degrees(widest.angle):.6g} degrees there: expected a re-entrant corner of more "
            "than 180, where stresses are singular: take the point out"
        )
    return widest


def kinks(boundary: BoundaryEdges, line: Floats) -> list[Corner]:
    """Return the re-entrant corners at the sharp kinks of a crack along ``line`` (n, 2).

    On the outer side of a kink the material fills more than 180 degrees, and stresses are singular
    as in a notch.
    """
    way = np.diff(line, axis=0)
    turn = np.diff(np.unwrap(np.arctan2(way[:, 1], way[:, 0])))
    found = [_corners(boundary, point) for point in line[1:-1][np.abs(turn) >= SHARP]]
    widest = [max(some, key=lambda one: one.angle) for some in found if some]
    return [one for one in widest if one.angle > np.pi + FLAT]


def _corners(boundary: BoundaryEdges, point: Floats) -> list[Corner]:
    """Corners of a boundary at a point; material lies on the left of its edges."""
    size = float(np.hypot(*np.ptp(boundary.start, axis=0)))
    edge = np.flatnonzero(np.hypot(*(boundary.start - point).T) <= NEAR * size)
    before = boundary.previous[edge]
    out = boundary.end[edge] - boundary.start[edge]
    back = boundary.start[before] - boundary.end[before]
    first = np.arctan2(out[:, 1], out[:, 0])
    angle = np.mod(np.arctan2(back[:, 1], back[:, 0]) - first, 2 * np.pi)
    middle = first + angle / 2
    bisector = np.stack([np.cos(middle), np.sin(middle)], axis=1)
    return [
        Corner(point, float(a), d, int(element))
        for a, d, element in zip(angle, bisector, boundary.element[edge], strict=True)  # two sides
    ]
