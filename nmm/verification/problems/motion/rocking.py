"""A slender block that rocks on its two corners and loses energy at every impact."""

from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase, limit
from nmm.verification.reading import way
from nmm.verification.text import G

if TYPE_CHECKING:
    from nmm.stepping.run import Run

HALF_WIDTH, HALF_HEIGHT = 0.1, 0.4
SLENDER = float(np.arctan(HALF_WIDTH / HALF_HEIGHT))
TILT = SLENDER / 2


class Rocking(SceneCase):
    """A block is let go at half its angle of overturning and rocks on a rough floor."""

    name = "B15"
    title = "Rocking of a slender block"
    source = "Housner (1963): energy ratio (1 - 3/2 sin^2 alpha)^2; quarter period"
    formulations = ("rigid",)

    def scene(self) -> str:
        """Return the block standing tilted on its right lower corner."""
        upright = text.rectangle((-2 * HALF_WIDTH, 0), (0, 2 * HALF_HEIGHT))
        block = text.turned(upright, -TILT)
        return text.scene(
            'title = "Rocking block"\nplane = "strain"\nduration = 1.3\n[gravity]\n[inertia]\n'
            "[contact]\n[formulation.integrator]\nstep = 5e-4\n",
            [
                text.material("rock"),
                *text.floor(60.0),
                text.block("block", "rock", block),
                text.monitor("top", block[2], "block"),
            ],
        )

    def measure(self, run: "Run") -> Checks:
        h = run.history
        radius = np.hypot(HALF_WIDTH, HALF_HEIGHT)
        mass = 2600 * 4 * HALF_WIDTH * HALF_HEIGHT
        start = mass * G * radius * (np.cos(SLENDER - TILT) - np.cos(SLENDER))
        energy = start + h["kinetic_energy"] - h["external_work"]
        lean = way(run, "top")[:, 0] + 2 * HALF_HEIGHT * np.sin(TILT)
        upright = np.flatnonzero(np.diff(np.sign(lean)))
        # Between two impacts it turns back where it leans most.
        turns = [low + np.abs(lean[low:high]).argmax() for low, high in pairwise(upright)]
        levels = [start, *energy[turns]]
        expected = float(1 - 1.5 * np.sin(SLENDER) ** 2) ** 2
        frequency = np.sqrt(3 * G / (4 * radius))
        # Housner: theta = alpha - (alpha - theta_0) cosh(p t).
        quarter = float(np.arccosh(1 / (1 - TILT / SLENDER)) / frequency)
        checks = {
            "first impact (s)": Check(
                float(h["time"][upright[0]]), quarter, 0.02, "sin alpha = alpha within 1 %"
            ),
            "gain of energy": limit(float(energy.max() / start) - 1, 1e-9, "no gain"),
        }
        reason = "the benchmark's: hops of a corner take a share of a tenth"
        for number, (before, after) in enumerate(pairwise(levels)):
            checks[f"energy ratio at impact {number + 1}"] = Check(
                float(after / before), expected, 0.05, reason, scale=1.0
            )
        checks["turning points"] = Check(
            float(len(turns)), 2.0, 0.0, "between three of them in 1.3 s"
        )
        return checks
