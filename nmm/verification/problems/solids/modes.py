"""Free vibration of a square."""

import numpy as np

from nmm.formulation import Formulation
from nmm.materials.elastic import Elastic
from nmm.verification.base import Check, Checks, limit
from nmm.verification.continuum import ContinuumCase, Problem, on_mesh, polygon

LAME = 2.755359030


class FreeSquare(ContinuumCase):
    """A free square has three motions without frequency, and the mode of Lamé is among the next.

    In that mode the square keeps its area and shears along its diagonals; its frequency has a
    closed form, pi sqrt(2 mu / rho).
    """

    name = "A14"
    title = "Modes of a free square"
    source = "Lamé's mode: omega = pi sqrt(2 mu / rho)"
    formulations = ("manifold", "manifold degree 2", "quads")
    size = 0.2

    def problem(self, formulation: Formulation) -> Problem:
        """Return the unit square of E = 1, nu = 0.3, density 1."""
        from nmm.model.from_polygons import solid

        square = polygon([[0, 0], [1, 0], [1, 1], [0, 1]])
        law = Elastic(1.0, 0.3)
        return Problem(solid(square, formulation.cover, [law], "stress", density=[1.0]))

    def checks(self, formulation: str) -> Checks:
        from nmm.verification.free_modes import lowest_modes

        model = self.problem(on_mesh(formulation, self.size)).model
        modes = lowest_modes(model, 9)
        mass = modes.shape.T @ (model.mass @ modes.shape)
        near = modes.frequency[np.abs(modes.frequency - LAME).argmin()]
        tolerance = 1e-4 if formulation == "manifold degree 2" else 1e-3
        return {
            "largest rigid frequency (rad/s)": limit(
                float(modes.frequency[:3].max()), 1e-3, "root of a shift of 1e-10"
            ),
            "lowest elastic frequency (rad/s)": Check(
                float(modes.frequency[3]), 2.0, 0.0, "above the rigid ones", bound="at_least"
            ),
            "frequency of Lamé's mode (rad/s)": Check(
                float(near), LAME, tolerance, "measured 2.5e-4 and 1.2e-5"
            ),
            "error of orthonormality": limit(
                float(np.abs(mass - np.eye(9)).max()), 1e-9, "rounding of the iteration"
            ),
        }


class InertiaOfCovers(ContinuumCase):
    """Mass and inertia of a body from the mass matrix, on covers that its outline cuts."""

    name = "IN4"
    title = "Mass and inertia of a body that covers overlap"
    source = "rho A, rho (Ixx + Iyy) of the polygon; a triangle of 3 by 2 m"
    formulations = ("manifold", "manifold degree 2", "quads", "splines")
    size = 0.37

    def problem(self, formulation: Formulation) -> Problem:
        """Return a triangle of density 2."""
        from nmm.model.from_polygons import solid

        triangle = polygon([[0.03, 0.02], [3.03, 0.02], [0.03, 2.02]])
        law = Elastic(1.0, 0.3)
        return Problem(solid(triangle, formulation.cover, [law], "stress", density=[2.0]))

    def checks(self, formulation: str) -> Checks:
        model = self.problem(on_mesh(formulation, self.size)).model
        rigid = model.manifold.rigid_modes.toarray()
        found = rigid.T @ (model.mass @ rigid)
        area, (a, b) = 3.0, (3.0, 2.0)
        # Of a right triangle about its centroid: a b (a^2 + b^2) / 36.
        inertia = 2.0 * a * b * (a**2 + b**2) / 36
        rounding = "exact integrals"
        return {
            "mass along x (kg)": Check(float(found[0, 0]), 2 * area, 1e-12, rounding),
            "mass along y (kg)": Check(float(found[1, 1]), 2 * area, 1e-12, rounding),
            "inertia (kg m2)": Check(float(found[2, 2]), inertia, 1e-11, rounding),
        }
