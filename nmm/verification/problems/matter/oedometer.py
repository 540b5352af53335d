"""Soil pressed in a box: Mohr-Coulomb at an edge of its pyramid."""

from typing import TYPE_CHECKING

import numpy as np

from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase, holds
from nmm.verification.reading import converged

if TYPE_CHECKING:
    from nmm.stepping.run import Run


class Oedometer(SceneCase):
    """Soil between smooth walls is pressed by 1 %; both stresses across are equal and yield."""

    name = "PL1"
    title = "Oedometer test of soil with dilation"
    source = "Flow on the edge of the pyramid, piecewise linear: 529.27174 and 164.87691 kPa"
    formulations = ("manifold", "quads degree 2")

    def scene(self) -> str:
        """Return a square of 1 m whose top comes down by 10 mm."""
        walls = [
            text.fixed_edge("left", [(0, 0), (0, 1)], "x"),
            text.fixed_edge("right", [(1, 0), (1, 1)], "x"),
        ]
        return text.scene(
            'title = "Oedometer"\nplane = "strain"\n',
            [
                '[materials.soil]\nlaw = "mohr_coulomb"\nyoung_modulus = 50e6\n'
                'poisson_ratio = 0.2\ncohesion = 10e3\nfriction_angle = "30 deg"\n'
                'dilation_angle = "10 deg"\n',
                text.box("soil", (0, 0), (1, 1), "soil"),
                *walls,
                text.fixed_edge("base", [(0, 0), (1, 0)], "y"),
                text.fixed_edge("top", [(0, 1), (1, 1)], "y") + "displacement = [0, -0.01]\n",
                "[loading]\nuntil = 1.0\n[formulation.loading]\nincrement = 0.25\n",
                '[formulation.supports]\nmethod = "lagrange"\n',
            ],
        )

    def measure(self, run: "Run") -> Checks:
        found = run.stress.mean(axis=0) / 1e3
        exact = "one state in all of the soil"
        return {
            "stress along (kPa)": Check(float(found[1]), -529.27174, 1e-7, exact),
            "stress across (kPa)": Check(float(found[0]), -164.87691, 1e-7, exact),
            "same everywhere": Check(
                1 + float(np.ptp(run.stress, axis=0).max()) / 5e5,
                1.0,
                1e-6,
                "rounding of multipliers between cells",
            ),
            "at rest": holds(converged(run), "every increment is in equilibrium"),
        }
