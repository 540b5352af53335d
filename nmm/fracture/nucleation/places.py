"""Places at which cracks may nucleate: along the edges of bodies and inside, away from cracks."""

from dataclasses import dataclass

import numpy as np
import shapely

from covers.concatenate import some_of
from covers.cutting.cut_cells import CutCells
from integration.arrays import Bools, Floats, Ints
from integration.plane_vectors import counterclockwise
from nmm.geometry.geometry import Geometry

# Turn (rad) from which a vertex is a corner; those of polygons that stand for holes are smaller.
CORNER = 0.35


@dataclass(frozen=True)
class NucleationPlaces:
    """Middles and ends of boundary edges, and centroids of elements.

    Attributes
    ----------
    point
        (k, 2) in the reference configuration (m).
    inward
        (k, 2) normal of the edge into the material; zero inside.
    element
        (k,) element in which each lies.
    notched
        (k,) whether a re-entrant corner is near.
    """

    point: Floats
    inward: Floats
    element: Ints
    notched: Bools

    @classmethod
    def of(
        cls, cut: CutCells, geometry: Geometry, deep: float, away: float, beside: float
    ) -> "NucleationPlaces":
        """Return the places of a cut.

        Parameters
        ----------
        deep
            Least distance of places inside from the edges (m).
        away
            Least distance from cracks (m).
        beside
            Distance below which a re-entrant corner is near (m).
        """
        edges = cut.boundary
        along = edges.end - edges.start
        along /= np.hypot(*along.T)[:, None]
        normal = counterclockwise(along)
        bisector = normal + normal[edges.previous]
        middle = cut.elements.centroids
        free = np.flatnonzero(edges.crack < 0)
        inside = np.flatnonzero(~shapely.dwithin(shapely.points(middle), outline(cut), deep))
        point = [(edges.start + edges.end)[free] / 2, edges.start[free], middle[inside]]
        inward = [normal[free], bisector[free], np.zeros((len(inside), 2))]
        element = [edges.element[free], edges.element[free], inside]
        places = np.concatenate(point)
        turn = along[edges.previous, 0] * along[:, 1] - along[edges.previous, 1] * along[:, 0]
        corners = shapely.MultiPoint(edges.start[(edges.crack < 0) & (turn < -np.sin(CORNER))])
        notched = np.asarray(shapely.dwithin(shapely.points(places), corners, beside))
        found = cls(places, np.concatenate(inward), np.concatenate(element), notched)
        if not geometry.cracks:
            return found
        lines = shapely.MultiLineString([line.tolist() for line in geometry.cracks])
        near: Bools = np.asarray(shapely.dwithin(shapely.points(found.point), lines, away))
        return found.take(~near)

    def __len__(self) -> int:
        return len(self.point)

    def take(self, rows: Ints | Bools) -> "NucleationPlaces":
        """Return the selected places."""
        return some_of(self, rows)

    @property
    def inside(self) -> Bools:
        """Which (k,) lie inside, on no edge."""
        return np.asarray(~self.inward.any(axis=1))


def outline(cut: CutCells) -> shapely.MultiLineString:
    """Return all boundary edges of bodies, crack faces included."""
    ends = np.stack([cut.boundary.start, cut.boundary.end], axis=1)
    return shapely.MultiLineString(list(ends))
