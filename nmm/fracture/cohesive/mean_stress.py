"""Non-local stress: the weighted mean about a tip or another place.

Stress near the end of a cohesive zone varies from cell to cell; its weighted mean does not (Wells
and Sluys 2001). The weights are Gaussian in the distance, times area, within one body, and zero
beyond a cut-off length.
"""

from dataclasses import dataclass

import numpy as np
import shapely
from scipy.sparse import csr_array, diags_array
from scipy.spatial import KDTree

from integration.arrays import Floats, Ints
from integration.rules import PointRule, polygon_rule
from nmm.assembly.errors import stresses
from nmm.assembly.model import Model

# Cut-off length over the standard deviation of the weights.
DEVIATIONS = 2.0
# Degree of the quadrature of stress times weight in an element.
STRESS_ORDER = 6


@dataclass(frozen=True)
class StressMeans:
    """Weighted means of stress about places.

    Attributes
    ----------
    model
        The model.
    rule
        Quadrature points of the stress.
    weights
        (k, Q) rows that sum to one; those of places without material about them are empty.
    """

    model: Model
    rule: PointRule
    weights: csr_array

    @classmethod
    def about(
        cls, model: Model, places: Floats, body: Ints, length: float, ahead: Floats | None = None
    ) -> "StressMeans":
        """Return the means about places.

        Parameters
        ----------
        places, body
            (k, 2) in the reference configuration (m), and the body (k,) of each.
        length
            Cut-off length (m).
        ahead
            (k, 2) directions, if only the material on their side counts.
        """
        rule = _points(model, places, length)
        near = KDTree(places).sparse_distance_matrix(
            KDTree(rule.points), length, output_type="coo_matrix"
        )
        row, point = near.row.astype(np.int64), near.col.astype(np.int64)
        weight = rule.weights[point] * np.exp(-((DEVIATIONS * near.data / length) ** 2) / 2)
        weight *= model.manifold.element_body[rule.owner[point]] == body[row]
        if ahead is not None:
            way = rule.points[point] - places[row]
            weight *= np.einsum("ij,ij->i", way, ahead[row]) > 0
        found = csr_array((weight, (row, point)), shape=(len(places), len(rule.points)))
        total: Floats = np.asarray(found.sum(axis=1))
        each = diags_array(1 / np.where(total > 0, total, 1.0))
        return cls(model, rule, csr_array(each @ found))

    def of(self, deformation: Floats) -> Floats:
        """Return the mean stresses (k, 3) of unknowns (n,) in body axes (Pa)."""
        if not len(self.rule.points):
            return np.zeros((self.weights.shape[0], 3))
        return np.asarray(self.weights @ stresses(self.model, deformation, self.rule))


def _points(model: Model, places: Floats, length: float) -> PointRule:
    """Quadrature points of the elements within a length of any place."""
    shapes = model.manifold.elements.to_shapely()
    tree = shapely.STRtree(shapes)
    found = tree.query(shapely.points(places), predicate="dwithin", distance=length)[1]
    near = np.unique(found)
    rule = polygon_rule(model.manifold.elements.take(near), STRESS_ORDER)
    return PointRule(rule.points, rule.weights, near[rule.owner])
