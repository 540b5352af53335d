"""Pressures of materials that hardly change their volume."""

from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from integration.arrays import Floats
from integration.rules import polygon_rule
from nmm.assembly.errors import FieldErrors, field_errors
from nmm.formulation import Formulation
from nmm.materials.elastic import Elastic
from nmm.verification.base import Check, Checks, limit
from nmm.verification.continuum import (
    ContinuumCase,
    Problem,
    displacement_at,
    edge_support,
    everywhere,
    fine,
    on_mesh,
    polygon,
)
from nmm.verification.problems.solids.cylinders import RESIDUAL, Cylinder


class CylinderPressures(Cylinder):
    """Pressures in a thick cylinder that hardly changes its volume.

    Stresses do not depend on Poisson's ratio. With volumes projected on pressures of one degree
    less than the strains neither do their errors; volumes that are resisted in every point have
    pressures 60 % off with degree 1 at 0.4999.
    """

    name = "A6 pressures"
    title = "Thick cylinder, pressures near a Poisson ratio of 1/2"
    formulations = ("projected", "projected degree 2", "projected quads")
    parameters: ClassVar = {"poisson": (0.4999, 0.4999999), "position": (0, 1)}
    label = "nu = {0.poisson!r}, position {0.position}"

    def checks(self, formulation: str) -> Checks:
        found, nu = self.solved(formulation, self.size, self.position), self.poisson
        model, area = found.model, found.model.element_area
        widening = 4 / 3 * (1 + nu) * ((1 - 2 * nu) / 4 + 1)
        stress = model.mean_stress(found.state.deformation, found.pressure)
        rule = polygon_rule(model.manifold.elements, 6)
        parts = [np.bincount(rule.owner, rule.weights * part) for part in _lame(rule.points).T]
        exact = np.stack(parts, axis=1) / area[:, None]
        miss, mean = (one[:, :2].mean(axis=1) for one in (stress - exact, exact))
        pressure = float(np.sqrt(area @ miss**2 / (area @ mean**2)))
        whole = float(np.sqrt(area @ ((stress - exact) ** 2).sum(1) / (area @ (exact**2).sum(1))))
        rms = "mean stresses of elements, root of the mean square over the area"
        return {
            "ux at (1, 0) (m)": Check(displacement_at(found, [1, 0])[0], widening, 1e-2, "the aim"),
            "uy at (0, 1) (m)": Check(displacement_at(found, [0, 1])[1], widening, 1e-2, "the aim"),
            "error of the pressure": limit(pressure, 0.05, rms),
            "error of the stress": limit(whole, 0.05, rms),
            "residual": limit(found.residual, 1e-7, RESIDUAL),
        }


def _lame(points: Floats) -> Floats:
    """Stresses (m, 3) of the cylinder at points (m, 2)."""
    r, t = np.hypot(*points.T), np.arctan2(points[:, 1], points[:, 0])
    c, s, radial, hoop = np.cos(t), np.sin(t), (1 - 4 / r**2) / 3, (1 + 4 / r**2) / 3
    return np.stack(
        [radial * c**2 + hoop * s**2, radial * s**2 + hoop * c**2, (radial - hoop) * c * s], axis=1
    )


@dataclass(frozen=True)
class NoDivergence(ContinuumCase):
    """A field that keeps the volume, held all around, up to a Poisson ratio of nearly 1/2.

    The field and its stresses of shear are the same for every ratio; what locks or is held too
    stiffly shows as a growth of the errors from that of 0.3.
    """

    name = "A7"
    title = "Field without divergence, Poisson ratios of 0.3 and 0.4999999"
    source = "u = (sin pi x cos pi y, -cos pi x sin pi y), b = 2 pi^2 mu u, E = 1"
    formulations = ("projected", "projected degree 2", "projected quads")
    size = 1 / 8
    poisson: float = 0.4999999

    def problem(self, formulation: Formulation) -> Problem:
        """Return the unit square, held all around."""
        from nmm.model.from_polygons import solid
        from nmm.stepping.drive.linear_statics import body_force

        region = polygon([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
        law = Elastic(1.0, self.poisson)
        model = solid(region, formulation.cover, [law], "strain")
        factor, gauss = 2 * np.pi**2 * law.stiffness("strain")[2, 2], fine(formulation)
        held = edge_support(model, formulation, everywhere(model, gauss), _swirl)
        force = body_force(model, lambda p: factor * _swirl(p), gauss)
        return Problem(model, [held], forces=[force])

    def checks(self, formulation: str) -> Checks:
        near, far = self.errors(formulation), replace(self, poisson=0.3).errors(formulation)
        why = "errors at 0.4999999 over those at 0.3; 168 and more where penalties lock"
        return {
            "growth of the error of strains": limit(near.energy / far.energy, 2.0, why),
            "growth of the error of displacements": limit(
                near.displacement / far.displacement, 2.0, why
            ),
        }

    def errors(self, formulation: str) -> FieldErrors:
        """Relative errors of strains, weighted as by a material without lateral strain."""
        found = self.solved(formulation)
        law = np.broadcast_to(Elastic(1.0, 0.0).stiffness("strain"), found.model.elasticity.shape)
        soft = replace(found.model, elasticity=law)
        order = fine(on_mesh(formulation, self.size))
        return field_errors(soft, found.state.deformation, _swirl, _shear, order)


def _swirl(points: Floats) -> Floats:
    x, y = np.pi * points.T
    return np.stack([np.sin(x) * np.cos(y), -np.cos(x) * np.sin(y)], axis=1)


def _shear(points: Floats) -> Floats:
    """Strains (m, 3) of the field."""
    x, y = np.pi * points.T
    along = np.pi * np.cos(x) * np.cos(y)
    return np.stack([along, -along, 0 * along], axis=1)
