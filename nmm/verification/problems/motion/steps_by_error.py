"""Steps chosen by their error: what a run errs by against what was asked for."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar, Self

import numpy as np

from nmm.verification import text
from nmm.verification.base import Case, Check, Checks, SceneCase
from nmm.verification.problems.motion.time_integration import FREQUENCY, oscillator
from nmm.verification.reading import rates

if TYPE_CHECKING:
    from nmm.stepping.run import Run

CYCLES = 5.03
ASKED = (0.1, 0.03, 0.01)


@dataclass(frozen=True)
class ErrorAsked(Case):
    """Error of an oscillator over its amplitude, a cycle, for three errors that were asked for."""

    name = "B9 error"
    title = "Steps chosen by an error"
    source = "u = (v / omega) sin(omega t)"
    formulations = ("rigid",)
    integrator: str = "newmark"
    # Integrators of order 2 and 1.
    parameters: ClassVar = {"integrator": ("newmark", "generalized_alpha", "shi")}
    label = "{0.integrator}"

    def checks(self, formulation: str) -> Checks:
        found = [self._error(error) for error in ASKED]
        slope = float(np.polyfit(np.log(ASKED), np.log(found), 1)[0])
        first = "the first steps are short whatever is asked for, and steps grow by three at most"
        share = "what is asked for is met within a factor of four"
        return {
            "slope over the error asked for": Check(slope, 1.0, 0.2, first, scale=1.0),
            "logarithm of the share": Check(
                float(np.log(found[-1] / ASKED[-1])), 0.0, float(np.log(4)), share, scale=1.0
            ),
        }

    def _error(self, asked: float) -> float:
        from nmm.scene import parse_scene
        from nmm.stepping.run import run
        from nmm.verification.formulations import chosen

        text = oscillator(self.integrator, 1.0, CYCLES * 2 * np.pi / FREQUENCY)
        scene = parse_scene(text.replace("step = 1.0", f'step = "auto"\nerror = {asked!r}'))
        history = run(scene, chosen("rigid", scene.formulation)).history
        off = history["monitor:middle:ux"] * FREQUENCY - np.sin(FREQUENCY * history["time"])
        return float(abs(off).max()) / CYCLES


REBOUNDS = {1e8: -0.025832452350, 1e9: -0.051199215051, 2e9: -0.010026789873}
"""Where the middle of a straining block turns back (m), by the stiffness of its springs (N/m).

Two unknowns, the place and the strain along the fall, with the floor's springs on or off: solved
from event to event by Dormand and Prince's method of order 8 to 1e-11.
"""


@dataclass(frozen=True)
class StrainingBounce(SceneCase):
    """A block of one strain falls by half a metre on springs: how high it comes back."""

    name = "B7 error"
    title = "Rebound of a straining block in steps by an error"
    source = "m y'' = F - m g, m e'' / 12 = -E e - F / 2, F = k (e / 2 - y) >= 0"
    stiffness: float = 1e8
    error: float = 0.01
    # Springs as stiff as the block and 20 times as stiff, under two errors.
    parameters: ClassVar = {"stiffness": REBOUNDS, "error": (0.1, 0.01)}
    label = "{0.stiffness:g} N/m, error {0.error:g}"

    def scene(self) -> str:
        """Return the fall, the impact and the rebound."""
        return text.scene(
            'title = "Bounce"\nplane = "stress"\nduration = 0.6\n[gravity]\n[inertia]\n[contact]\n'
            f"[formulation.contact]\nnormal_penalty = {self.stiffness / 2 / 1e12!r}\n"
            f'[formulation.integrator]\ntype = "newmark"\nstep = "auto"\nerror = {self.error!r}\n',
            [
                text.material("floor", modulus=1e12, poisson=0.0, density=1000.0),
                text.material("block", modulus=1e8, poisson=0.0, density=1000.0),
                text.interface("contact", 0.0),
                text.block("floor", "floor", text.rectangle((-1, -1), (2, 0))),
                text.block("block", "block", text.rectangle((0, 0.5), (1, 1.5))),
                text.fixed_block("floor"),
                text.monitor("middle", (0.5, 1.0), "block"),
            ],
        )

    def measure(self, run: "Run") -> Checks:
        way = run.history["monitor:middle:uy"]
        height = float(way[int(way.argmin()) :].max())
        reason = (
            "up to four closings and openings, each of which errs by a share of what is asked for"
        )
        reference = REBOUNDS[self.stiffness]
        return {"rebound (m)": Check(height, reference, 0.4 * self.error, reason, scale=0.5)}


@dataclass(frozen=True)
class BarOnWall(SceneCase):
    """An elastic bar meets a wall with its end: it leaves as a wave has gone to and fro."""

    name = "B8 bar"
    title = "Elastic bar that meets a wall"
    source = "Saint-Venant: contact for 2 L / c, rebound at the speed of the impact"
    formulations = ("bilinear quads", "quads")
    rule: str = "step = 0.1"
    springs: str = "normal_penalty = 10.0"

    @classmethod
    def variants(cls) -> Sequence[Self]:
        """Return fixed steps with springs and multipliers, and steps by their error."""
        return [cls(), cls(springs='enforcement = "lagrange"'), cls('step = "auto"\nerror = 0.1')]

    @property
    def variant(self) -> str:
        return ", ".join((self.rule.replace("\n", ", "), self.springs)).replace('"', "")

    @property
    def slow(self) -> bool:
        """Steps by an error resolve the vibrations of cells at the wall."""
        return "auto" in self.rule

    def scene(self) -> str:
        """Return a bar of 10 m, E = rho = 1, 2 mm from a wall at 1 mm/s."""
        return text.scene(
            'title = "Bar"\nplane = "stress"\nduration = 30.0\n[inertia]\n[contact]\n'
            f"[formulation.contact]\n{self.springs}\n"
            f'[formulation.integrator]\ntype = "newmark"\n{self.rule}\n',
            [
                text.material("elastic", modulus=1.0, poisson=0.0, density=1.0),
                text.interface("smooth", 0.0),
                text.block("wall", "elastic", text.rectangle((-1, -1), (0, 1))),
                text.block("bar", "elastic", text.rectangle((2e-3, -0.25), (10.002, 0.25))),
                text.fixed_block("wall"),
                '[[initial_velocities]]\nblock = "bar"\nvelocity = [-1e-3, 0]\n',
                text.monitor("near", (2e-3, 0.0), "bar"),
            ],
        )

    def measure(self, run: "Run") -> Checks:
        time, gap = run.history["time"], run.history["monitor:near:ux"] + 2e-3
        within = time[gap < 2e-4]
        waves = "waves shorter than a few cells of half a metre stay behind as vibration"
        return {
            "speed after the impact (m/s)": Check(float(rates(run)[1, 0]), 1e-3, 0.04, waves),
            "contact (s)": Check(float(within[-1] - within[0]), 20.0, 0.04, waves),
        }
