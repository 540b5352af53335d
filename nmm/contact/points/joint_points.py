"""Where joints act on bodies whose fields bend along an edge: at points of the material.

The search sees an edge as the chord between its ends (`nmm.contact.points.boundary_points`). A
joint that pushed on the chord would load the two ends alone, and a field of degree 2 would bend
under a uniform traction. So the points of joints are followed with the material itself.
"""

from dataclasses import dataclass
from typing import Any, Self

import numpy as np

from integration.arrays import Floats, Ints
from nmm.assembly.material_points import MaterialPoints, material_points
from nmm.assembly.state import Frames
from nmm.contact.detection.tolerances import SAME_ROWS
from nmm.contact.points.boundary_points import Sides
from nmm.contact.points.contact_points import ContactPoints
from nmm.contact.points.side_kernels import EdgeRows


@dataclass(frozen=True)
class JointSites:
    """Both sides of all points of joints; the point with the key ``-1 - k`` is row ``k``.

    Attributes
    ----------
    a, b
        The two sides.
    table
        Rows at the ends of all edges, then those of ``a`` and of ``b`` with both ends the same.
    whole
        Whether ``a`` and ``b`` are the sides of all contacts of a step, row by row, and the table
        holds nothing else.
    """

    a: MaterialPoints
    b: MaterialPoints
    table: EdgeRows
    whole: bool = False

    @classmethod
    def of(cls, sides: Sides, points: ContactPoints) -> Self | None:
        """Return the sites of joints; None without joints or where fields are linear."""
        if not len(points):
            return None
        both = []
        bent = False
        for edge, parameter in points.sides:
            found = _material(sides, edge, parameter)
            chord = sides.at(edge, parameter).rows.values
            # Discs reach other points than ends of edges: their fields bend.
            bent |= found.rows.values.shape != chord.shape or _differ(found.rows.values, chord)
            both.append(found)
        if not bent:
            return None
        a, b = both
        rows = [sides.start.rows, a.rows, b.rows]
        width = max(part.unknowns.shape[1] for part in (*rows, sides.end.rows))
        values = [padded(part.values, width) for part in rows]
        table = EdgeRows(
            np.concatenate([padded(part.unknowns, width) for part in rows]),
            np.concatenate(values),
            np.concatenate([padded(sides.end.rows.values, width), *values[1:]]),
            np.concatenate([sides.start.body, a.body, b.body]),
        )
        return cls(a, b, table)

    @classmethod
    def at(cls, sides: Sides, contacts: ContactPoints) -> Self:
        """Return the sites of all contacts of a step, joints or not."""
        a, b = (_material(sides, *side) for side in contacts.sides)
        width = max(a.rows.unknowns.shape[1], b.rows.unknowns.shape[1])
        unknowns = [padded(part.rows.unknowns, width) for part in (a, b)]
        values = np.concatenate([padded(part.rows.values, width) for part in (a, b)])
        body = np.concatenate([a.body, b.body])
        return cls(a, b, EdgeRows(np.concatenate(unknowns), values, values, body), whole=True)

    def rows_of(self, contacts: ContactPoints) -> tuple[Ints, Ints]:
        """Rows (m,) of the table for both sides of contacts, joints or not."""
        if self.whole:
            count = np.arange(len(contacts))
            return count, len(contacts) + count
        first = len(self.table.body) - 2 * len(self.a.body)
        at_a = first - 1 - contacts.key
        joint = contacts.is_joint
        return (
            np.where(joint, at_a, contacts.edge_a),
            np.where(joint, at_a + len(self.a.body), contacts.edge_b),
        )

    def apart(self, points: ContactPoints, frames: Frames, deformation: Floats) -> Floats:
        """Where sides a of joints are from sides b (m, 2)."""
        k = np.arange(len(points)) if self.whole else -1 - points.key
        side_a, side_b = self.a.take(k), self.b.take(k)
        return np.asarray(side_a.place(frames, deformation) - side_b.place(frames, deformation))


def _material(sides: Sides, edge: Ints, parameter: Floats) -> MaterialPoints:
    """Points of the material that lie at fractions of edges in the reference place."""
    boundary = sides.manifold.boundary
    return material_points(sides.manifold, boundary.element[edge], boundary.at(edge, parameter))


def _differ(values: Floats, others: Floats) -> bool:
    off = np.abs(values - others).max(initial=0.0)
    return bool(off > SAME_ROWS * np.abs(others).max(initial=0.0))


def padded(values: Any, width: int) -> Any:
    """Rows of elements with fewer functions, filled up with zeros."""
    more = width - values.shape[-1]
    return np.pad(values, [(0, 0)] * (values.ndim - 1) + [(0, more)]) if more else values
