"""Water that seeps under a sheet pile."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase, limit

if TYPE_CHECKING:
    from nmm.formulation import Formulation
    from nmm.scene import Scene
    from nmm.stepping.run import Run

CONDUCTIVITY, DIFFERENCE = 1e-4, 3.0
DEPTH, LENGTH = 4.0, 24.0


@dataclass(frozen=True)
class SheetPile(SceneCase):
    """A tight wall reaches part of the way down into a layer on tight ground; water goes round.

    The wall is a crack without leakage, whose tip takes the root of the distance. The layer is six
    times as long as deep, which changes the flow by less than 1e-6.
    """

    name = "WA16"
    title = "Seepage under a sheet pile"
    source = "conformal map: q = k h K'(m) / 2 K(m), m = sin(pi s / 2 T)"
    formulations = ("quads", "manifold")
    reach: float = 2.0
    parameters: ClassVar = {"reach": (1.0, 2.0, 3.0)}
    label = "{0.reach:g} m deep"

    def scene(self) -> str:
        """Return the layer, which is held, with water on both sides of the wall."""
        middle, top = LENGTH / 2, DEPTH
        return text.scene(
            'title = "Sheet pile"\nplane = "strain"\n',
            [
                "[materials.sand]\nyoung_modulus = 1e8\npoisson_ratio = 0.3\n"
                f"hydraulic_conductivity = {CONDUCTIVITY}\n",
                text.block("layer", "sand", text.rectangle((0, 0), (LENGTH, DEPTH))),
                '[[cracks]]\nname = "wall"\n'
                f"points = [[{middle}, {top}], [{middle}, {top - self.reach}]]\n",
                text.fixed_block("layer"),
                "[seepage]\n",
                f'[[heads]]\nname = "up"\nsegment = [[0, {top}], [{middle}, {top}]]\n'
                f"head = {top + DIFFERENCE}\n",
                f'[[heads]]\nname = "down"\nsegment = [[{middle}, {top}], [{LENGTH}, {top}]]\n'
                f"head = {top}\n",
            ],
        )

    def formulation(self, scene: "Scene", name: str) -> "Formulation":
        """Return cells of an eighth of the depth that the wall cuts."""
        found = super().formulation(scene, name)
        cover = found.cover.model_copy(update={"size": 0.53})
        return found.model_copy(update={"cover": cover})

    def measure(self, run: "Run") -> Checks:
        from scipy.special import ellipk

        m = float(np.sin(np.pi * self.reach / (2 * DEPTH)) ** 2)
        exact = CONDUCTIVITY * DIFFERENCE * float(ellipk(1 - m) / (2 * ellipk(m)))
        come, gone = (float(run.history[f"seepage:taken:{side}"][-1]) for side in ("up", "down"))
        cells = "cells of an eighth of the depth"
        return {
            "flow (m2/s)": Check(come, exact, 1e-3, cells),
            "lost of it": limit(abs(come + gone) / exact, 1e-9, "balance of volume"),
        }
