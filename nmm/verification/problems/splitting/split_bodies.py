"""Blocks that split, against bars and discs cut where they would."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase, holds
from nmm.verification.formulations import with_cover
from nmm.verification.problems.splitting.split_columns import (
    CRUSHED,
    PHI,
    TENSILE,
    apart,
    first_split,
    inner_faces,
    strength,
)

if TYPE_CHECKING:
    from nmm.formulation import Formulation
    from nmm.scene import Scene
    from nmm.stepping.run import Run


class CutBar(SceneCase):
    """A bar under even tension, held at its ends, splits in the middle; its faces fly apart."""

    name = "SP2"
    title = "A stretched bar splits in the middle and closes again"
    source = "d'Alembert: gap 2 s0 c t / E, 4 s0 L / E at 2 L / c, 0 at 4 L / c"
    formulations = ("bilinear quads", "finite elements")
    stress = 1e-3
    step = 0.02
    cover: ClassVar = {"size": 0.05}

    def scene(self) -> str:
        """Return a bar of 2 m with E = rho = 1, whose strength is just below its stress."""
        return text.scene(
            f'title = "bar"\nplane = "stress"\nduration = 4.5\n[inertia]\n[contact]\n'
            f'[formulation.integrator]\ntype = "newmark"\nstep = {self.step}\n',
            [
                text.material("unit", modulus=1.0, poisson=0.0, density=1.0),
                text.interface("contact", 0.0),
                text.box("bar", (0, 0), (2, 0.1), "unit"),
                f"[splitting.unit]\ntensile_strength = {0.999 * self.stress}\n"
                "smallest_block = 0.05\nmost_blocks = 2\n",
                f'[[initial_stresses]]\nblock = "bar"\nstress = [{self.stress}, 0, 0]\n',
                text.fixed_edge("left", [[0, 0], [0, 0.1]]),
                text.fixed_edge("right", [[2, 0], [2, 0.1]]),
                text.monitor("one", (0.9999, 0.05), "bar"),
                text.monitor("other", (1.0001, 0.05), "bar"),
            ],
        )

    def measure(self, run: "Run") -> Checks:
        history = run.history
        gap = history["monitor:other:ux"] - history["monitor:one:ux"]
        time = history["time"] - self.step  # it splits at the end of the first step
        unit = 2 * self.stress
        late = np.flatnonzero(time > 3.0)
        parts = ("kinetic", "strain", "contact", "support")
        energy = np.sum([history[f"{name}_energy"] for name in parts], axis=0)
        front = "a front is as wide as a few cells"
        return {
            "gap at 1 s (mm)": Check(
                1e3 * float(np.interp(1.0, time, gap)), 1e3 * unit, 0.02, front
            ),
            "largest gap (mm)": Check(1e3 * float(gap.max()), 2e3 * unit, 0.03, front),
            "closed at (s)": Check(float(time[late[gap[late].argmin()]]), 4.0, 0.02, front),
            "energy kept": holds(
                abs(float(energy[-1]) / float(energy[0]) - 1) < 0.01, "Newmark conserves it"
            ),
        }


@dataclass(frozen=True)
class SplitDisc(SceneCase):
    """A disc of one body between two forces splits along the line between them."""

    shear: bool = False
    name = "SP5"
    title = "The Brazilian test of a disc that splits"
    source = "sx = 2 P / (pi D t), sy = -6 P / (pi D t) in the middle"
    formulations = ("bilinear quads", "finite elements")
    size = 0.1
    # A cut-off alone, and with the envelope, which is nearer.
    parameters: ClassVar = {"shear": (False, True)}
    slow = True

    @property
    def variant(self) -> str:
        return "with shear" if self.shear else "by tension alone"

    def scene(self) -> str:
        """Return a disc of 0.1 m, 0.1 m thick, pressed at two corners of its 72."""
        angle = np.pi * (2 * np.arange(72) / 72 - 0.5)
        r = self.size / 2
        ring = r * np.column_stack([np.cos(angle), np.sin(angle)])
        return text.scene(
            'title = "disc"\nplane = "stress"\nthickness = 0.1\n[contact]\n[loading]\n'
            'until = "failure"\n[formulation.loading]\nincrement = 2.0\ntolerance = 1e-3\n',
            [
                text.material("concrete", modulus=27.5e9),
                text.interface("contact", 20.0),
                text.block("disc", "concrete", ring),
                strength("concrete", 5e-3, "most_blocks = 4\n", self.shear),
                text.fixed_point("foot", [0, -r]),
                text.fixed_point("top", [0, r], "x"),
                f'[[loads]]\nname = "press"\nkind = "point"\npoint = [0, {r}]\n'
                "force = [0, -1000]\n",
            ],
        )

    def formulation(self, scene: "Scene", name: str) -> "Formulation":
        """Return cells of a fortieth of the diameter, laid so that the middle lies within one."""
        return with_cover(super().formulation(scene, name), size=self.size / 40, shift=(0.2, 0.3))

    def measure(self, run: "Run") -> Checks:
        area = np.pi * self.size * 0.1 / 2
        steep = np.tan(np.radians(45 + PHI / 2)) ** 2
        limit = float(CRUSHED / (3 + steep)) if self.shear else TENSILE
        checks = {
            "load of the first split (kN)": Check(
                first_split(run, "load_factor"), limit * area / 1e3, 0.02, "72 corners, 40 cells"
            )
        }
        if not self.shear:
            off = apart(inner_faces(run)[:4], 90.0)
            checks["plane off the line of forces (deg)"] = Check(
                1 + off, 1.0, 0.1, "the net does not lie evenly about the middle"
            )
        return checks
