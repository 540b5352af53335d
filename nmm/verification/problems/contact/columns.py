"""Columns that lean out of a slope: toppling and sliding by turns."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar, Self

import numpy as np

from integration.arrays import Floats
from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase, holds, limit
from nmm.verification.reading import converged, joint_force, way
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

    name = "B30"
    title = "Sixteen leaning columns of Goodman and Bray"
    source = "Goodman and Bray 1976; linear programme over admissible forces"
    formulations: ClassVar[tuple[str, ...]] = ("rigid", "dda")
    friction: float = 39.15
    wide = 10.0
    step = 1.0
    weight = 25e3
    lean = 30.0
    heights = (*range(4, 41, 4), 34, 28, 22, 16, 10, 4)
    # Friction a degree above the one limit and below the other.
    parameters: ClassVar = {"friction": (39.15, 32.4454)}
    label = "phi {0.friction}"

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
        # What falls is followed in time; what stands is found at once.
        return self._scene("" if self.stands else "duration = 2.0\n[inertia]\n")

    def _scene(self, head: str) -> str:
        columns = self.corners()
        stairs = [point for one in columns for point in (one[0], one[1])]
        ends = [(self.wide * len(columns), -10.0), (-self.wide, -10.0), (-self.wide, 0.0)]
        base = np.array([*stairs, *ends])[::-1]
        lean = float(np.radians(self.lean))
        return text.scene(
            f'title = "Leaning columns"\nplane = "stress"\n{head}[contact]\n[gravity]\n'
            f"acceleration = [{float(-G * np.sin(lean))}, {float(-G * np.cos(lean))}]\n"
            "[formulation.integrator]\nstep = 0.01\n",
            [
                text.material("rock", modulus=1e11, poisson=0.0, density=self.weight / G),
                text.interface("joint", self.friction),
                text.block("base", "rock", base),
                text.fixed_block("base"),
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


# Thrusts on the columns from 12 down, of each by the one above it, and what the toe needs besides
# (N/m), at a friction of tan phi = 0.7855.
_TOPPLING = [292.47, 825.66, 1555.96, 2826.72, 3922.16, 4594.80, 4837.01, 4637.52, 3978.13, 2825.58]
PRINTED = 1e3 * np.array([*_TOPPLING, 1413.56, 472.21, 1.54])


@dataclass(frozen=True)
class ToppledColumns(LeaningColumns):
    """The thrusts between the columns when they do what limit equilibrium assumes of them.

    The printed thrusts are one of many states that friction allows. They need columns 4 to 13 to
    stand on their lower corners and touch at the upper ones, and all friction between columns to
    be used up. Two ways lead there:

    * Friction 0.003 degrees above the limit, and weight alone. What gives turns the columns about
      their lower corners, and hardly another state is admissible; the reference is the balance at
      that friction.
    * The printed friction, at which the toe needs 1.54 kN/m: the lowest column is held and drawn
      back by ``retreat`` under full weight. Its neighbours slide after it, those above turn, the
      three highest stay. As the columns turn the arms of their weights grow: at column 13 by ten
      times the turn, a tenth of the retreat per metre, 3e-3 for 2 mm and half of it for half.

    Further above the limit the thrusts on columns 4 to 12 are still those of the balance at that
    friction, to 3e-4 up to 41 degrees with deformable columns; only the toe, which no longer has
    to slide, shares its feet and joints in other ways. So it does with rigid columns and with
    exact contact on either way: states of friction there are many, and rounding chooses.
    """

    name = "B30 thrusts"
    title = "Thrusts between the columns of Goodman and Bray"
    source = "Goodman and Bray 1976; their balance of single columns, computed anew"
    formulations = ("dda",)
    friction: float = float(np.degrees(np.arctan(0.7855)))
    retreat: float = 2e-3

    @classmethod
    def variants(cls) -> Sequence[Self]:
        """Return the printed friction with a toe that gives way, and a little more without."""
        return [cls(), cls(38.153, 0.0)]

    @property
    def variant(self) -> str:
        return "toe drawn back" if self.retreat else f"phi {self.friction}"

    def scene(self) -> str:
        """Return the columns, the lowest one drawn back or not."""
        if not self.retreat:
            return self._scene("")
        head = '[loading]\nscaled = ["toe"]\n[formulation.loading]\nincrement = 0.05\n'
        toe = (
            '[[supports]]\nname = "toe"\nblock = "column 1"\nfix = ["x", "y"]\n'
            f"displacement = [{-self.retreat!r}, 0]\n"
        )
        return text.scene(self._scene(head), [toe])

    def balanced(self) -> Floats:
        """Thrusts (13,) below columns 13 to 1 by the balance of one column after the other (N/m).

        A column that topples turns about its lower corner; thrusts act at the top of the lower of
        two columns, with friction ``T = P tan phi`` on both sides. One that slides uses up the
        friction of its base too.
        """
        tan, lean, thrust, found = np.tan(np.radians(self.friction)), np.radians(self.lean), 0.0, []
        tops = np.array([n * self.step + high for n, high in enumerate(self.heights)])
        for n in range(12, -1, -1):
            foot, high = n * self.step, self.heights[n]
            weight = self.weight * high * self.wide
            # Where the columns above and below touch this one, over its foot.
            above = min(tops[n], tops[n + 1]) - foot
            below = min(tops[n], tops[n - 1]) - foot if n else 0.0
            arm = (high * np.sin(lean) - self.wide * np.cos(lean)) / 2
            moment = thrust * (above - self.wide * tan) + weight * arm
            topples = moment / below if n else -np.inf
            slides = thrust - weight * (np.cos(lean) * tan - np.sin(lean)) / (1 - tan**2)
            thrust = max(topples, slides, 0.0)
            found.append(thrust)
        return np.array(found)

    def measure(self, run: "Run") -> Checks:
        if not converged(run):
            return {"in equilibrium": holds(False, run.summary.sentence)}
        found, balanced, reason = {}, self.balanced(), "0.003 degrees of friction to spare"
        if self.retreat:
            farthest = float(np.abs(balanced - PRINTED).max())
            rounded = "half of the last digit printed"
            found["farthest balance from print (N)"] = limit(farthest, 5.0, rounded)
            balanced, reason = PRINTED, "turn of the columns by the retreat: 3e-3 at column 13"
        thrusts = [-joint_force(run, self._joint(n), np.array([1.0, 0.0]))[0] for n in range(1, 16)]
        for n, thrust in zip(range(12, 0, -1), balanced, strict=False):
            name = f"thrust on column {n} (N)"
            found[name] = Check(float(thrusts[n - 1]), float(thrust), 5e-3, reason)
        most = float(np.abs(thrusts[12:]).max())
        found["thrust above column 13 (N)"] = limit(most, 1.0, "the columns above stand alone")
        return found

    def _joint(self, n: int) -> Floats:
        """A point between column ``n`` and the next above it."""
        return np.array([n * self.wide, 0.0])
