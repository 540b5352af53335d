"""Nucleation of cohesive zones away from cracks, where the mean stress reaches the strength."""

from dataclasses import dataclass

import numpy as np
import shapely

from integration.arrays import Floats, Ints
from nmm.assembly.model import Model
from nmm.fracture.cohesive.mean_stress import StressMeans
from nmm.geometry.geometry import Geometry
from nmm.materials.principal_stresses import PrincipalStresses

# Distance from cracks below which no zone nucleates, in lengths of the mean.
CLEAR_OF_CRACKS = 3.0


@dataclass(frozen=True)
class ZoneNuclei:
    """Candidate places: middles of boundary edges and centroids of elements, away from cracks.

    Attributes
    ----------
    place, edge
        (k, 2) places (m), and the number (k,) of the boundary edge of each; -1 inside.
    strength
        (k,) tensile strength there (Pa).
    means
        Mean stress about them.
    """

    place: Floats
    edge: Ints
    strength: Floats
    means: StressMeans

    @classmethod
    def of(cls, model: Model, geometry: Geometry, strength: Floats, length: float) -> "ZoneNuclei":
        """Return the places of a model.

        Parameters
        ----------
        strength
            (E,) of the elements (Pa).
        length
            Cut-off length of the means (m).
        """
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
        """Return the polyline of the zone that nucleates first; None below the strength.

        Parameters
        ----------
        deformation
            (n,) unknowns.
        length
            Of the zone (m): from the boundary inwards; a place inside is its middle.
        """
        if not len(self.place):
            return None
        principal = PrincipalStresses.of(self.means.of(deformation))
        share = principal.larger / self.strength
        first = int(np.argmax(share))
        if share[first] < 1:
            return None
        way, at = principal.plane[first], self.place[first]
        if self.edge[first] < 0:
            return np.array([at - length / 2 * way, at + length / 2 * way])
        edges, edge = model.manifold.boundary, self.edge[first]
        along = edges.end[edge] - edges.start[edge]
        inward = np.sign(along[0] * way[1] - along[1] * way[0]) or 1.0
        return np.array([at, at + length * inward * way])
