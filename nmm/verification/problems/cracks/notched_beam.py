"""A notched concrete beam with a cohesive plane."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase, limit
from nmm.verification.formulations import with_cover

if TYPE_CHECKING:
    from nmm.formulation import Formulation
    from nmm.scene import Scene
    from nmm.stepping.run import Run


@dataclass(frozen=True)
class NotchedBeam(SceneCase):
    """The middle of a notched beam is pushed down; a cohesive plane over the notch softens.

    The way is prescribed, not the load: a load has no equilibrium past its peak.
    """

    name = "C5"
    title = "Notched beam of Petersson, span 2 m, with a cohesive plane"
    source = "Graded finite elements of degree 4 with the same plane"
    formulations = ("bilinear quads",)
    peaks: ClassVar[dict[str, float]] = {"linear": 853.0, "bilinear": 753.5}
    size = 0.0125
    way = 6e-4
    mouth = 1e-6
    softening: str = "linear"
    parameters: ClassVar = {"softening": peaks}
    label = "{0.softening} softening"
    slow = True

    def scene(self) -> str:
        """Return both halves of the beam, bonded over the notch, which opens by a hair."""
        plane = {
            "cohesion": 30e6,
            "tensile_strength": 3.33e6,
            "bonded": True,
            "fracture_energy": 124.0,
            "normal_stiffness": 1e14,
        }
        left = np.array([(-1.0, 0.0), (-self.mouth, 0.0), (0.0, 0.1), (0.0, 0.2), (-1.0, 0.2)])
        law = f'law = "{self.softening}_softening"\n'
        return text.scene(
            'title = "Notched beam"\nplane = "stress"\nthickness = 0.05\n[contact]\n'
            "[loading]\nuntil = 1\n[formulation.loading]\nincrement = 0.05\ntolerance = 1e-3\n"
            '[formulation.contact]\njoint_points = "gauss"\n',
            [
                text.material("concrete", modulus=30e9, poisson=0.2, density=None),
                text.interface("crack", 35.0, more=plane) + law,
                text.block("left", "concrete", left),
                text.block("right", "concrete", left[::-1] * [-1, 1]),
                text.fixed_point("pin", [-1, 0]),
                text.fixed_point("roller", [1, 0], "y"),
                text.fixed_point("push", [0, 0.2], "y") + f"displacement = [0, {-self.way!r}]\n",
            ],
        )

    def formulation(self, scene: "Scene", name: str) -> "Formulation":
        """Return squares of 12.5 mm, sixteen over the height."""
        return with_cover(super().formulation(scene, name), size=self.size)

    def measure(self, run: "Run") -> Checks:
        load = -run.history["reaction:push:y"]
        reason = "the benchmark's; squares of 12.5 mm are 1 % too stiff"
        passed = "the largest load is a peak: at the end the load is a twentieth below it"
        peak = float(load.max())
        return {
            "largest load (N)": Check(peak, self.peaks[self.softening], 0.02, reason),
            "load at the end over it": limit(float(load[-1]) / peak, 0.95, passed),
        }
