"""Columns and lifts that are put in one after the other: each carries what comes after it."""

from typing import TYPE_CHECKING

import numpy as np

from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase
from nmm.verification.formulations import with_cover
from nmm.verification.reading import way

if TYPE_CHECKING:
    from nmm.formulation import Formulation
    from nmm.scene import Scene
    from nmm.stepping.run import Run


def ends(run: "Run", stages: int) -> list[int]:
    """Rows of the history at the ends of stages: time counts their load factors."""
    return [int(row) for row in np.searchsorted(run.history["time"], np.arange(stages) + 1 - 1e-9)]


class AddedColumn(SceneCase):
    """A column is put in beside a loaded one, free of stress; then the first is taken away."""

    name = "ST3"
    title = "A column put in under load takes its share of what comes later"
    source = "Compliances 4 / (1e9 2) and 4 / (3e9 1) share 2 MN as 0.8 and 1.2"
    formulations = ("dda", "quads")

    def scene(self) -> str:
        """Return column A and two halves of B beside it under a stiff cap."""
        tables = [
            text.material("soft", 1e9, 0.0, None),
            text.material("stiff", 3e9, 0.0, None),
            text.material("cap", 1e13, 0.0, None),
            text.interface("any", 0.0),
            text.block("cap", "cap", text.rectangle((-2, 4), (2, 5))),
            '[[supports]]\nname = "guide"\nblock = "cap"\npoint = [0, 5]\nfix = ["x"]\n',
            text.monitor("cap", (0, 5), "cap"),
        ]
        for name, kind, left, right in (
            ("A", "soft", -1.0, 1.0),
            ("left", "stiff", -1.75, -1.25),
            ("right", "stiff", 1.25, 1.75),
        ):
            tables += [
                text.block(name, kind, text.rectangle((left, 0), (right, 4))),
                f'[[supports]]\nname = "under {name}"\nblock = "{name}"\nfix = ["x", "y"]\n'
                f"segment = [[{left}, 0], [{right}, 0]]\n",
            ]
        tables += [
            text.pulled_edge(name, [[-2, 5], [2, 5]], [0, -force / 4])
            for name, force in (("first", 1e6), ("more", 2e6))
        ]
        tables.append(
            '[[stages]]\nname = "A"\nblocks = ["A", "cap"]\nloads = ["first"]\n'
            '[[stages]]\nname = "B too"\nadd = ["left", "right"]\n'
            '[[stages]]\nname = "more"\nloads = ["first", "more"]\n'
            '[[stages]]\nname = "B alone"\nremove = ["A"]\n'
        )
        return text.scene(
            'title = "Columns"\nplane = "stress"\n[contact]\n'
            "[formulation.contact]\nnormal_penalty = 1000.0\n",
            tables,
        )

    def measure(self, run: "Run") -> Checks:
        history, last = run.history, ends(run, 4)
        shared = history["reaction:under left:y"] + history["reaction:under right:y"]
        soft = "springs of contact and the cap are soft by 1e-4"
        checks = {
            f"A in stage {stage + 1} (MN)": Check(
                float(history["reaction:under A:y"][last[stage]]) / 1e6, known, 3e-4, soft, 3.0
            )
            for stage, known in enumerate((1.0, 1.0, 1.8))
        }
        checks |= {
            f"B in stage {stage + 2} (MN)": Check(
                float(shared[last[stage + 1]]) / 1e6, known, 3e-4, soft, 3.0
            )
            for stage, known in enumerate((0.0, 1.2, 3.0))
        }
        return checks | {
            f"cap in stage {stage + 1} (mm)": Check(
                1e3 * float(way(run, "cap")[last[stage], 1]), known, 5e-4, soft
            )
            for stage, known in enumerate((-2.0, -2.0, -3.6, -6.0))
        }


class Embankment(SceneCase):
    """Six lifts are placed on one another, each level as it is placed."""

    name = "ST2"
    title = "An embankment built in lifts settles most at mid height"
    source = "gamma (H - y) y / M, M = E (1 - nu) / ((1 + nu) (1 - 2 nu))"
    formulations = ("manifold", "quads degree 2")
    lifts = 6
    height = 2.0
    modulus = 20e6
    poisson = 0.3
    density = 2000.0

    def scene(self) -> str:
        """Return a strip of it that cannot move sideways, glued lift on lift."""
        n, h = self.lifts, self.height
        tables = [
            text.material("fill", self.modulus, self.poisson, self.density),
            text.interface("any", 30.0, more={"bonded": True}),
            text.fixed_edge("ground", [[0, 0], [2, 0]]),
        ]
        for number in range(n):
            low, top = number * h, (number + 1) * h
            tables += [
                text.box(f"lift {number}", (0, low), (2, h), "fill"),
                *(
                    f'[[supports]]\nname = "{side} {number}"\nblock = "lift {number}"\n'
                    f'segment = [[{x}, {low}], [{x}, {top}]]\nfix = ["x"]\n'
                    for side, x in (("left", 0), ("right", 2))
                ),
                text.monitor(f"top {number}", (1, top), f"lift {number}"),
            ]
        tables.append('[[stages]]\nname = "s0"\nblocks = ["lift 0"]\n')
        tables += [f'[[stages]]\nname = "s{k}"\nadd = ["lift {k}"]\n' for k in range(1, n)]
        return text.scene('title = "Embankment"\nplane = "strain"\n[gravity]\n', tables)

    def formulation(self, scene: "Scene", name: str) -> "Formulation":
        """Return cells of a lift."""
        return with_cover(super().formulation(scene, name), size=self.height)

    def measure(self, run: "Run") -> Checks:
        nu, n, h = self.poisson, self.lifts, self.height
        confined = self.modulus * (1 - nu) / ((1 + nu) * (1 - 2 * nu))
        weight = self.density * text.G
        glue = "linear stress is held exactly; glue and supports are Nitsche's"
        checks, last = {}, ends(run, n)
        for number in range(n):
            ways = -1e3 * way(run, f"top {number}")[:, 1]
            top = (number + 1) * h
            later = 1e3 * weight * (n * h - top) * top / confined
            own = 1e3 * weight * (h * top - h**2 / 2) / confined
            checks[f"top at {top:g} m by later lifts (mm)"] = Check(
                float(ways[last[-1]] - ways[last[number]]), later, 1e-6, glue, 26.2347
            )
            checks[f"top at {top:g} m by its own (mm)"] = Check(
                float(ways[last[number]]), own, 1e-6, glue, 26.2347
            )
        return checks
