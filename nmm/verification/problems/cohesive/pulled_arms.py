"""A double cantilever beam that a cohesive plane holds together, its arms pulled apart."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Self

import numpy as np

from nmm.verification import text
from nmm.verification.base import Check, Checks, holds, limit
from nmm.verification.problems.cohesive.double_cantilever import (
    ARM,
    ENERGY,
    MODULUS,
    MOUTH,
    THICK,
    BentApart,
    opening,
    quadratic,
)
from nmm.verification.problems.cracks.crack_scenes import crack

if TYPE_CHECKING:
    from nmm.stepping.run import Run

# Length of the notch and of the beam (m).
NOTCH, LENGTH = 8 * ARM, 16 * ARM
# P^2 times the opening of the ends (N^2 m) where a sharp crack grows, whatever its length.
CONSTANT = float(8 * (ENERGY * MODULUS * ARM**3 / 12) ** 1.5 / (MODULUS * ARM**3) * THICK**2)


@dataclass(frozen=True)
class PulledApart(BentApart):
    """Load and opening of the ends once the notch has opened by the width of the crack.

    The opening at the tip of the notch leads: that of the ends goes back a little as the front
    passes from cell to cell.
    """

    name = "CO2"
    title = "Double cantilever beam under end forces with a cohesive crack"
    source = "Griffith's crack (GR2): P^2 D is constant, whatever the length"
    strength: float = 3e6
    size: float = 0.025

    @classmethod
    def variants(cls) -> Sequence[Self]:
        """Return two strengths; the stronger has the shorter process zone."""
        return [cls(), cls(5e6, 0.02)]

    @property
    def variant(self) -> str:
        return f"{self.strength / 1e6:g} MPa"

    @property
    def width(self) -> float:
        """Opening (m) at which nothing holds the faces any more."""
        return 2 * ENERGY / self.strength

    def scene(self) -> str:
        """Return the beam, driven by the opening at the tip of the notch."""
        half, traction = MOUTH / 2, 1e5
        outline = [(0, -ARM), (LENGTH, -ARM), (LENGTH, ARM), (0, ARM)]
        outline += [(0, half), (NOTCH, 0), (0, -half)]
        bond = {
            "cohesion": 30e6,
            "tensile_strength": self.strength,
            "bonded": True,
            "fracture_energy": ENERGY,
        }
        return text.scene(
            'title = "Arms pulled apart"\nplane = "stress"\nthickness = 0.1\n[contact]\n'
            '[loading]\nuntil = "failure"\n[loading.control]\ntype = "opening"\nfall = 0.0\n'
            'direction = [0, 1]\nmonitors = ["up", "down"]\n'
            f"increment = {self.width / 10}\nend = {3 * self.width}\n",
            [
                text.material("concrete", modulus=MODULUS, poisson=0.2, density=None),
                text.interface("crack", 30.0, more=bond) + 'law = "linear_softening"\n',
                text.block("beam", "concrete", np.array(outline)),
                crack("plane", [[NOTCH, 0.0], [LENGTH + 0.01, 0.0]]) + "bonded = true\n",
                text.fixed_point("one", [LENGTH, -ARM]),
                text.fixed_point("other", [LENGTH, ARM], "x"),
                text.pulled_edge("upper", [[0.0, half], [0.0, ARM]], [0.0, traction]),
                text.pulled_edge("lower", [[0.0, -ARM], [0.0, -half]], [0.0, -traction]),
                text.monitor("up", (NOTCH, 1e-4), "beam"),
                text.monitor("down", (NOTCH, -1e-4), "beam"),
                text.monitor("upper end", (0.0, ARM / 2), "beam"),
                text.monitor("lower end", (0.0, -ARM / 2), "beam"),
                quadratic("triangles", self.size, 17.0),
            ],
        )

    def measure(self, run: "Run") -> Checks:
        history, runs = run.history, opening(run) >= self.width
        load = 1e5 * THICK * (ARM - MOUTH / 2) * history["load_factor"]
        ends = history["monitor:upper end:uy"] - history["monitor:lower end:uy"]
        ratio = (load * np.sqrt(ends / CONSTANT))[runs]
        return {
            "load over Griffith's at the opening, mean": Check(
                float(ratio.mean()), 1.0, 0.01, "a third of the benchmark's 3 %"
            ),
            "load at the opening, largest error": limit(
                float(np.abs(ratio - 1).max()), 0.03, "the benchmark's"
            ),
            "three widths are followed": holds(
                bool(opening(run)[-1] >= 3 * self.width * (1 - 1e-6)), "the end of the path"
            ),
            "energy made or lost, share": limit(
                abs(run.summary.energy_balance or 0.0), 1e-3, "steps of a tenth of the width"
            ),
        }
