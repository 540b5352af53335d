"""The body of patch tests, and the field of one strain on it."""

import numpy as np

from integration.polygons import Polygons
from integration.rules import polygon_rule
from nmm.assembly.errors import stresses
from nmm.formulation import Formulation
from nmm.materials.elastic import Elastic
from nmm.verification.base import Check, Checks, limit
from nmm.verification.continuum import (
    ContinuumCase,
    Exact,
    Problem,
)

HOLED = Polygons.from_rings(
    [
        [
            [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 0.6], [0.0, 1.0]],
            [[0.9, 0.2], [1.2, 0.2], [1.2, 0.4], [0.9, 0.4]],
        ]
    ]
)
LAW = Elastic(1000.0, 0.3)
STRAIN = np.array([1e-3, -2e-4, 5e-4])
STRESS = np.array([1.032967033, 0.1098901099, 0.1923076923])
ENERGY = 5.535714286e-4
PRINTED = "the reference is printed with ten digits"
ROUNDING = "rounding: the solution is in the space of the functions"


def uniform() -> Exact:
    """Return the field of one strain."""
    half = STRAIN[2] / 2
    gradient = np.array([[STRAIN[0], half], [half, STRAIN[1]]])
    return Exact(lambda x: np.asarray(x @ gradient), lambda x: np.tile(STRESS, (len(x), 1)))


class HoledPatch(ContinuumCase):
    """Body of patch tests: not convex, with a hole, in a mesh that follows none of its edges."""

    size = 0.31

    def body(self, formulation: Formulation) -> Problem:
        """Return the body, free."""
        from nmm.model.from_polygons import solid

        return Problem(solid(HOLED, formulation.cover, [LAW], "stress"))

    def compared(self, formulation: str, tolerance: float, reason: str) -> Checks:
        """Compare stresses in every element, energy and balance."""
        found = self.solved(formulation)
        manifold = found.model.manifold
        rule = polygon_rule(manifold.elements, 2)
        miss = np.abs(stresses(found.model, found.state.deformation, rule) - STRESS)
        mean = float(np.sqrt(rule.weights @ (miss**2).sum(axis=1) / rule.weights.sum()))
        area = float(found.model.element_area.sum())
        return {
            "largest error of stress (Pa)": limit(float(miss.max()), tolerance, reason),
            "mean error of stress (Pa)": limit(mean, tolerance, reason),
            "energy per area (J/m2)": Check(found.energy / area, ENERGY, tolerance, reason),
            "residual": limit(found.residual, 1e-10, "relative to the forces of all unknowns"),
        }
