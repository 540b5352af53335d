"""Re-entrant corners of a boundary: their angle and bisector."""

from dataclasses import dataclass

import numpy as np

from covers.cutting.boundary import BoundaryEdges
from integration.arrays import Floats
from nmm.errors import FormulationError

NEAR = 1e-9
# Angle (rad) above a straight line below which singular fields cannot be told from smooth ones.
FLAT = 1e-3


@dataclass(frozen=True)
class Corner:
    """A corner: angle (rad) of the material, unit vector (2,) of its bisector, an element there."""

    angle: float
    direction: Floats
    element: int


def corner_at(boundary: BoundaryEdges, point: Floats) -> Corner:
    """Return the corner of a boundary at a point.

    Raises
    ------
    FormulationError
        No edge of the boundary starts there, or the corner is not re-entrant.
    """
    away = np.hypot(*(boundary.start - point).T)
    edge = int(np.argmin(away))
    if away[edge] > NEAR * float(np.hypot(*np.ptp(boundary.start, axis=0))):
        raise FormulationError(
            f"[cover.enrichment] corners: {point.tolist()}: {away[edge]:.3g} m away from the "
            "nearest vertex of the boundary: expected a corner of a block: correct the point"
        )
    out = boundary.end[edge] - boundary.start[edge]
    before = boundary.previous[edge]
    back = boundary.start[before] - boundary.end[before]
    first = float(np.arctan2(out[1], out[0]))
    angle = float(np.mod(np.arctan2(back[1], back[0]) - first, 2 * np.pi))
    if angle <= np.pi + FLAT:
        raise FormulationError(
            f"[cover.enrichment] corners: {point.tolist()}: the material fills "
            f"{np.degrees(angle):.6g} degrees there: expected a re-entrant corner of more than "
            "180, where stresses are singular: take the point out"
        )
    middle = first + angle / 2
    direction = np.array([np.cos(middle), np.sin(middle)])
    return Corner(angle, direction, int(boundary.element[edge]))
