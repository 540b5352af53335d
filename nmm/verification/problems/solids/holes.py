"""A plate with a hole under tension (Kirsch 1898)."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from integration.arrays import Floats
from nmm.assembly.places import on_edges
from nmm.formulation import Formulation
from nmm.materials.elastic import Elastic
from nmm.verification.base import Check, Checks, order
from nmm.verification.continuum import (
    ContinuumCase,
    Exact,
    Problem,
    degree,
    displacement_at,
    errors_of,
    load,
    middles,
    on_mesh,
    polygon,
    quarter,
    rollers,
    stress_at,
)
from nmm.verification.series import Series

LAW = Elastic(1000.0, 0.3)
SHEAR = LAW.young_modulus / 2 / (1 + LAW.poisson_ratio)
SEGMENTS = 256
"""Edges of the quarter of a circle; with exact tractions their number does not matter."""


def kirsch(plane: str) -> Exact:
    """Field about a hole of radius 1 under a unit tension along x."""
    k = LAW.kolosov(plane)

    def u(p: Floats) -> Floats:
        r, t = np.hypot(*p.T), np.arctan2(p[:, 1], p[:, 0])
        q = 1 / r
        x = r * (k + 1) * np.cos(t) + 2 * q * ((1 + k) * np.cos(t) + np.cos(3 * t))
        y = r * (k - 3) * np.sin(t) + 2 * q * ((1 - k) * np.sin(t) + np.sin(3 * t))
        far = 2 * q**3
        field = np.stack([x - far * np.cos(3 * t), y - far * np.sin(3 * t)], axis=1)
        return np.asarray(field / (8 * SHEAR))

    def stress(p: Floats) -> Floats:
        q, t = 1 / np.hypot(*p.T), np.arctan2(p[:, 1], p[:, 0])
        c2, c4, s2, s4 = np.cos(2 * t), np.cos(4 * t), np.sin(2 * t), np.sin(4 * t)
        xx = 1 - q**2 * (1.5 * c2 + c4) + 1.5 * q**4 * c4
        yy = -(q**2) * (0.5 * c2 - c4) - 1.5 * q**4 * c4
        return np.stack([xx, yy, -(q**2) * (0.5 * s2 + s4) + 1.5 * q**4 * s4], axis=1)

    return Exact(u, stress)


class HoledPlate(ContinuumCase):
    """A quarter of the plate, cut off at 4 radii, with the exact tractions there."""

    size = 0.25
    source = "Closed form of Kirsch with its own tractions on the edge"
    plane: str = "strain"

    def problem(self, formulation: Formulation) -> Problem:
        """Return the quarter with rollers on its axes of symmetry."""
        from nmm.model.from_polygons import solid

        region = polygon([*quarter(1.0, SEGMENTS), [4, 0], [4, 4], [0, 4]])
        model = solid(region, formulation.cover, [LAW], self.plane)
        x, y = middles(model).T
        rest = on_edges(model.manifold, (x > 1e-9) & (y > 1e-9), 12)
        return Problem(
            model,
            [rollers(model, formulation, x < 1e-9, 0), rollers(model, formulation, y < 1e-9, 1)],
            [load(model, rest, kirsch(self.plane).traction)],
        )


@dataclass(frozen=True)
class Hole(HoledPlate):
    """Energy, displacements at the hole and the threefold stress beside it."""

    name = "A5 values"
    title = "Plate with a hole"
    formulations = ("manifold", "manifold degree 2", "quads")
    plane: str = "strain"
    parameters: ClassVar = {"plane": ("strain", "stress")}
    label = "plane {0.plane}"

    def checks(self, formulation: str) -> Checks:
        found = self.solved(formulation)
        strain = self.plane == "strain"
        energy, pull, squeeze = (
            (7.693653726e-3, 2.73e-3, -9.1e-4) if strain else (8.444912711e-3, 3e-3, -1e-3)
        )
        linear = degree(on_mesh(formulation, self.size)) == 1
        point = "a point in one element of a quarter of the radius; "
        peak = point + ("aim 2 %, up to 3 % is measured with linear covers" if linear else "aim")
        side = point + "of the peak stress, 6 % is measured on quads"
        aim = "the benchmark's aim; measured 1e-4"
        moved = "1 % as the aim for displacements elsewhere; measured up to 0.7 %"
        return {
            "energy (J)": Check(found.energy, energy, 5e-3, aim),
            "ux at (1, 0) (m)": Check(displacement_at(found, [1, 0])[0], pull, 1e-2, moved),
            "uy at (0, 1) (m)": Check(displacement_at(found, [0, 1])[1], squeeze, 1e-2, moved),
            "sxx at (0, 1) (Pa)": Check(
                stress_at(found, [0, 1])[0], 3.0, 0.035 if linear else 0.02, peak
            ),
            "syy at (1, 0) (Pa)": Check(
                stress_at(found, [1, 0])[1], -1.0, 0.07 if linear else 0.02, side, scale=3.0
            ),
        }


@dataclass(frozen=True)
class HoleRates(HoledPlate):
    """Errors at a curved hole fall by the degree plus one in energy, plus two in displacement."""

    name = "A5 rates"
    title = "Plate with a hole, orders of convergence"
    formulations = ("finite elements", "manifold", "manifold degree 2")
    plane: str = "strain"
    slow = True

    def checks(self, formulation: str) -> Checks:
        """Refine the covers three times."""
        power = degree(on_mesh(formulation, self.size))
        sizes = (0.25, 0.18, 0.125, 0.09) if power == 0 else (0.4, 0.28, 0.2, 0.14)
        errors = [
            errors_of(self.solved(formulation, size), kirsch(self.plane), 2 * power + 8)
            for size in sizes
        ]
        reason = "a few covers a radius, and cut cells that scatter"
        energy = Series.of(sizes, [one.energy for one in errors], power + 1)
        displacement = Series.of(sizes, [one.displacement for one in errors], power + 2)
        return {
            "order in energy": order(energy, 0.2, reason),
            "order in displacement": order(displacement, 0.3, reason, at_least=True),
        }
