"""Factors of safety by strength reduction: a slope of soil."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from nmm.formulation import Formulation
from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase, holds

if TYPE_CHECKING:
    from nmm.scene import Scene
    from nmm.stepping.run import Run

WEIGHT = 20e3
"""Of soil (N/m3)."""


@dataclass(frozen=True)
class SoilSlope(SceneCase):
    """A slope 2 to 1 on firm ground: phi = 20, c / (gamma H) = 0.05, no dilation.

    A factor fails where no equilibrium is found under the weight; matter then flows with less than
    a hundredth of its elastic stiffness. Tension is limited by the apex alone.
    """

    name: ClassVar[str] = "PL5"
    title: ClassVar[str] = "Slope of soil: strength reduction"
    source: ClassVar[str] = (
        "Griffiths and Lane 1999 (1.4), Bishop and Morgenstern (1.380), log-spiral upper bound for "
        "associated flow 1.3978"
    )
    formulations: ClassVar[tuple[str, ...]] = ("quads degree 2",)

    @property
    def slow(self) -> bool:
        """Half a minute."""
        return True

    def formulation(self, scene: "Scene", name: str) -> Formulation:
        """Return cells of an eighth of the height."""
        found = super().formulation(scene, name)
        return found.model_copy(update={"cover": found.cover.model_copy(update={"size": 1.25})})

    def scene(self) -> str:
        """Return the slope, 10 m high, its crest 22 m wide."""
        return text.scene(
            'title = "Slope of soil"\nplane = "strain"\n',
            [
                '[materials.soil]\nlaw = "mohr_coulomb"\nyoung_modulus = 1e8\n'
                f"poisson_ratio = 0.3\ndensity = {WEIGHT / 9.81!r}\ncohesion = 1e4\n"
                'friction_angle = "20 deg"\n',
                text.block("slope", "soil", [(0, 0), (42, 0), (42, 10), (20, 10)]),
                '[[supports]]\nname = "base"\nsegment = [[0, 0], [42, 0]]\nfix = ["x", "y"]\n',
                '[[supports]]\nname = "far"\nsegment = [[42, 0], [42, 10]]\nfix = ["x"]\n',
                "[gravity]\n[strength_reduction]\nlowest = 0.8\nhighest = 2.0\n",
            ],
        )

    def measure(self, run: "Run") -> Checks:
        """Compare the factor with the band of the published ones."""
        low, high = run.summary.factor_of_safety or np.nan, run.summary.factor_that_fails or np.nan
        band = "1.34 to 1.40 hold limit analyses and finite elements"
        return {
            "factor of safety": Check((low + high) / 2, 1.37, 0.03 / 1.37, band),
            "width of the bracket": Check(high - low, 0.01, 0.0, "as asked", bound="at_most"),
            "failing is the structure's": holds(
                run.summary.status == "converged", "matter is shown to flow"
            ),
        }
