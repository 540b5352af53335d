"""Columns that lean out of a slope: toppling and sliding by turns."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar, Self

import numpy as np

from integration.arrays import Floats
from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase, holds
from nmm.verification.reading import converged, way
from nmm.verification.text import G

if TYPE_CHECKING:
    from nmm.stepping.run import Run


@dataclass(frozen=True)
class LeaningColumns(SceneCase):
    """Sixteen columns on a stepped base stand if friction lets some state be in equilibrium.

    Limit equilibrium in which every column topples over its lower corner or slides, with friction
    used up beside it, asks for 38.15 degrees. States without those assumptions exist down to
    33.4454 degrees (a linear programme), and none below. Between the two what is found hangs on
    the way there, so that neither is "the" friction angle: above the first the columns must stand,
    below the second they must fall.

    The axes lie along the base: gravity leans by 30 degrees.
    """

    name: ClassVar[str] = "B30"
    title: ClassVar[str] = "Sixteen leaning columns of Goodman and Bray"
    source: ClassVar[str] = "Goodman and Bray 1976; linear programme over admissible forces"
    formulations: ClassVar[tuple[str, ...]] = ("rigid", "dda")
    friction: float = 39.15
    wide: ClassVar[float] = 10.0
    step: ClassVar[float] = 1.0
    weight: ClassVar[float] = 25e3
    lean: ClassVar[float] = 30.0
    heights: ClassVar[tuple[float, ...]] = (*range(4, 41, 4), 34, 28, 22, 16, 10, 4)

    @classmethod
    def variants(cls) -> Sequence[Self]:
        """Return friction a degree above the one limit and below the other."""
        return [cls(39.15), cls(32.4454)]

    @property
    def variant(self) -> str:
        """The friction angle."""
        return f"phi {self.friction}"

    @property
    def slow(self) -> bool:
        """Falling is followed in time."""
        return not self.stands

    @property
    def stands(self) -> bool:
        """Whether there is more friction than limit equilibrium needs."""
        return self.friction > 38.15

    def corners(self) -> list[Floats]:
        """Corners of the columns from the toe up."""
        return [
            text.rectangle((n * self.wide, n * self.step), ((n + 1) * self.wide, n * self.step + h))
            for n, h in enumerate(self.heights)
        ]

    def scene(self) -> str:
        """Return the columns on a held base with a step under each."""
        columns = self.corners()
        stairs = [point for one in columns for point in (one[0], one[1])]
        ends = [(self.wide * len(columns), -10.0), (-self.wide, -10.0), (-self.wide, 0.0)]
        base = np.array([*stairs, *ends])[::-1]
        # What falls is followed in time; what stands is found at once.
        time = "" if self.stands else "duration = 2.0\n[inertia]\n"
        lean = float(np.radians(self.lean))
        return text.scene(
            f'title = "Leaning columns"\nplane = "stress"\n{time}[contact]\n[gravity]\n'
            f"acceleration = [{float(-G * np.sin(lean))}, {float(-G * np.cos(lean))}]\n"
            "[formulation.integrator]\nstep = 0.01\n",
            [
                text.material("rock", modulus=1e11, poisson=0.0, density=self.weight / G),
                text.interface("joint", self.friction),
                text.block("base", "rock", base),
                text.held("base"),
                *(text.block(f"column {n + 1}", "rock", one) for n, one in enumerate(columns)),
                text.monitor("top", columns[9][3], "column 10"),
            ],
        )

    def measure(self, run: "Run") -> Checks:
        """Say whether they stand, near where they were, or fall."""
        reason = "one degree beyond the limit"
        moved = np.hypot(*way(run, "top").T)
        if not self.stands:
            # Left alone at a share of 0.02 of gravity for 2 s; the give of contacts is 1e-3 m.
            return {
                "way of the highest top (m)": Check(
                    float(moved[-1]), 0.1, 0.0, reason, None, "at_least"
                ),
                "still under way": holds(moved[-1] > 1.2 * moved[int(0.8 * len(moved))], reason),
            }
        frame = run.frames[-1]
        pressed = frame.contact_force[:, 0] < 0
        used = np.abs(frame.contact_force[pressed, 1] / frame.contact_force[pressed, 0])
        return {
            "stands": holds(converged(run), reason),
            "way of the highest top (m)": Check(
                float(moved[-1]),
                0.01,
                0.0,
                "1e-4 of the height, by the give of contacts",
                None,
                "at_most",
            ),
            "largest friction used": Check(
                float(used.max()),
                float(np.tan(np.radians(self.friction))),
                1e-6,
                "Coulomb's law",
                None,
                "at_most",
            ),
        }
