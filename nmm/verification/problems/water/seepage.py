"""Water that seeps through blocks, and what its pressure does to them."""

from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from integration.arrays import Floats
from nmm.study.samples import elements_at, fields
from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase, limit
from nmm.verification.continuum import quarter
from nmm.verification.formulations import with_cover
from nmm.verification.problems.solids.cylinders import polar
from nmm.verification.problems.water.water_pressures import water
from nmm.verification.reading import last_way

if TYPE_CHECKING:
    from nmm.formulation import Formulation
    from nmm.scene import Scene
    from nmm.stepping.run import Run
    from nmm.water.pore_water import PoreWater

HELD = "exact: the functions hold head, displacement and stress; supports hold by Nitsche's method"


def porous(name: str, modulus: float, poisson: float, more: str = "") -> str:
    """Table of a material of 1e-6 m/s that weighs 20 kN/m3 where it is saturated."""
    plain = text.material(name, modulus, poisson, 20e3 / 9.81)
    return f"{plain}hydraulic_conductivity = 1e-6\n{more}"


def head(name: str, start: Floats, end: Floats, value: float, more: str = "") -> str:
    """Table of a head along a segment."""
    segment = [np.asarray(start, dtype=float).tolist(), np.asarray(end, dtype=float).tolist()]
    return f'[[heads]]\nname = "{name}"\nsegment = {segment}\nhead = {value!r}\n{more}'


def consolidating(title: str, initial: float, weight: float, time: float, steps: int) -> str:
    """Head of a scene of soil that gives way as its water leaves, over a time (s) in steps."""
    return (
        f'title = "{title}"\nplane = "strain"\n[loading]\nscaled = []\n'
        f"[seepage]\ncoupled = true\ntransient = true\ninitial = {initial!r}\n"
        f"unit_weight = {weight!r}\nduration = {time!r}\n"
        f"[formulation.loading]\nincrement = {1 / steps!r}\n"
        '[formulation.rotation]\nupdate = "small"\n'
        '[formulation.supports]\nmethod = "lagrange"\n'
    )


def pressure(run: "Run", points: Floats) -> Floats:
    """Pressure of the pores (m,) of a run's last state at points (m, 2), Pa."""
    effects = run.stepper.plan.effects
    seepage: PoreWater = effects.get("seepage", effects.get("consolidation"))  # type: ignore[assignment]
    elements = elements_at(run.manifold.elements, points)
    return np.asarray(seepage.space.values(elements, points) @ seepage.acting(run.state.time))


@dataclass(frozen=True)
class RisingWater(SceneCase):
    """A column of soil in which water rises: at the critical gradient nothing presses any more."""

    name = "WA9"
    title = "Rising water takes the weight of soil"
    source = "Terzaghi: s' = (i w - (s - w)) (H - y), w = 9.81, s = 20 kN/m3"
    formulations = ("degree 2", "manifold", "quads", "splines")
    gradient: float = 0.0
    # Still water, half of the critical gradient, and it itself.
    parameters: ClassVar = {"gradient": (0.0, 0.5, 1.0)}
    label = "{0.gradient:g} of the critical gradient"

    def scene(self) -> str:
        """Return a column 10 m high; water stands at its top, and higher below it."""
        rise = self.gradient * (20e3 - 9810.0) / 9810.0
        return text.scene(
            'title = "Column"\nplane = "strain"\n[gravity]\n[seepage]\n',
            [
                porous("soil", 50e6, 0.3),
                text.box("column", (0, 0), (2, 10), "soil"),
                text.fixed_edge("left", [(0, 0), (0, 10)], "x"),
                text.fixed_edge("right", [(2, 0), (2, 10)], "x"),
                text.fixed_edge("low", [(0, 0), (2, 0)], "y"),
                head("above", np.array([0, 10]), np.array([2, 10]), 10.0),
                head("below", np.array([0, 0]), np.array([2, 0]), 10.0 + 10.0 * rise),
            ],
        )

    def measure(self, run: "Run") -> Checks:
        y = np.array([1.0, 4.7, 9.3])
        points = np.stack([np.full(3, 0.9), y], axis=1)
        pores = pressure(run, points)
        stress = fields(run, points).stress[:, 1]
        own = (20e3 - 9810.0) * 10
        rise = self.gradient * (20e3 - 9810.0) / 9810.0
        # Supports of blocks are springs, which hold the sides of a column of one block unevenly.
        aim = 1e-6 if run.manifold.shared_covers else 5e-3
        checks = {}
        for at, total, pore in zip(y, stress, pores, strict=True):
            effective = -(1 - self.gradient) * (20e3 - 9810.0) * (10 - at)
            name = f"effective stress at y = {at:g} (Pa)"
            checks[name] = Check(float(total + pore), effective, aim, HELD, scale=own)
            wanted = 9810.0 * (1 + rise) * (10 - at)
            checks[f"pressure at y = {at:g} (Pa)"] = Check(float(pore), wanted, 1e-9, HELD)
        flow = run.history["seepage:taken:below"][-1]
        return checks | {"flow (m2/s)": Check(flow, 2e-6 * rise, 1e-9, HELD, scale=2e-6)}


class PorousCylinder(SceneCase):
    """A thick cylinder with water in it that seeps out through the wall."""

    name, title = "WA10", "Seepage through a thick cylinder"
    source = "Lamé, and Timoshenko's heated cylinder with E alpha T / (1 - 2 nu) = b p"
    formulations = ("manifold", "manifold degree 2", "quads degree 2")
    chords = 32

    def scene(self) -> str:
        """Return a quarter between 1 MPa inside and none outside, radii 1 m and 2 m."""
        arc = quarter(1.0, self.chords)[::-1]
        even = "gradient = [0.0, 1.0]\n"  # of head: a pressure that does not grow with depth
        faces = []
        for i, (a, b) in enumerate(pairwise(arc)):
            faces += [
                head(f"in {i}", a, b, 1e6 / 9810.0, even),
                head(f"out {i}", 2 * a, 2 * b, 0.0, even),
                water(f"on {i}", f"segment = {[a.tolist(), b.tolist()]}\npressures = [1e6, 1e6]"),
            ]
        return text.scene(
            'title = "Porous cylinder"\nplane = "strain"\n[seepage]\n',
            [
                porous("rock", 10e9, 0.25, "biot = 0.8\n"),
                text.block("wall", "rock", np.concatenate([2 * arc, arc[::-1]])),
                text.fixed_edge("left", [(0, 1), (0, 2)], "x"),
                text.fixed_edge("low", [(1, 0), (2, 0)], "y"),
                *faces,
                # A pressure that is even around has water of its own weight fall through the wall.
                '[[inflows]]\nname = "low"\nsegment = [[1, 0], [2, 0]]\nvelocity = -1e-6\n',
                text.monitor("inner", (1.0, 0.0), "wall"),
            ],
        )

    def formulation(self, scene: "Scene", name: str) -> "Formulation":
        """Return the formulation with eight cells across the wall, four of degree 2."""
        return with_cover(
            super().formulation(scene, name), size=0.125 if name == "manifold" else 0.25
        )

    def measure(self, run: "Run") -> Checks:
        a = np.array([np.cos(0.7), np.sin(0.7)])
        radii = np.array([1.05, 1.5, 1.95])
        found = fields(run, np.outer(radii, a)).stress
        aim = "the aim is 1 %; chords stand back from the arc by 3e-4"
        flow = sum(run.history[f"seepage:taken:in {i}"][-1] for i in range(self.chords))
        exact = 1e-6 * 1e6 / 9810.0 / np.log(2) * np.pi / 2 - 1e-6
        checks = {"flow (m2/s)": Check(flow, exact, 5e-3, aim)}
        for r, stress in zip(radii.tolist(), found, strict=True):
            radial, hoop = polar(stress, 0.7)
            wanted = total_stress(r)
            checks[f"radial stress at {r:g} m (Pa)"] = Check(radial, wanted[0], 0.01, aim, 1e6)
            checks[f"hoop stress at {r:g} m (Pa)"] = Check(hoop, wanted[1], 0.01, aim, 1e6)
        widening = float(last_way(run, "inner")[0])
        # Strain along the hoop: effective stress s + b p in plane strain, at r = 1.
        radial, hoop = (part + 0.8e6 for part in total_stress(1.0))
        strain = 1.25 / 10e9 * (0.75 * hoop - 0.25 * radial)
        return checks | {"widening inside (m)": Check(widening, strain, 0.01, aim)}


class SeepingDam(SceneCase):
    """An upright dam through which water seeps below a free surface, to a seepage face."""

    name, title = "WA12", "Seepage with a free surface"
    source = "Dupuit's discharge, exact by Charny (1951): k (h1^2 - h2^2) / (2 L)"
    formulations = ("manifold", "manifold degree 2", "quads", "splines")
    cover: ClassVar = {"size": 1.0}

    def scene(self) -> str:
        """Return a dam 8 m long under 10 m of water on one side and 2 m on the other."""
        return text.scene(
            'title = "Dam"\nplane = "strain"\n[seepage]\nfree_surface = true\n',
            [
                porous("soil", 50e6, 0.3),
                text.box("dam", (0, 0), (8, 12), "soil"),
                text.fixed_edge("low", [(0, 0), (8, 0)], "y"),
                text.fixed_point("foot", (0.0, 0.0), "x"),
                head("up", np.array([0, 0]), np.array([0, 12]), 10.0),
                head("down", np.array([8, 0]), np.array([8, 12]), 2.0),
            ],
        )

    def measure(self, run: "Run") -> Checks:
        flow, out = (run.history[f"seepage:taken:{name}"][-1] for name in ("up", "down"))
        exact = 1e-6 * (10.0**2 - 2.0**2) / 16
        why = "exact whatever the cells; the level on the face may cut one"
        return {
            "flow (m2/s)": Check(flow, exact, 2e-3, why),
            "in and out": limit(abs(flow + out) / flow, 1e-9, "conserved"),
        }


def total_stress(r: float) -> tuple[float, float]:
    """Radial and hoop stress (Pa) of `PorousCylinder`: p = 1e6 ln(2 / r) / ln 2, b = .8."""
    # E alpha T / (1 - nu) = b p (1 - 2 nu) / (1 - nu).
    unit = 0.8e6 * 0.5 / 0.75

    def moment(x: float) -> float:
        # Integral of ln(2 / r) r / ln 2 from 1 to x.
        return float((x * x / 2 * np.log(2 / x) + x * x / 4 - np.log(2) / 2 - 0.25) / np.log(2))

    whole, inner = moment(2.0), moment(r)
    radial = unit / r**2 * ((r * r - 1) / 3 * whole - inner)
    share = np.log(2 / r) / np.log(2)
    hoop = unit / r**2 * ((r * r + 1) / 3 * whole + inner - share * r * r)
    return float(radial + 1e6 / 3 * (1 - 4 / r**2)), float(hoop + 1e6 / 3 * (1 + 4 / r**2))


class Layers(SceneCase):
    """Water through two bonded layers, one of them given as a joint that leaks."""

    name, title = "WA11", "Seepage through two blocks and the skin between them"
    source = "Resistances in series: L1 / k + 1 / leakage + L2 / k"
    formulations = ("dda", "degree 2", "manifold", "quads", "splines")

    def scene(self) -> str:
        """Return two blocks of 1 m under 12 m of head, a leakage of 1e-6 1/s between."""
        glue = text.interface("skin", 0.0, more={"bonded": True}) + "leakage = 1e-6\n"
        return text.scene(
            'title = "Layers"\nplane = "strain"\n[seepage]\n',
            [
                porous("soil", 50e6, 0.3),
                glue,
                text.box("a", (0, 0), (1, 1), "soil"),
                text.box("b", (1, 0), (1, 1), "soil"),
                text.fixed_edge("left", [(0, 0), (0, 1)], "x"),
                text.fixed_point("foot", (0.0, 0.0), "y"),
                head("in", np.array([0, 0]), np.array([0, 1]), 12.0),
                head("out", np.array([2, 0]), np.array([2, 1]), 0.0),
            ],
        )

    def measure(self, run: "Run") -> Checks:
        flow = run.history["seepage:taken:in"][-1]
        out = run.history["seepage:taken:out"][-1]
        return {
            "flow (m2/s)": Check(flow, 4e-6, 1e-8, "linear heads: exact"),
            "in and out": limit(abs(flow + out) / flow, 1e-10, "conserved"),
        }
