"""Rubber that is blown up."""

from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase, holds
from nmm.verification.continuum import quarter
from nmm.verification.reading import converged, way

if TYPE_CHECKING:
    from nmm.stepping.run import Run


class BlownCylinder(SceneCase):
    """A thick cylinder of nearly incompressible rubber under inner pressure, a quarter of it.

    The pressure turns with the surface and grows with it.
    """

    name = "FK5"
    title = "Thick cylinder of rubber"
    source = "p = mu (ln(B a / (A b)) + (a^2 - A^2) / 2 (1 / a^2 - 1 / b^2)), b^2 = B^2 + a^2 - A^2"
    formulations = ("quads degree 2",)
    sides = 16
    widest = 1.5

    @staticmethod
    def pressure(inner: float) -> float:
        """Pressure over the shear modulus at an inner radius, from radii 1 and 2."""
        outer = np.sqrt(3 + inner**2)
        found = np.log(2 * inner / outer) + (inner**2 - 1) / 2 * (1 / inner**2 - 1 / outer**2)
        return float(found)

    def scene(self) -> str:
        """Return the quarter; a shear modulus of 1 and a Poisson ratio of 0.4999."""
        inner = quarter(1.0, self.sides)
        pushes = [
            f'[[loads]]\nname = "p{number}"\nkind = "pressure"\n'
            f"segment = [{start.tolist()}, {end.tolist()}]\n"
            f"pressure = {self.pressure(self.widest)!r}\n"
            for number, (start, end) in enumerate(pairwise(inner))
        ]
        return text.scene(
            'title = "Rubber"\nplane = "strain"\n[loading]\nuntil = 1.0\n',
            [
                '[materials.rubber]\nlaw = "neo_hookean"\n'
                f"young_modulus = {2 * 1.4999!r}\npoisson_ratio = 0.4999\n",
                text.block("ring", "rubber", np.concatenate([inner, 2 * inner[::-1]])),
                text.fixed_edge("x", [(0, 1), (0, 2)], "x"),
                text.fixed_edge("y", [(1, 0), (2, 0)], "y"),
                *pushes,
                text.monitor("inner", (1, 0), "ring"),
                "[formulation.loading]\nincrement = 0.25\n"
                '[formulation.rotation]\nupdate = "finite"\n',
            ],
        )

    def measure(self, run: "Run") -> Checks:
        checks: Checks = {}
        factors = run.history["load_factor"]
        for step in (0, len(factors) // 2, -1):
            radius = 1 + float(way(run, "inner")[step, 0])
            found = float(factors[step]) * self.pressure(self.widest)
            checks[f"p / mu of step {step % len(factors) + 1}"] = Check(
                found, self.pressure(radius), 1e-2, "a polygon for the circle; cells of a half"
            )
        checks["at rest"] = holds(converged(run), "every increment is in equilibrium")
        return checks
