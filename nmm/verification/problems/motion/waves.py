"""Waves: a bar that is pulled at one end."""

from typing import TYPE_CHECKING, ClassVar

import numpy as np

from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase
from nmm.verification.reading import way

if TYPE_CHECKING:
    from nmm.stepping.run import Run


class BarWave(SceneCase):
    """A traction at the end of a bar runs along it and doubles the displacement of its end.

    Behind the front the middle moves at ``sigma c / E``: where that line starts is the arrival.
    """

    name = "B16"
    title = "Wave in a bar of L = 10, E = rho = 1, pulled from t = 0"
    source = "d'Alembert: arrival x / c, u(L, 2 L / c) = 2 sigma L / E"
    formulations = ("finite elements", "manifold", "bilinear quads", "quads", "splines")
    length = 10.0
    stress = 1e-3
    cover: ClassVar = {"size": 0.2, "angle": 0.3}

    def scene(self) -> str:
        """Return the bar, held at its left end."""
        long, high = self.length, 0.5
        return text.scene(
            'title = "Wave in a bar"\nplane = "stress"\nduration = 20.0\n[inertia]\n'
            '[formulation.integrator]\ntype = "newmark"\nstep = 0.05\n',
            [
                text.material("soft", modulus=1.0, poisson=0.0, density=1.0),
                text.block("bar", "soft", text.rectangle((0, 0), (long, high))),
                text.fixed_edge("left", [[0, 0], [0, high]], "x"),
                text.fixed_point("pin", [0, 0], "y"),
                text.pulled_edge("pull", [[long, 0], [long, high]], [self.stress, 0]),
                text.monitor("middle", (long / 2, high / 2), "bar"),
                text.monitor("end", (long, high / 2), "bar"),
            ],
        )

    def measure(self, run: "Run") -> Checks:
        time, middle = run.history["time"], way(run, "middle")[:, 0]
        behind = (time > 0.7 * self.length) & (time < 1.2 * self.length)
        slope, start = np.polyfit(time[behind], middle[behind], 1)
        reason = "the benchmark's; a step of the traction rings on any mesh"
        peak = 2 * self.stress * self.length
        return {
            "arrival at the middle (s)": Check(-start / slope, self.length / 2, 0.02, reason),
            "speed behind the front (m/s)": Check(slope, self.stress, 0.02, reason),
            "displacement at 2 L / c (m)": Check(float(way(run, "end")[-1, 0]), peak, 0.02, reason),
        }
