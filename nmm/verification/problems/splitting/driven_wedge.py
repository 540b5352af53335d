"""A wedge driven between two blocks: slowly with friction, and by a blow without."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar, Self

import numpy as np

from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase, limit
from nmm.verification.reading import rates

if TYPE_CHECKING:
    from nmm.stepping.run import Run


def wedge(half_angle: float, wide: float) -> list[str]:
    """Tables of a wedge and two blocks whose flanks lie within its own, y from 0 to 1.

    Parameters
    ----------
    half_angle
        degrees.
    wide
        Width of each block at half height (m).
    """
    slope = float(np.tan(np.radians(half_angle)))
    tip, top = -0.25, 1.25
    foot, head = (slope * (y + 0.5) for y in (tip, top))
    low, high = (slope * (y + 0.5) for y in (0.0, 1.0))
    out = slope + wide
    right = np.array([(low, 0.0), (out, 0.0), (out, 1.0), (high, 1.0)])
    return [
        text.block("wedge", "steel", [(-foot, tip), (foot, tip), (head, top), (-head, top)]),
        text.block("right", "stuff", right),
        text.block("left", "stuff", right[::-1] * [-1, 1]),
    ]


@dataclass(frozen=True)
class SplittingWedge(SceneCase):
    """A wedge is pressed between two blocks that give way aside; it slides on both flanks."""

    name = "SP4"
    title = "Wedge pressed between two blocks, with friction"
    source = "N / V = 1 / (2 (sin a + mu cos a)), H / V = N / V (cos a - mu sin a)"
    formulations = ("dda", "augmented", "finite elements", "quads")
    half_angle: float = 15.0
    friction: float = 0.3
    force = 1e5
    label = "half angle {0.half_angle:g} degrees, mu = {0.friction:g}"

    @classmethod
    def variants(cls) -> Sequence[Self]:
        """Return the benchmark's two, and a blunter wedge with more friction."""
        return [cls(friction=0.0), cls(), cls(30.0, 0.5)]

    def scene(self) -> str:
        """Return the blocks on smooth floors, each before a smooth wall."""
        out = float(np.tan(np.radians(self.half_angle))) + 1.0
        return text.scene(
            'title = "Wedge"\nplane = "stress"\n[contact]\n[loading]\nuntil = 1.0\n'
            "[formulation.loading]\nincrement = 0.1\n",
            [
                text.material("steel", modulus=1e9, poisson=0.0, density=None),
                text.material("stuff", modulus=1e9, poisson=0.0, density=None),
                text.interface("flank", float(np.degrees(np.arctan(self.friction)))),
                *wedge(self.half_angle, 1.0),
                *(
                    f'[[supports]]\nname = "{name} {side}"\nsegment = {line}\n'
                    f'block = "{side}"\nfix = ["{axis}"]\n'
                    for side, sign in (("right", 1), ("left", -1))
                    for name, axis, line in (
                        ("wall", "x", [[sign * out, 0.0], [sign * out, 1.0]]),
                        ("floor", "y", [[sign * (out - 1), 0.0], [sign * out, 0.0]]),
                    )
                ),
                f'[[loads]]\nname = "push"\nkind = "point"\npoint = [0, 1.25]\nblock = "wedge"\n'
                f"force = [0, {-self.force!r}]\n",
                text.monitor("head", (0.0, 1.25), "wedge"),
            ],
        )

    def measure(self, run: "Run") -> Checks:
        a, history = np.radians(self.half_angle), run.history
        row = {
            one: np.array([history[f"reaction:{one} right:{axis}"][-1] for axis in "xy"])
            for one in ("wall", "floor")
        }
        on_block = (row["wall"] + row["floor"]) / self.force
        side, down = float(abs(on_block[0])), float(on_block[1])
        share = 1 / (2 * (np.sin(a) + self.friction * np.cos(a)))
        reason = "flanks turn by 1e-4, and contact gives way a little before it slides"
        return {
            "thrust on a wall over the push": Check(
                side, float(share * (np.cos(a) - self.friction * np.sin(a))), 1e-3, reason
            ),
            "pressure of a flank over the push": Check(
                float(side * np.cos(a) + down * np.sin(a)), float(share), 1e-3, reason
            ),
            "push that the floors carry": Check(2 * down, 1.0, 1e-4, "blocks move by 1e-4"),
        }


@dataclass(frozen=True)
class StruckApart(SceneCase):
    """A wedge flies between two blocks at rest and drives them apart; nothing rubs."""

    name = "SP4 blow"
    title = "Wedge that strikes two blocks apart, without friction"
    source = "J = (1 + e) v sin a / (2 sin^2 a / M + cos^2 a / m) on each flank"
    formulations = ("rigid",)
    half_angle = 20.0
    mass = 10.0
    speed = 4.0
    steps: int = 100
    parameters: ClassVar = {"steps": (100, 400)}
    label = "{0.steps} steps"

    def scene(self) -> str:
        """Return the three in touch, the blocks on smooth floors."""
        slope = float(np.tan(np.radians(self.half_angle)))
        return text.scene(
            f'title = "Blow"\nplane = "stress"\nduration = 0.02\n[inertia]\n[contact]\n'
            '[formulation.contact]\nenforcement = "lagrange"\n'
            f"[formulation.integrator]\nstep = {0.02 / self.steps!r}\n",
            [
                text.material("steel", modulus=1e9, poisson=0.0, density=self.mass / (3 * slope)),
                text.material("stuff", modulus=1e9, poisson=0.0, density=self.mass / 2),
                text.interface("flank", 0.0),
                *wedge(self.half_angle, 1.0),
                *(
                    f'[[supports]]\nname = "floor {side}"\nblock = "{side}"\nfix = ["y"]\n'
                    f"segment = {[[sign * slope, 0.0], [sign * (slope + 1), 0.0]]}\n"
                    for side, sign in (("right", 1), ("left", -1))
                ),
                f'[[initial_velocities]]\nblock = "wedge"\nvelocity = [0, {-self.speed!r}]\n',
                text.monitor("wedge", (0.0, 1.25), "wedge"),
            ],
        )

    def measure(self, run: "Run") -> Checks:
        a, (fall, right, left) = np.radians(self.half_angle), rates(run)[:, :2]
        across, along = np.cos(a), np.sin(a)
        inertia = 2 * along**2 / self.mass + 2 * across**2 / self.mass
        impulse = 2 * self.speed * along / inertia
        energy = self.mass * self.speed**2 / 2
        reason = "springs of the floors take 5e-6 of the energy"
        return {
            "impulse of a flank (N s)": Check(
                float(self.mass * (fall[1] + self.speed) / (2 * along)), impulse, 1e-3, reason
            ),
            "speed of the wedge (m/s)": Check(
                float(-fall[1]), self.speed - 2 * impulse * along / self.mass, 1e-3, reason
            ),
            "speed of the blocks (m/s)": Check(
                float(right[0] - left[0]) / 2, 2 * impulse * across / self.mass, 1e-3, reason
            ),
            "sideways momentum, of that of a block": limit(
                float(abs(right[0] + left[0]) / right[0]), 1e-9, "mirrored"
            ),
            "energy (J)": Check(float(run.history["kinetic_energy"][-1]), energy, 1e-4, reason),
        }
