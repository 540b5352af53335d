"""How one block on a slope begins to move: it slides, topples, does both, or rests."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Self

import numpy as np

from integration.arrays import Floats
from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase, limit
from nmm.verification.problems.contact.incline import acceleration, down, on_slope
from nmm.verification.reading import last_way
from nmm.verification.text import G

if TYPE_CHECKING:
    from nmm.stepping.run import Run

STEP, DURATION = 1e-3, 0.1


@dataclass(frozen=True)
class BlockOnSlope(SceneCase):
    """A block of width b and height h on a slope, friction to either side of each limit."""

    name = "B6"
    title = "Modes of a block on a slope"
    source = "Balance of the block that turns about its toe, with and without slip"
    formulations = ("rigid",)
    slope: float = 30.0
    width: float = 0.25
    friction: float = 30.5
    mode: str = "topples"
    label = "{0.slope:g} degrees, b/h {0.width:g}, phi {0.friction:g}: {0.mode}"

    @classmethod
    def variants(cls) -> Sequence[Self]:
        """Return the four modes, half a degree and more from the limits."""
        limits = {(20, 0.2): 13.4982, (30, 0.25): 18.1268, (30, 0.5): 27.4248, (40, 0.5): 29.9827}
        found = [cls(30.0, 0.7, 31.0, "rests"), cls(30.0, 0.7, 25.0, "slides")]
        for (slope, width), phi in limits.items():
            found.append(cls(float(slope), width, round(phi + 0.5, 4), "topples"))
            found.append(cls(float(slope), width, round(phi - 0.5, 4), "slides and topples"))
        return found

    def scene(self) -> str:
        """Return a block of 1 m height on a held base."""
        return text.scene(
            f'title = "Block on a slope"\nplane = "strain"\nduration = {DURATION!r}\n'
            f"[gravity]\n[inertia]\n[contact]\n[formulation.integrator]\nstep = {STEP!r}\n",
            [
                text.material("rock"),
                text.interface("slope", self.friction),
                text.block("base", "rock", on_slope(self.slope, (0, -1), (4, 0))),
                text.block("block", "rock", on_slope(self.slope, (2, 0), (2 + self.width, 1))),
                text.fixed_block("base"),
                text.monitor("toe", on_slope(self.slope, (2, 0), (3, 1))[0], "block"),
            ],
        )

    def measure(self, run: "Run") -> Checks:
        slip = float(last_way(run, "toe") @ down(self.slope))
        turn = float(run.state.frames.angle[1])
        started = "contacts settle under the sudden weight: rates of 3e-4 rad/s, 3e-4 m/s"
        still = "springs give way by 1e-7 m"
        found = {}
        for name, value, way in zip(
            ("slip (m)", "turn"), (slip, turn), self.expected(), strict=True
        ):
            found[name] = (
                Check(value, way, 0.01, started) if way else limit(abs(value), 1e-6, still)
            )
        return found

    def expected(self) -> tuple[float, float]:
        """Slip of the toe down the slope (m) and turn (rad) at the end of the run."""
        if self.mode == "rests":
            return 0.0, 0.0
        if self.mode == "slides":
            return acceleration(self.slope, self.friction) * DURATION**2 / 2, 0.0
        x, turn = self._integrated()
        if self.mode == "topples":
            return 0.0, turn
        b = self.width
        return float(x + (b * np.cos(turn) - np.sin(turn)) / 2 - b / 2), turn

    def _integrated(self) -> tuple[float, float]:
        """Way of the centre down the slope and turn: the equations of motion by Runge and Kutta.

        The centre lies ``x`` up the slope from the toe and ``z`` above it. A toe that slips carries
        ``N = m (g cos a + z'')`` and ``N tan phi``; one that does not is a hinge.
        """
        a, b = np.radians(self.slope), self.width
        friction, slips = np.tan(np.radians(self.friction)), self.mode != "topples"
        inertia = (b**2 + 1) / 12

        def rates(state: Floats) -> Floats:
            _, turn, speed, spin = state
            x = (b * np.cos(turn) - np.sin(turn)) / 2
            z = (np.cos(turn) + b * np.sin(turn)) / 2
            if not slips:
                spun = G * (np.sin(a) * z - np.cos(a) * x) / (inertia + x**2 + z**2)
                return np.array([speed, spin, 0.0, spun])
            arm, free = friction * z - x, G * np.cos(a) - z * spin**2
            spun = free * arm / (inertia - x * arm)
            pushed = free + x * spun
            return np.array([speed, spin, G * np.sin(a) - friction * pushed, spun])

        state, step = np.zeros(4), DURATION / 100
        for _ in range(100):
            k1 = rates(state)
            k2 = rates(state + step / 2 * k1)
            k3 = rates(state + step / 2 * k2)
            k4 = rates(state + step * k3)
            state = state + step / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        return float(state[0]), float(state[1])
