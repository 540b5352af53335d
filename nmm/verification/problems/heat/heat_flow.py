"""Heat that is conducted: steady and transient fields, their orders, and the stress they make."""

from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from covers.scalar.space import ScalarSpace
from integration.arrays import Floats
from integration.rules import polygon_rule
from nmm.assembly.places import on_edges
from nmm.diffusion.holding import prescribed
from nmm.diffusion.matrices import slopes
from nmm.diffusion.problem import DiffusionProblem, field_solver
from nmm.formulation import Solver
from nmm.materials.elastic import Elastic
from nmm.study.samples import elements_at, fields
from nmm.verification import text
from nmm.verification.base import Case, Check, Checks, SceneCase, limit, order
from nmm.verification.continuum import polygon, quarter
from nmm.verification.formulations import chosen, with_cover
from nmm.verification.problems.heat.heat_strain import warm
from nmm.verification.problems.solids.cylinders import polar
from nmm.verification.reading import last_way
from nmm.verification.series import Series

if TYPE_CHECKING:
    from nmm.formulation import Formulation
    from nmm.heat.temperature import Heat
    from nmm.scene import Scene
    from nmm.stepping.run import Run


def temperature(run: "Run", points: Floats) -> Floats:
    """Temperature (m,) above the reference of a run's last state at points (m, 2)."""
    heat: Heat = run.stepper.plan.effects["heat"]  # type: ignore[assignment]
    elements = elements_at(run.manifold.elements, points)
    return np.asarray(heat.space.values(elements, points) @ heat.acting(run.state.time))


def edge(name: str, start: Floats, end: Floats, value: float) -> str:
    """Table of a temperature along a segment."""
    segment = [np.asarray(start, dtype=float).tolist(), np.asarray(end, dtype=float).tolist()]
    return f'[[temperatures]]\nname = "{name}"\nsegment = {segment}\ntemperature = {value!r}\n'


class HeatedCylinder(SceneCase):
    """A thick cylinder between two temperatures: their logarithm, and the stress it makes."""

    name, title = "TH3", "Cylinder heated inside"
    source = "Timoshenko and Goodier: T = 100 ln(b / r) / ln(b / a), b = 2 a; ten times as large"
    formulations = ("manifold", "manifold degree 2", "quads degree 2")
    chords = 32

    def scene(self) -> str:
        """Return a quarter, 100 K at the inner face, 0 at the outer one."""
        arc = quarter(1.0, self.chords)[::-1]
        faces = [
            edge(f"{name} {i}", radius * a, radius * b, value)
            for name, radius, value in (("inner", 1.0, 100.0), ("outer", 2.0, 0.0))
            for i, (a, b) in enumerate(pairwise(arc))
        ]
        return text.scene(
            'title = "Cylinder"\nplane = "strain"\n[heat]\n',
            [
                warm("steel", 200e9, 0.3, 12e-6, conductivity=50.0),
                text.block("wall", "steel", np.concatenate([2 * arc, arc[::-1]])),
                text.fixed_edge("left", [(0, 1), (0, 2)], "x"),
                text.fixed_edge("low", [(1, 0), (2, 0)], "y"),
                *faces,
                text.monitor("inner", (1.0, 0.0), "wall"),
                text.monitor("outer", (2.0, 0.0), "wall"),
            ],
        )

    def formulation(self, scene: "Scene", name: str) -> "Formulation":
        """Return the formulation with eight cells across the wall, four of degree 2."""
        return with_cover(
            super().formulation(scene, name), size=0.125 if name == "manifold" else 0.25
        )

    def measure(self, run: "Run") -> Checks:
        a = np.array([np.cos(0.7), np.sin(0.7)])
        half = temperature(run, 1.5 * a[None])[0]
        inner, middle, outer = fields(run, np.outer([1.005, 1.5, 1.99], a)).stress
        unit = 209.82371e6
        near = "read beside the face, of the largest stress"
        flow = sum(run.history[f"heat:taken:inner {i}"][-1] for i in range(self.chords))
        radial, hoop = polar(middle, 0.7)
        aim = "the aim is 1 %; chords stand back from the arc by 3e-4"
        return {
            "temperature at r = 1.5 (K)": Check(
                half, 100 * np.log(4 / 3) / np.log(2), 2e-3, aim, scale=100.0
            ),
            "heat flow (W/m)": Check(flow, 50 * 100 / np.log(2) * np.pi / 2, 5e-3, aim),
            "ux inside (m)": Check(float(last_way(run, "inner")[0]), 0.6053021319e-3, 0.01, aim),
            "ux outside (m)": Check(float(last_way(run, "outer")[0]), 1.210604264e-3, 0.01, aim),
            "hoop stress inside (Pa)": Check(
                polar(inner, 0.7)[1], _hoop(1.005), 0.02, near, scale=unit
            ),
            "hoop stress outside (Pa)": Check(
                polar(outer, 0.7)[1], _hoop(1.99), 0.02, near, scale=unit
            ),
            "radial stress at r = 1.5 (Pa)": Check(radial, -26.704841e6, 0.01, aim, scale=unit),
            "hoop stress at r = 1.5 (Pa)": Check(hoop, 17.439706e6, 0.01, aim, scale=unit),
        }


def _hoop(r: float) -> float:
    """Hoop stress (Pa) of the cylinder of `HeatedCylinder` (Timoshenko and Goodier, art. 135)."""
    scale = 200e9 * 12e-6 * 100 / (2 * 0.7 * np.log(2))
    return float(scale * (1 - np.log(2 / r) - (1 / 3) * (1 + 4 / r**2) * np.log(2)))


class ParabolicTemperature(SceneCase):
    """A free plate that sources heat and faces cool: a parabola, and the stress it makes."""

    name, title = "TH6", "Free plate with a parabolic temperature"
    source = "s = E alpha (mean T - T): -2 MPa in the middle, +4 MPa at the faces"
    formulations = ("manifold", "manifold degree 2", "quads degree 2")

    def scene(self) -> str:
        """Return a plate 2 m thick and 16 m long, 20 K in the middle."""
        return text.scene(
            'title = "Plate"\nplane = "stress"\n[heat]\n',
            [
                warm("m", 30e9, 0.2, 1e-5, conductivity=2.0),
                text.box("plate", (-8, -1), (16, 2), "m"),
                edge("low", np.array([-8, -1]), np.array([8, -1]), 0.0),
                edge("top", np.array([-8, 1]), np.array([8, 1]), 0.0),
                '[[heat_sources]]\nname = "inside"\nblock = "plate"\npower = 80.0\n',
                text.fixed_point("middle", (0.0, 0.0)),
                text.fixed_point("side", (4.0, 0.0), "y"),
            ],
        )

    def measure(self, run: "Run") -> Checks:
        y = np.array([0.02, 0.5, 0.98])
        points = np.stack([np.full(3, 0.11), y], axis=1)
        found, warm_by = fields(run, points).stress[:, 0], temperature(run, points)
        aim = "the aim, of the stress at the faces"
        checks = {}
        for height, stress, rise in zip(y, found, warm_by, strict=True):
            exact = 20 * (1 - height**2)
            where = f"at y = {height:g}"
            reason = "quadratic functions hold the parabola; linear ones to 1 % in cells of .5 m"
            checks[f"temperature {where} (K)"] = Check(float(rise), exact, 0.01, reason, scale=20)
            wanted = 3e5 * (20 * 2 / 3 - exact)
            checks[f"sxx {where} (Pa)"] = Check(float(stress), wanted, 0.015, aim, scale=4e6)
        return checks


@dataclass(frozen=True)
class Slab(SceneCase):
    """A slab one face of which is heated at once: conduction in time, by blocks and by meshes."""

    name = "TH7"
    title = "Slab that is heated at once"
    source = "Carslaw and Jaeger, series in sin((n + 1/2) pi x / L)"
    formulations = ("manifold", "manifold degree 2", "quads", "splines")
    theta: float = 0.5
    parameters: ClassVar = {"theta": (0.5, 1.0)}
    label = "theta = {0.theta:g}"

    def scene(self) -> str:
        """Return a slab of 4 m whose diffusivity is 1e-6 m2/s, over .1 L^2 / a."""
        dense = "density = 2000.0\nheat_capacity = 1000.0\n"
        return text.scene(
            'title = "Slab"\nplane = "stress"\n[heat]\ntransient = true\nduration = 1.6e6\n'
            f"[formulation.diffusion]\ntheta = {self.theta!r}\n"
            "[formulation.loading]\nincrement = 0.025\n",
            [
                warm("m", 30e9, 0.2, 0.0, conductivity=2.0).replace("thermal_expansion = 0.0\n", "")
                + dense,
                text.box("slab", (0, 0), (4, 1), "m"),
                text.fixed_block("slab"),
                edge("hot", np.array([0, 0]), np.array([0, 1]), 100.0),
            ],
        )

    def measure(self, run: "Run") -> Checks:
        x = np.array([0.5, 1.3, 2.2, 3.9])
        found = temperature(run, np.stack([x, np.full(4, 0.47)], axis=1))
        n = (np.arange(100)[:, None] + 0.5) * np.pi
        decay = np.exp(-(n**2) * 0.1)
        exact = 100 - 100 * (2 / n * np.sin(n * x / 4) * decay).sum(axis=0)
        stored = 2e6 * 4 * 100 * float(1 - (2 / n**2 * decay).sum())
        taken, kept = run.history["heat:taken:hot"][-1], run.history["heat:stored"][-1]
        step = "order 2 in time, cells of .5 m" if self.theta < 1 else "order 1 in time, 40 steps"
        bound = 0.004 if self.theta < 1 else 0.012
        checks = {
            f"temperature at x = {at:g} (K)": Check(
                float(value), float(is_), bound, step, scale=100
            )
            for at, value, is_ in zip(x, found, exact, strict=True)
        }
        checks["heat stored (J)"] = Check(kept, stored, 2 * bound, step)
        checks["heat taken up less stored"] = limit(abs(taken / kept - 1), 1e-10, "conserved")
        return checks


@dataclass(frozen=True)
class HeatRates(Case):
    """A harmonic temperature on cut covers converges with one order more than its degree."""

    name = "TH8"
    title = "Orders of a harmonic temperature"
    source = "T = e^x sin y, held along all edges of a turned square"
    formulations = (
        *("finite elements", "manifold", "manifold degree 2", "bilinear quads", "quads"),
        *("quads degree 2", "splines"),
    )
    angle: float = 0.3

    def checks(self, formulation: str) -> Checks:
        """Solve in cells of three sizes."""
        sizes = [0.5, 0.25, 0.125]
        found = [self._error(formulation, size) for size in sizes]
        degree = found[0][1]
        series = Series.of(sizes, [error for error, _ in found], theory=degree + 1)
        why = "slope over cuts of unlike shapes; one order more than the degree at least"
        return {"order in the mean square": order(series, 0.25, why, at_least=True)}

    def _error(self, formulation: str, size: float) -> tuple[float, int]:
        """Error in the mean square, and the degree that covers hold."""
        from nmm.model.from_polygons import solid

        square = text.turned(text.rectangle((0, 0), (1, 1)), self.angle)
        cover = chosen(formulation).cover.model_copy(update={"size": size})
        model = solid(polygon(square), cover, [Elastic(1.0, 0.2)], "stress")
        manifold, space = model.manifold, ScalarSpace.of(model.manifold)
        alike = np.tile(np.eye(2), (len(model.density), 1, 1))
        place = on_edges(manifold, np.ones(len(manifold.boundary), dtype=bool), 10)
        edges = prescribed(space, model, alike, place, _harmonic(place.position), "rim")
        solver = field_solver(manifold, Solver())
        problem = DiffusionProblem(space, slopes(space, alike), None, [edges], [], [], solver)
        rule = polygon_rule(manifold.elements, 10)
        off = space.values(rule.owner, rule.points) @ problem.steady(0.0) - _harmonic(rule.points)
        assert manifold.reproduction is not None
        return float(np.sqrt(rule.weights @ off**2)), manifold.reproduction


def _harmonic(points: Floats) -> Floats:
    return np.asarray(np.exp(points[:, 0]) * np.sin(points[:, 1]))
