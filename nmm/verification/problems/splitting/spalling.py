"""A pulse of pressure that comes back as tension, and what it breaks off a bar."""

from typing import TYPE_CHECKING, ClassVar

import numpy as np

from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase

if TYPE_CHECKING:
    from nmm.stepping.run import Run


class SpalledBar(SceneCase):
    """A bar of one body is struck at its left end for 1 s; it splits where its tension is largest.

    The pulse of 2 mPa turns into tension at the free end. Front and tail meet half a pulse before
    it: there alone the bar is stretched first, at once beyond its strength.
    """

    name = "SP3"
    title = "A pulse that comes back from a free end breaks off half its length"
    source = "d'Alembert: c tau / 2 from the end, which flies off with 2 s0 / (rho c)"
    formulations = ("bilinear quads", "finite elements")
    long = 4.0
    high = 0.1
    pressure = 2e-3
    cover: ClassVar = {"size": 0.025}

    def scene(self) -> str:
        """Return the bar with E = rho = 1, free but for its load."""
        return text.scene(
            'title = "bar"\nplane = "stress"\nduration = 6.5\n[inertia]\n[contact]\n'
            '[formulation.integrator]\ntype = "newmark"\nstep = 0.02\n',
            [
                text.material("unit", modulus=1.0, poisson=0.0, density=1.0),
                text.interface("contact", 0.0),
                text.box("bar", (0, 0), (self.long, self.high), "unit"),
                f"[splitting.unit]\ntensile_strength = {0.75 * self.pressure}\n"
                'smallest_block = 0.05\nmost_blocks = 2\njudged_at = "elements"\n',
                text.pulled_edge("blow", [[0, 0], [0, self.high]], [self.pressure, 0])
                + "history = [[0, 0], [0.1, 1], [1, 1], [1.1, 0]]\n",
                text.monitor("near", (0.02, self.high / 2), "bar"),
                text.monitor("end", (self.long - 0.25, self.high / 2), "bar"),
            ],
        )

    def measure(self, run: "Run") -> Checks:
        """Compare when and where the bar breaks, how fast the spall is, and its impulse.

        A pulse that rises and falls evenly over 0.1 s makes a tension of three quarters of it
        1.175 / 2 s after its front has met the end, 0.4875 to 0.5125 m before it. Ahead of that is
        0.9609 of its impulse: what both waves move there.
        """
        areas = np.sort(run.manifold.body_area)
        time, way = run.history["time"], run.history["monitor:end:ux"]
        ends = np.interp([5.4, 6.4], time, way)  # one period of the ringing of the spall
        speed, spall = float(ends[1] - ends[0]), float(areas[0]) / self.high
        whole = run.history["splitting:bodies"] == 1
        taken = 0.9609 * self.pressure
        return {
            "pieces": Check(float(len(areas)), 2.0, 0.0, "one break takes all tension away"),
            "broken at (s)": Check(
                float(time[whole][-1]), self.long + 1.175 / 2, 0.01, "two steps, and dispersion"
            ),
            "break from the free end (m)": Check(spall, 0.5, 0.03, "0.0125 m, and a cell"),
            "speed of the spall (m/s)": Check(speed, taken / 0.5, 0.03, "the benchmark's"),
            "impulse of the spall (N s)": Check(
                speed * spall * self.high, taken * self.high, 0.05, "place and speed together"
            ),
        }
