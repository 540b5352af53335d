"""A smooth manufactured solution on a square turned in the mesh."""

import numpy as np

from integration.arrays import Floats
from nmm.formulation import Formulation
from nmm.materials.elastic import Elastic
from nmm.verification.base import Checks, order
from nmm.verification.continuum import (
    POSITIONS,
    ContinuumCase,
    Exact,
    Problem,
    degree,
    edge_support,
    errors_of,
    everywhere,
    fine,
    on_mesh,
    polygon,
)
from nmm.verification.series import Series

LAW = Elastic(1.0, 0.3)
TURNS = (0.0, 0.35, 0.7)
"""Angle of the square at each position of the mesh (rad)."""
SIZES = {
    0: (1 / 8, 1 / 16, 1 / 24, 1 / 32),
    1: (1 / 8, 1 / 12, 1 / 16, 1 / 24),
    2: (1 / 8, 1 / 12, 1 / 16, 1 / 24),
}
SQUARE = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])


def waves() -> Exact:
    """Return u = (sin pi x cos pi y, cos pi x sin pi y) with its stresses."""
    pi, d = np.pi, LAW.stiffness("strain")

    def u(p: Floats) -> Floats:
        x, y = pi * p.T
        return np.stack([np.sin(x) * np.cos(y), np.cos(x) * np.sin(y)], axis=1)

    def stress(p: Floats) -> Floats:
        x, y = pi * p.T
        normal = pi * np.cos(x) * np.cos(y)
        return np.stack([normal, normal, -2 * pi * np.sin(x) * np.sin(y)], axis=1) @ d

    return Exact(u, stress)


class Waves(ContinuumCase):
    """Errors of a smooth field fall by the degree plus one in energy, plus two in displacement.

    The square is turned and moved against the mesh in three ways, so all of its sides cut cells;
    what counts is the geometric mean of the three errors.
    """

    name = "A8 triangles"
    title = "Smooth manufactured solution on triangles, orders of convergence"
    source = (
        "u = (sin pi x cos pi y, cos pi x sin pi y), b = 2 pi^2 (lambda + 2 mu) u; polynomials of "
        "degree p times hats hold all of degree p + 1"
    )
    formulations = ("finite elements", "manifold")
    size = 1 / 8

    def problem(self, formulation: Formulation) -> Problem:
        """Return the square, turned with the mesh's position, held all around."""
        from nmm.model.from_polygons import solid
        from nmm.stepping.drive.linear_statics import body_force

        position = [angle for angle, _ in POSITIONS].index(formulation.cover.angle)
        c, s = np.cos(TURNS[position]), np.sin(TURNS[position])
        region = polygon(SQUARE @ np.array([[c, s], [-s, c]]))
        model = solid(region, formulation.cover, [LAW], "strain")
        d, field, gauss = LAW.stiffness("strain"), waves().displacement, fine(formulation)
        factor = (d[0, 1] + 2 * d[2, 2]) * 2 * np.pi**2
        return Problem(
            model,
            [edge_support(model, formulation, everywhere(model, gauss), field)],
            forces=[body_force(model, lambda p: factor * field(p), gauss)],
        )

    def checks(self, formulation: str) -> Checks:
        """Refine the covers three times at three positions."""
        power = degree(on_mesh(formulation, self.size))
        sizes = SIZES[power]
        logs = [
            np.mean([np.log(self.errors(formulation, size, n)) for n in range(len(TURNS))], axis=0)
            for size in sizes
        ]
        energy, displacement = np.exp(logs).T
        reason = (
            "scatter from position to position; more than theory is not an error: what the ghost "
            "term of Nitsche's supports adds along cut edges falls by half an order faster"
        )
        return {
            "order in energy": order(Series.of(sizes, energy, power + 1), 0.15, reason, True),
            "order in displacement": order(
                Series.of(sizes, displacement, power + 2), 0.15, reason, True
            ),
        }

    def errors(self, formulation: str, size: float, position: int) -> tuple[float, float]:
        """Relative errors in energy and displacement."""
        found = self.solved(formulation, size, position)
        errors = errors_of(found, waves(), fine(on_mesh(formulation, size)))
        return errors.energy, errors.displacement


class WavesOnQuads(Waves):
    """Errors of a smooth field on bilinear quadrilaterals, cut by a turned square."""

    name = "A8 quads"
    title = "Smooth manufactured solution on quads, orders of convergence"
    formulations = ("bilinear quads", "quads")
    slow = True


class WavesOfDegreeTwo(Waves):
    """Errors of a smooth field under quadratic covers, cut by a turned square."""

    name = "A8 quadratic"
    title = "Smooth manufactured solution, quadratic covers, orders of convergence"
    formulations = ("manifold degree 2", "quads degree 2")
    slow = True
