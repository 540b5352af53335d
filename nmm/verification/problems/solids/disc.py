"""A disc between two forces."""

from typing import TYPE_CHECKING

import numpy as np
import shapely

from integration.arrays import Floats
from integration.rules import PointRule
from nmm.assembly.errors import stresses
from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase
from nmm.verification.formulations import with_cover

if TYPE_CHECKING:
    from nmm.formulation import Formulation
    from nmm.scene import Scene
    from nmm.stepping.run import Run


class BrazilianDisc(SceneCase):
    """A disc is pressed by two opposite forces: even tension across the line between them."""

    name = "C8"
    title = "Elastic stress on the load axis of the Brazilian test"
    source = "sx = 2 P / (pi D t), sy = -(2 P / (pi t)) (1 / (R - y) + 1 / (R + y) - 1 / D)"
    formulations = (
        "finite elements",
        "manifold",
        "manifold degree 2",
        "bilinear quads",
        "quads",
        "quads degree 2",
    )
    radius = 1.0
    force = 1.0
    corners = 144
    places = (0.0, 0.2, 0.4)

    def scene(self) -> str:
        """Return a polygon of 144 corners, loaded at two of them; the lower one is held."""
        angle = np.pi * (2 * np.arange(self.corners) / self.corners - 0.5)
        ring = self.radius * np.column_stack([np.cos(angle), np.sin(angle)])
        r = self.radius
        return text.scene(
            'title = "Brazilian disc"\nplane = "stress"\n',
            [
                text.material("rock", modulus=1000.0, poisson=0.2, density=None),
                text.block("disc", "rock", ring),
                text.fixed_point("foot", [0, -r]),
                text.fixed_point("top", [0, r], "x"),
                f'[[loads]]\nname = "press"\nkind = "point"\npoint = [0, {r}]\n'
                f"force = [0, {-self.force}]\n",
            ],
        )

    def formulation(self, scene: "Scene", name: str) -> "Formulation":
        """Return meshes with cells of a tenth of the radius, half as large without polynomials.

        They are turned, so that the axis is no line of theirs.
        """
        found = super().formulation(scene, name)
        size = 0.05 if found.cover.degree == 0 else 0.1
        return with_cover(found, size=size, angle=0.3, shift=(0.2, 0.3))

    def measure(self, run: "Run") -> Checks:
        r, d = self.radius, 2 * self.radius
        unit = 2 * self.force / np.pi
        reason = "cells of 0.1 m; of 0.05 m where stress is even or nearly so in each"
        checks = {}
        for y in self.places:
            stress = _stress(run, (0.0, y))
            across, along = unit / d, -unit * (1 / (r - y) + 1 / (r + y) - 1 / d)
            checks[f"sx at y = {y} (Pa)"] = Check(float(stress[0]), across, 0.02, reason)
            checks[f"sy at y = {y} (Pa)"] = Check(float(stress[1]), along, 0.02, reason)
        return checks


def _stress(run: "Run", place: tuple[float, float]) -> Floats:
    """Stress (3,) at a point, the mean of four points about it, 0.025 m away."""
    shift = 0.025 * np.array([(1, 0), (-1, 0), (0, 1), (0, -1)])
    points = np.array(place) + shift
    cells = shapely.STRtree(run.manifold.elements.to_shapely())
    point, element = cells.query(shapely.points(points), predicate="intersects")
    once = np.unique(point, return_index=True)[1]
    rule = PointRule(points[point[once]], np.full(len(once), 0.25), element[once])
    found = stresses(run.stepper.model, run.state.deformation, rule)
    return np.asarray(found.mean(axis=0))
