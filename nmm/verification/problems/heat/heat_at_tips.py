"""Heat that goes round the ends of cracks which insulate."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from covers.scalar.space import ScalarSpace
from integration.arrays import Floats
from integration.rules import polygon_rule
from nmm.assembly.places import on_edges
from nmm.diffusion.holding import prescribed
from nmm.diffusion.joints import crack_faces
from nmm.diffusion.matrices import slopes
from nmm.diffusion.problem import DiffusionProblem, field_solver
from nmm.formulation import Solver
from nmm.materials.elastic import Elastic
from nmm.scene.methods.cover_tables import EnrichmentTable
from nmm.verification import text
from nmm.verification.base import Case, Check, Checks, SceneCase, order
from nmm.verification.continuum import polygon
from nmm.verification.formulations import chosen, with_cover
from nmm.verification.problems.heat.heat_flow import edge
from nmm.verification.problems.heat.heat_strain import warm
from nmm.verification.series import Series

if TYPE_CHECKING:
    from nmm.formulation import Formulation
    from nmm.scene import Scene
    from nmm.stepping.run import Run

SIZES = (0.4, 0.2, 0.1)


@dataclass(frozen=True)
class HeatAtTip(Case):
    """Temperatures about the end of a crack: no heat crosses it, and all goes round its end."""

    name = "TH9"
    title = "Temperature at the tip of a crack that insulates"
    source = "T = Im (z^(1/2) + z^(3/2) / 2) + Re z^2: no flow through the faces"
    formulations = ("manifold",)
    angle: float = 0.0
    parameters: ClassVar = {"angle": (0.0, 0.5)}
    label = "turned by {0.angle:g}"

    def checks(self, formulation: str) -> Checks:
        """Solve in cells of three sizes, with singular functions in a third of the square."""
        found = [self._error(formulation, size) for size in SIZES]
        series = Series.of(SIZES, found, theory=2.5)
        why = "slope over cuts of unlike shapes; z^(3/2) beyond the singular functions"
        plain = self._error(formulation, SIZES[-1], tips=False)
        return {
            "order in the mean square": order(series, 0.3, why, at_least=True),
            "error over that of no singular functions": Check(
                found[-1] / plain, 0.0, 0.05, "a twentieth at most", scale=1.0
            ),
        }

    def _error(self, formulation: str, size: float, tips: bool = True) -> float:
        """Error in the mean square."""
        from nmm.model.from_polygons import solid

        square, crack = (
            text.turned(np.array(points), self.angle)
            for points in (text.rectangle((-1, -1), (1, 1)), [[-1.5, 0.0], [0.0, 0.0]])
        )
        enrichment = EnrichmentTable(radius=0.6 if tips else 0.0, tips=tips)
        keys = {"size": size, "enrichment": enrichment}
        cover = chosen(formulation).cover.model_copy(update=keys)
        model = solid(polygon(square), cover, [Elastic(1.0, 0.2)], "stress", cracks=[crack])
        manifold, alike = model.manifold, np.tile(np.eye(2), (len(model.density), 1, 1))
        space = ScalarSpace.of(manifold)
        place = on_edges(manifold, ~crack_faces(model), 10)
        edges = prescribed(space, model, alike, place, self._exact(place.position), "rim")
        solver = field_solver(manifold, Solver())
        problem = DiffusionProblem(space, slopes(space, alike), None, [edges], [], [], solver)
        rule = polygon_rule(manifold.elements, 12)
        off = space.values(rule.owner, rule.points) @ problem.steady(0.0)
        return float(np.sqrt(rule.weights @ (off - self._exact(rule.points)) ** 2))

    def _exact(self, points: Floats) -> Floats:
        z = (points[:, 0] + 1j * points[:, 1]) * np.exp(-1j * self.angle)
        return np.asarray(np.imag(z**0.5 + z**1.5 / 2) + np.real(z**2))


@dataclass(frozen=True)
class HeatAroundSlit(SceneCase):
    """A wall with a slit that insulates: heat has a longer way, round both of its ends."""

    name = "TH9 slit"
    title = "Heat through a wall with a slit"
    source = "A row of slits lengthens the way by (2 W / pi) ln sec(pi a / W)"
    formulations = ("manifold",)
    angle: float = 0.0
    parameters: ClassVar = {"angle": (0.0, 0.3)}
    label = "cover at {0.angle:g}"

    def scene(self) -> str:
        """Return a wall of 2 m by 0.5 m, 40 K over it, and a slit of 0.3 m in the middle."""
        return text.scene(
            'title = "Slit"\nplane = "stress"\n[heat]\n',
            [
                warm("stone", 1e9, 0.2, 1e-5, conductivity=2.0),
                text.block("wall", "stone", text.rectangle((0, 0), (2, 0.5))),
                '[[cracks]]\nname = "slit"\npoints = [[1.003, 0.1], [1.003, 0.4]]\n',
                text.fixed_edge("foot", [[0, 0], [0, 0.5]]),
                edge("hot", np.array([0.0, 0.0]), np.array([0.0, 0.5]), 40.0),
                edge("cold", np.array([2.0, 0.0]), np.array([2.0, 0.5]), 0.0),
            ],
        )

    def formulation(self, scene: "Scene", name: str) -> "Formulation":
        """Return the formulation with ten cells over the width."""
        return with_cover(super().formulation(scene, name), size=0.05, angle=self.angle)

    def measure(self, run: "Run") -> Checks:
        way = 2 + 2 * 0.5 / np.pi * np.log(1 / np.cos(np.pi * 0.15 / 0.5))
        flow = float(run.history["heat:taken:hot"][-1])
        why = "six cells along the slit, its ends enriched alone: 3 % without"
        return {"heat flow (W/m)": Check(flow, 2 * 40 * 0.5 / way, 2e-3, why)}
