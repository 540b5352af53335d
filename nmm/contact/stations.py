"""Where joints act on bodies whose fields bend along an edge: at points of the material.

The search sees an edge as the chord between its ends (`nmm.contact.sides`). A joint that pushed on
the chord would load the two ends alone, and a field of degree 2 would bend under a uniform
traction. So the points of joints are followed with the material itself.
"""

from dataclasses import dataclass
from typing import Self

import numpy as np

from integration.arrays import Floats, Ints
from nmm.assembly.motion import Frames, MaterialPoints, material_points
from nmm.contact.points import ContactPoints
from nmm.contact.sides import Sides

# Rows of chord and material that differ by less than this share of the largest are the same.
ALIKE = 1e-12


@dataclass(frozen=True)
class Stations:
    """Both sides of all points of joints; the point with the key ``-1 - k`` is row ``k``.

    Attributes
    ----------
    a, b
        The two sides.
    unknowns, start, end, body
        Rows at the ends of all edges, then those of ``a`` and of ``b`` with both ends the same.
    """

    a: MaterialPoints
    b: MaterialPoints
    unknowns: Ints
    start: Floats
    end: Floats
    body: Ints

    @classmethod
    def of(cls, sides: Sides, points: ContactPoints) -> Self | None:
        """Return the stations of joints; None without joints or where fields are linear."""
        if not len(points):
            return None
        both = []
        bent = False
        for edge, parameter in (
            (points.edge_a, points.parameter_a),
            (points.edge_b, points.parameter_b),
        ):
            boundary, s = sides.manifold.boundary, parameter[:, None]
            place = boundary.start[edge] + s * (boundary.end[edge] - boundary.start[edge])
            found = material_points(sides.manifold, boundary.element[edge], place)
            chord = sides.at(edge, parameter).rows.values
            off = np.abs(found.rows.values - chord).max(initial=0.0)
            bent |= bool(off > ALIKE * np.abs(chord).max(initial=0.0))
            both.append(found)
        if not bent:
            return None
        a, b = both
        rows = [sides.start.rows, a.rows, b.rows]
        values = [part.values for part in rows]
        return cls(
            a,
            b,
            unknowns=np.concatenate([part.unknowns for part in rows]),
            start=np.concatenate(values),
            end=np.concatenate([sides.end.rows.values, *values[1:]]),
            body=np.concatenate([sides.start.body, a.body, b.body]),
        )

    def rows_of(self, contacts: ContactPoints) -> tuple[Ints, Ints]:
        """Rows (m,) of the tables above for both sides of contacts, joints or not."""
        first = len(self.body) - 2 * len(self.a.body)
        at_a = first - 1 - contacts.key
        joint = contacts.is_joint
        return (
            np.where(joint, at_a, contacts.edge_a),
            np.where(joint, at_a + len(self.a.body), contacts.edge_b),
        )

    def apart(self, points: ContactPoints, frames: Frames, deformation: Floats) -> Floats:
        """Where sides a of joints are from sides b (m, 2)."""
        k = -1 - points.key
        side_a, side_b = self.a.take(k), self.b.take(k)
        return np.asarray(side_a.place(frames, deformation) - side_b.place(frames, deformation))
