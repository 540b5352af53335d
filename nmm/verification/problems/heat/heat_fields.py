"""Strain of temperatures that vary in a body: a hot core, and a field that bends nothing."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from nmm.study.samples import fields
from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase, limit
from nmm.verification.continuum import quarter
from nmm.verification.problems.heat.heat_strain import GLUE, ROUNDING, given, warm
from nmm.verification.reading import last_way

if TYPE_CHECKING:
    from nmm.stepping.run import Run


@dataclass(frozen=True)
class HotCore(SceneCase):
    """A disc with a hot core: the strain jumps at a line between blocks."""

    name = "TH4"
    title = "Disc with a hot core"
    source = "Lamé's solution; core .5 m, disc 2 m, ten times as large as given"
    formulations = ("manifold", "quads degree 2")
    plane: str = "stress"
    parameters: ClassVar = {"plane": ("stress", "strain")}
    label = "plane {0.plane}"
    cover: ClassVar = {"size": 0.25}

    def scene(self) -> str:
        """Return a quarter: 60 K in the core."""
        arc = quarter(1.0, 48)[::-1]
        head = f'title = "Core"\nplane = "{self.plane}"\n[heat]\n'
        return text.scene(
            head,
            [
                warm("alloy", 70e9, 0.3, 23e-6),
                GLUE,
                text.block("core", "alloy", np.concatenate([[[0, 0]], 0.5 * arc])),
                text.block("ring", "alloy", np.concatenate([2 * arc, 0.5 * arc[::-1]])),
                text.fixed_edge("left", [(0, 0), (0, 2)], "x"),
                text.fixed_edge("low", [(0, 0), (2, 0)], "y"),
                given("core", 60.0),
                given("ring", 0.0),
                text.monitor("rim", (2.0, 0.0), "ring"),
            ],
        )

    def measure(self, run: "Run") -> Checks:
        factor = 1.0 if self.plane == "stress" else 1 / 0.7
        widening = 0.1725e-3 if self.plane == "stress" else 0.22425e-3
        a = np.cos(0.7), np.sin(0.7)
        places = np.array([[0.25 * a[0], 0.25 * a[1]], [1.2 * a[0], 1.2 * a[1]]])
        found = fields(run, places).stress
        hoop = found[1] @ [a[1] ** 2, a[0] ** 2, -2 * a[0] * a[1]]
        # Lamé in the ring: A (1 + b^2 / r^2) with A (1 - b^2 / c^2) the core's pressure.
        inner = -45.28125e6 * factor
        ring = inner / (1 - 16) * (1 + 4 / 1.44)
        near = "a point of a mesh of .25 m, of the stress of the core; the aim is 1 %"
        return {
            "sxx in the core (Pa)": Check(float(found[0, 0]), inner, 0.01, near),
            "hoop stress at 1.2 m (Pa)": Check(float(hoop), ring, 0.01, near, scale=-inner),
            "widening (m)": Check(float(last_way(run, "rim")[0]), widening, 0.01, "the aim"),
        }


@dataclass(frozen=True)
class LinearTemperature(SceneCase):
    """A temperature linear in x and y strains a free body and does not stress it."""

    name = "TH5"
    title = "Linear temperature of a free body"
    source = "u = A (T0 x + gx (x2 - y2) / 2 + gy x y), v alike; no stress"
    formulations = ("degree 2", "manifold", "quads", "manifold degree 2")
    plane: str = "stress"
    blocks: int = 1
    parameters: ClassVar = {"plane": ("stress", "strain"), "blocks": (1, 2)}
    label = "plane {0.plane}, {0.blocks} blocks"

    def scene(self) -> str:
        """Return a body of 2 m by 1 m at 10 + 7 x - 4 y K, conducted between its edges."""
        width = 2.0 / self.blocks
        slope = "gradient = [7.0, -4.0]\n"
        conducts = text.interface("glue", 0.0, more={"bonded": True}) + 'conductance = "perfect"\n'
        boxes = [text.box(f"b{i}", (i * width, 0), (width, 1), "m") for i in range(self.blocks)]
        ends = [([0, 0], [0, 1]), ([2, 0], [2, 1]), ([0, 0], [2, 0]), ([0, 1], [2, 1])]
        edges = [
            f'[[temperatures]]\nname = "edge {i}"\nsegment = {list(ends)}\n'
            f"temperature = 10\n{slope}"
            for i, ends in enumerate(ends)
        ]
        # Springs at three points hold without stress.
        held = [text.fixed_point("foot", (0.0, 0.0)), text.fixed_point("top", (0.0, 1.0), "x")]
        head = f'title = "Linear temperature"\nplane = "{self.plane}"\n[heat]\n'
        tip = text.monitor("tip", (2.0, 1.0), f"b{self.blocks - 1}")
        material = warm("m", 30e9, 0.2, 1e-5, conductivity=2.0)
        return text.scene(head, [material, conducts, *boxes, *held, *edges, tip])

    def measure(self, run: "Run") -> Checks:
        a = 1e-5 * (1.0 if self.plane == "stress" else 1.2)
        t, x, y, gx, gy = 10.0, 2.0, 1.0, 7.0, -4.0
        u = a * (t * x + gx * (x * x - y * y) / 2 + gy * x * y)
        v = a * (t * y + gx * x * y + gy * (y * y - x * x) / 2)
        # The support at the top turns the body back: it stands at x = 0.
        turn = a * gx * -(1.0) / 2
        u, v = u - turn * y, v + turn * x
        unit = 30e9 * 1e-5 * 20
        points = np.random.default_rng(1).uniform((0.01, 0.01), (1.99, 0.99), (40, 2))
        stress = float(np.abs(fields(run, points).stress).max()) / unit
        way = last_way(run, "tip")
        return {
            "stress over E alpha T": limit(stress, 1e-9, ROUNDING),
            "ux of a corner (m)": Check(float(way[0]), u, 1e-8, ROUNDING),
            "uy of a corner (m)": Check(float(way[1]), v, 1e-8, ROUNDING),
        }
