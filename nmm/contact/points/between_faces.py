"""The line between the two faces of a contact: gaps are counted across it, slips along it.

A corner before an edge has the line of that edge. The two faces of a joint count alike: their line
is the mean of both,

    t = (t_b / l_b - t_a / l_a) / 2,

with the vectors ``t_a``, ``t_b`` along the edges, which run against each other, and their lengths
``l`` where the bodies were laid. It bisects the faces whichever of them is listed first, and it is
linear in places, so that what is kept on one edge is kept on it too (`conserving_rows`).
"""

from dataclasses import dataclass

import numpy as np

from integration.arrays import Bools, Floats
from integration.plane_vectors import clockwise
from nmm.contact.detection.surface import Surface
from nmm.contact.points.contact_points import ContactPoints
from nmm.contact.points.continued.tracking import Apart


@dataclass(frozen=True)
class EdgeShares:
    """What the edges of contacts add to the lines between their faces.

    Attributes
    ----------
    a, b
        (m, 1) factors of the vectors along the edges of both sides (1/m).
    """

    a: Floats
    b: Floats

    @classmethod
    def of(cls, points: ContactPoints, length: Floats, alike: Bools | None = None) -> "EdgeShares":
        """Return those of points; ``length`` (n,) of the edges where bodies were laid (m).

        Lines are the mean of both edges where faces are ``alike`` (m, 1); None: in joints.
        """
        both = points.is_joint[:, None] if alike is None else alike
        a = np.where(both, -0.5, 0.0) / length[points.edge_a, None]
        b = np.where(both, 0.5, 1.0) / length[points.edge_b, None]
        return cls(a, b)

    def along(self, points: ContactPoints, surface: Surface) -> Floats:
        """Vectors (m, 2) along the lines."""
        way = surface.end - surface.start
        return np.asarray(self.b * way[points.edge_b] + self.a * way[points.edge_a])


@dataclass(frozen=True)
class JointFaces:
    """Faces of joints where they are now.

    Attributes
    ----------
    surface
        The edges.
    length
        (n,) of the edges where bodies were laid (m).
    apart
        From points to where their sides a are from their sides b (m, 2).
    """

    surface: Surface
    length: Floats
    apart: Apart

    def normal(self, points: ContactPoints) -> Floats:
        """Unit normals (m, 2) of the lines between faces, from b to a."""
        return across(EdgeShares.of(points, self.length).along(points, self.surface))


def across(along: Floats) -> Floats:
    """Unit normals (m, 2) of vectors along lines between faces, from b to a."""
    return clockwise(along / np.hypot(*along.T)[:, None])
