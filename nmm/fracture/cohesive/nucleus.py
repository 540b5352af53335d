"""Where a zone begins away from all cracks: at the place whose mean stress reaches the strength."""

from dataclasses import dataclass

import numpy as np
import shapely

from integration.arrays import Floats, Ints
from nmm.assembly.model import Model
from nmm.fracture.cohesive.mean_stress import StressMeans
from nmm.fracture.principal import LargestPrincipal
from nmm.geometry.geometry import Geometry

# Distance from cracks below which nothing begins, in lengths of the mean.
CLEAR_OF_CRACKS = 3.0


@dataclass(frozen=True)
class ZoneNuclei:
    """Places at which zones may begin: middles of boundary edges and of elements, away from cracks.

    Attributes
    ----------
    place, edge
        (k, 2), and whether (k,) each lies on the boundary: the number of its edge, else -1.
    strength
        (k,) tensile strength there (Pa).
    means
        Of stress about them.
    """

    place: Floats
    edge: Ints
    strength: Floats
    means: StressMeans

    @classmethod
    def of(cls, model: Model, geometry: Geometry, strength: Floats, length: float) -> "ZoneNuclei":
        """Return the places of a model; ``strength`` (E,) of its elements, means over a length."""
        edges, elements = model.manifold.boundary, model.manifold.elements
        place = np.concatenate([(edges.start + edges.end) / 2, elements.centroids])
        element = np.append(edges.element, np.arange(len(elements)))
        edge = np.append(np.arange(len(edges)), np.full(len(elements), -1))
        kept = np.isfinite(strength[element])
        if geometry.cracks:
            lines = shapely.MultiLineString([line.tolist() for line in geometry.cracks])
            kept &= ~shapely.dwithin(shapely.points(place), lines, CLEAR_OF_CRACKS * length)
        place, edge, element = place[kept], edge[kept], element[kept]
        body = model.manifold.element_body[element]
        means = StressMeans.about(model, place, body, length)
        return cls(place, edge, strength[element], means)

    def begun(self, model: Model, deformation: Floats, length: float) -> Floats | None:
        """Return the polyline of the zone that begins first; None where no place calls for one.

        Parameters
        ----------
        deformation
            (n,) unknowns.
        length
            Of the zone (m): from the boundary inwards, inside with the place in its middle.
        """
        if not len(self.place):
            return None
        pulled = LargestPrincipal.of(self.means.of(deformation))
        share = pulled.size / self.strength
        first = int(np.argmax(share))
        if share[first] < 1:
            return None
        way, at = pulled.plane[first], self.place[first]
        if self.edge[first] < 0:
            return np.array([at - length / 2 * way, at + length / 2 * way])
        edges, edge = model.manifold.boundary, self.edge[first]
        along = edges.end[edge] - edges.start[edge]
        inward = np.sign(along[0] * way[1] - along[1] * way[0]) or 1.0
        return np.array([at, at + length * inward * way])
