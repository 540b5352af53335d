"""Strain of temperatures that are given: held bars, strips, discs, free bodies."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from nmm.study.samples import fields
from nmm.verification import text
from nmm.verification.base import MESHES, Check, Checks, SceneCase
from nmm.verification.reading import last_way, mean_stress

if TYPE_CHECKING:
    from nmm.stepping.run import Run
ROUNDING = "exact: the functions hold the answer; what is left is rounding"
GLUE = text.interface("glue", 0.0, more={"bonded": True})


def warm(
    name: str,
    modulus: float,
    poisson: float,
    expansion: float,
    conductivity: float | None = None,
) -> str:
    """Table of an elastic material that expands by ``expansion`` (1/K)."""
    conducts = "" if conductivity is None else f"conductivity = {conductivity!r}\n"
    plain = text.material(name, modulus, poisson, density=None)
    return f"{plain}thermal_expansion = {expansion!r}\n{conducts}"


def given(block: str, temperature: float, more: str = "") -> str:
    """Table of a temperature in a whole block."""
    return (
        f'[[temperatures]]\nname = "in {block}"\nblock = "{block}"\n'
        f"temperature = {temperature!r}\n{more}"
    )


@dataclass(frozen=True)
class Restrained(SceneCase):
    """A bar that is held in one direction or two; a gap that closes before it is."""

    name = "TH2"
    title = "A bar that may not expand"
    source = "Hooke's law: s = -E alpha T, over 1 - nu for each direction held"
    formulations = (*MESHES, "quads", "splines", "multipliers")
    plane: str = "stress"
    axes: str = "x"
    parameters: ClassVar = {"plane": ("stress", "strain"), "axes": ("x", "xy")}

    @property
    def variant(self) -> str:
        return f"plane {self.plane}, {' and '.join(self.axes)} held"

    def scene(self) -> str:
        """Return a bar of 2 m by 1 m, 30 K warmer."""
        sides = {
            "x": [
                text.fixed_edge("left", [(0, 0), (0, 1)], "x"),
                text.fixed_edge("right", [(2, 0), (2, 1)], "x"),
            ],
            "y": [
                text.fixed_edge("low", [(0, 0), (2, 0)], "y"),
                text.fixed_edge("top", [(0, 1), (2, 1)], "y"),
            ],
        }
        held = [table for axis in self.axes for table in sides[axis]]
        held += [] if "y" in self.axes else [text.fixed_point("foot", (0.0, 0.0), "y")]
        head = f'title = "Restrained bar"\nplane = "{self.plane}"\n[heat]\n'
        bar = [warm("concrete", 30e9, 0.2, 1e-5), text.box("bar", (0, 0), (2, 1), "concrete")]
        return text.scene(head, [*bar, *held, given("bar", 30.0)])

    def measure(self, run: "Run") -> Checks:
        across = {"xy": -11.25e6, "x": -9e6}[self.axes]
        strained = {"xy": -15e6, "x": -11.25e6}[self.axes]
        stress = across if self.plane == "stress" else strained
        found = mean_stress(run)
        side = stress if "y" in self.axes else 0.0
        return {
            "sxx (Pa)": Check(float(found[0]), stress, 1e-9, ROUNDING),
            "syy (Pa)": Check(float(found[1]), side, 1e-9, ROUNDING, scale=abs(stress)),
        }


class ClosingGap(SceneCase):
    """A bar that expands through a gap and is pressed after that."""

    name, title = "TH2 gap", "A bar that closes a gap as it warms"
    source = "u = alpha T L up to the gap; then s = -E (alpha T - gap / L)"
    formulations = ("lagrange", "cone")

    def scene(self) -> str:
        """Return a bar of 2 m beside a wall at 0.2 mm, 30 K warmer."""
        head = (
            'title = "Gap"\nplane = "stress"\n[contact]\n[heat]\n'
            "[formulation.loading]\nincrement = 0.25\n"
        )
        gap = 2.0002
        return text.scene(
            head,
            [
                warm("concrete", 30e9, 0.0, 1e-5),
                text.material("wall", 30e15, 0.0, None),
                text.interface("contact", 0.0),
                text.box("bar", (0, 0), (2, 0.5), "concrete"),
                text.box("wall", (gap, -0.5), (1, 1.5), "wall"),
                text.fixed_block("wall"),
                text.fixed_edge("left", [(0, 0), (0, 0.5)], "x"),
                text.fixed_edge("low", [(0, 0), (2, 0)], "y"),
                given("bar", 30.0),
                given("wall", 0.0),
            ],
        )

    def measure(self, run: "Run") -> Checks:
        stress = float(run.stress[0, 0])
        give = "supports of blocks are springs of 1000 E; the wall is a million times stiffer"
        return {"sxx of the bar (Pa)": Check(stress, -6e6, 2e-3, give)}


class Bimetal(SceneCase):
    """Two layers that expand differently bend; lengths are a hundred times Timoshenko's."""

    name, title = "TH1", "Bimetal strip"
    source = "Timoshenko (1925): 8.393005828e-4 1/m, of plane stress away from the ends"
    formulations = ("manifold", "manifold degree 2", "quads degree 2")

    def scene(self) -> str:
        """Return a cantilever of 20 m, layers of 0.4 m and 0.6 m."""
        head = 'title = "Bimetal"\nplane = "stress"\n[heat]\n'
        return text.scene(
            head,
            [
                warm("steel", 200e9, 0.3, 12e-6),
                warm("zinc", 100e9, 0.3, 19e-6),
                GLUE,
                text.box("low", (0, 0), (20, 0.4), "steel"),
                text.box("top", (0, 0.4), (20, 0.6), "zinc"),
                text.fixed_edge("wall", [(0, 0), (0, 1)], "x"),
                text.fixed_point("foot", (0.0, 0.4), "y"),
                given("low", 80.0),
                given("top", 80.0),
                text.monitor("tip", (20.0, 0.4), "low"),
                text.monitor("middle", (10.0, 0.4), "low"),
            ],
        )

    def measure(self, run: "Run") -> Checks:
        middle = float(last_way(run, "middle")[1])
        curvature = -2 * middle / 10.0**2
        y = np.array([0.001, 0.399, 0.401, 0.999])
        found = fields(run, np.stack([np.full(4, 9.87), y], axis=1)).stress[:, 0]
        wanted = [-21.542048e6, 45.601998e6, -33.199001e6, 17.159034e6]
        names = ("at the bottom", "below the interface", "above it", "at the top")
        beam = "beam theory; stresses are read 1 mm from the faces, of 45.6 MPa"
        root = "the root's rollers lie within one thickness of where bending is even"
        checks = {"curvature (1/m)": Check(curvature, 8.393005828e-4, 5e-3, root)}
        for name, value, reference in zip(names, found.tolist(), wanted, strict=True):
            checks[f"sxx {name} (Pa)"] = Check(value, reference, 0.01, beam, scale=45.6e6)
        return checks
