"""Cracks in motion: intensities behind a wave, and growth that does not hang on how it is laid."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from nmm.verification import text
from nmm.verification.base import Checks, SceneCase, limit
from nmm.verification.problems.cracks.crack_scenes import crack, net, pinned, pull

if TYPE_CHECKING:
    from nmm.stepping.run import Run


class StruckCrack(SceneCase):
    """A wave of tension comes upon a crack: its intensity rises with the root of time."""

    name = "GR12"
    title = "Long crack under a wave of tension, intensity in time"
    source = (
        "K_I = 2 s / (1 - nu) sqrt(c_d t (1 - 2 nu) / pi) for a semi-infinite crack, t from the "
        "arrival of the wave (Freund 1990, 2.5)"
    )
    formulations = ("dda",)
    modulus = 210e9
    poisson = 0.3
    density = 8000.0
    stress = 500e6
    height = 2.0
    slow = True

    @property
    def fast(self) -> float:
        """Speed of waves of pressure (m/s)."""
        nu = self.poisson
        stiff = self.modulus * (1 - nu) / ((1 + nu) * (1 - 2 * nu))
        return float(np.sqrt(stiff / self.density))

    @property
    def arrival(self) -> float:
        """When the wave arrives (s)."""
        return self.height / self.fast

    def scene(self) -> str:
        """Return a plate of ten by four, cracked half way, that is pulled all at once."""
        h = self.height
        motion = f'[formulation.integrator]\ntype = "newmark"\nstep = {self.arrival / 40!r}\n'
        tables: Sequence[str] = [
            text.material("m", self.modulus, self.poisson, self.density),
            text.block("plate", "m", text.rectangle((-5.0, -h), (5.0, h))),
            crack("c", [[-5.0, 0.0], [0.0, 0.0]]),
            pull("up", [[-5.0, h], [5.0, h]], [0.0, self.stress]),
            pinned("left", [-5.0, -h], "x", "y"),
            pinned("right", [5.0, -h], "y"),
            "[inertia]\n",
            "[fracture]\ntoughness = 1e12\nincrement = 1.0\n",
            net(0.2, 11.0),
            motion,
        ]
        return text.scene(f'plane = "strain"\nduration = {2.5 * self.arrival!r}', tables)

    def measure(self, run: "Run") -> Checks:
        time = run.history["time"] - self.arrival
        found = run.history["fracture:c:end:K_I"]
        nu = self.poisson
        root = np.sqrt(self.fast * np.maximum(time, 0.0) * (1 - 2 * nu) / np.pi)
        expected = 2 * self.stress / (1 - nu) * root
        late = (time > 0.4 * self.arrival) & (time < 1.4 * self.arrival)
        early = time < -0.2 * self.arrival
        unit = float(expected[late].max())
        return {
            "largest error once the wave is past": limit(
                float(np.abs(found / np.maximum(expected, 1e-300) - 1)[late].max()),
                0.05,
                "cells of a tenth of the way that the wave has come",
            ),
            "intensity before it arrives": limit(
                float(np.abs(found[early]).max()) / unit, 0.03, "what a sharp front leaves"
            ),
        }
