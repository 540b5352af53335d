"""A round tunnel in ground that flows, whose stress reaches the corner of Mohr's pyramid."""

from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase, holds
from nmm.verification.continuum import quarter
from nmm.verification.reading import converged, way

if TYPE_CHECKING:
    from nmm.stepping.run import Run

PRESSURE, SHEAR, BULK, RIM = 30.0, 2800.0, 3900.0, 3.0
POISSON = (3 * BULK - 2 * SHEAR) / (2 * (3 * BULK + SHEAR))
SIDES = 32
WALLS = {0: (12.27161, 12.16712), 30: (28.57271, 28.10346)}
"""Way of the wall (mm) by dilation: with flow on the corner, and as if the stress across were
between the others everywhere (Salencon 1969)."""


@dataclass(frozen=True)
class FlowingTunnel(SceneCase):
    """The wall of a tunnel loses its pressure; beyond the rim springs stand for elastic ground.

    A ring of elastic ground without end resists as springs of ``2 G / r``, exactly.
    """

    name = "PL2"
    title = "Tunnel in ground that flows"
    source = "Salencon's zones, beyond r = 1.271 a; within s_z = s_t: two solutions"
    formulations = ("quads degree 2",)
    dilation: int = 0
    # Ground that keeps its volume as it flows, and one that dilates by its friction.
    parameters: ClassVar = {"dilation": WALLS}
    label = "psi {0.dilation}"
    cover: ClassVar = {"size": 0.25}

    def scene(self) -> str:
        """Return a quarter in MPa, a = 1 m, under the same stress from all three sides."""
        inner = quarter(1.0, SIDES)
        modulus, edges = 2 * SHEAR * (1 + POISSON), []
        for number, (start, end) in enumerate(pairwise(inner)):
            out = (start + end) / np.linalg.norm(start + end)
            wall, rim = ([tuple(r * start), tuple(r * end)] for r in (1.0, RIM))
            edges += [
                text.pulled_edge(f"wall {number}", wall, PRESSURE * out)
                + "history = [[0, 1], [1, 0]]\n",
                text.pulled_edge(f"rim {number}", rim, -PRESSURE * out),
                f'[[foundations]]\nname = "beyond {number}"\n'
                f"segment = {[list(map(float, one)) for one in rim]}\n"
                f"normal_stiffness = {2 * SHEAR / RIM!r}\n",
            ]
        return text.scene(
            'title = "Tunnel that flows"\nplane = "strain"\n[loading]\nscaled = []\n'
            "[formulation.loading]\nincrement = 0.05\n",
            [
                f'[materials.rock]\nlaw = "mohr_coulomb"\nyoung_modulus = {modulus!r}\n'
                f'poisson_ratio = {POISSON!r}\ncohesion = 3.45\nfriction_angle = "30 deg"\n'
                f'dilation_angle = "{self.dilation} deg"\n',
                text.block("ring", "rock", np.concatenate([inner, RIM * inner[::-1]])),
                f'[[initial_stresses]]\nblock = "all"\nacross = {-PRESSURE}\n'
                f"stress = [{-PRESSURE}, {-PRESSURE}, 0]\n",
                text.fixed_edge("x", [(0, 1), (0, RIM)], "x"),
                text.fixed_edge("y", [(1, 0), (RIM, 0)], "y"),
                *edges,
                text.monitor("wall", (1.0, 0.0), "ring"),
            ],
        )

    def measure(self, run: "Run") -> Checks:
        exact, plain = WALLS[self.dilation]
        inwards = -1e3 * float(way(run, "wall")[-1, 0])
        return {
            "way of the wall (mm)": Check(inwards, exact, 5e-3, "cells of a quarter, 32 sides"),
            "nearer than without the corner": holds(
                abs(inwards - exact) < abs(inwards - plain), "the corner shows"
            ),
            "at rest": holds(converged(run), "every increment is in equilibrium"),
        }
