"""Factors of safety of slopes whose joints have a cohesion, which is lost where they open."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from nmm.verification import text
from nmm.verification.base import Check, Checks, holds
from nmm.verification.problems.matter.slopes import DENSITY, JointedSlope
from nmm.verification.text import G

if TYPE_CHECKING:
    from nmm.stepping.run import Run

WIDTH = 0.01


@dataclass(frozen=True)
class CohesiveSlope(JointedSlope):
    """The jointed slope with a cohesion on all joints, and no bond.

    A wedge that slides on a bedding leaves the cross joint behind it, whose cohesion goes with it:
    the least of ``(c L + W cos a tan phi) / (W sin a)`` over all wedges is what such a slope has.
    The static theorem, by a linear programme of its own, lets joints that are just closed
    keep their cohesion, and is the upper bound. Where columns lean on one another they stay closed
    and the bound is reached.
    """

    name = "PL5 cohesion"
    title = "Slope of joints with cohesion: strength reduction"
    source = "least wedge on a bedding; linear programme over forces"
    cohesion: float = 20e3
    friction: float = 30.0
    reached: str = "wedge"

    @classmethod
    def variants(cls) -> "tuple[CohesiveSlope, ...]":
        """Wedges under two cohesions, beds that reach the bound, and one between both."""
        steep, flat = (35.0, 110.0), (20.0, 120.0)
        return (
            cls(steep),
            cls(steep, cohesion=5e3),
            cls(flat, (3.0, 3.0), cohesion=10e3, reached="bound"),
            cls((30.0, 120.0), (3.0, 2.5), 35.0, cohesion=15e3, reached="between"),
        )

    @property
    def variant(self) -> str:
        dips = " and ".join(f"{one:g}" for one in self.dips)
        return f"joints at {dips} degrees, c = {self.cohesion / 1e3:g} kPa, {self.reached}"

    @property
    def slow(self) -> bool:
        """Some take six to twelve seconds, others two."""
        return self.cohesion not in (5e3, 10e3)

    @property
    def joint(self) -> str:
        """Joints that are closed carry the cohesion along them."""
        return text.interface("joint", self.friction, more={"cohesion": self.cohesion})

    @property
    def wedge(self) -> float:
        """Least factor of the wedges above a bedding and before a cross joint."""
        blocks, ground = self.pieces()
        return min(self._of(one) for one in self._wedges(blocks, ground))

    def _wedges(self, blocks: list[Any], ground: Any) -> list[Any]:
        """Unions of all blocks above one bedding and before one cross joint, off the ground."""
        from shapely import union_all

        along, back = (
            np.array([np.cos(one), np.sin(one)]) for one in np.radians(np.array(self.dips))
        )
        up, behind = np.array([-along[1], along[0]]), np.array([back[1], -back[0]])
        middle = np.array([block.centroid.coords[0] for block in blocks])
        level = np.floor((middle - self.origins[0]) @ up / self.spacings[0])
        column = np.floor((middle - self.origins[1]) @ behind / self.spacings[1])
        found = []
        for lowest in np.unique(level):
            for last in np.unique(column):
                inside = np.flatnonzero((level >= lowest) & (column <= last))
                one = union_all([blocks[n] for n in inside])
                if not one.is_empty and one.intersection(ground).length < 1e-6:
                    found.append((one, lowest))
        return found

    def _of(self, wedge: tuple[Any, float]) -> float:
        """Factor of a wedge that slides on its bedding, and leaves what is behind it."""
        from shapely import LineString

        body, lowest = wedge
        dip = np.radians(self.dips[0])
        along = np.array([np.cos(dip), np.sin(dip)])
        across = np.array([-along[1], along[0]])
        at = np.array(self.origins[0]) + lowest * self.spacings[0] * across
        line = LineString([at - 100 * along, at + 100 * along]).buffer(1e-9)
        weight, length = DENSITY * G * body.area, body.boundary.intersection(line).length
        holds = self.cohesion * length
        holds += weight * float(np.cos(dip) * np.tan(np.radians(self.friction)))
        return float(holds / (weight * np.sin(dip)))

    def measure(self, run: "Run") -> Checks:
        low, high = run.summary.factor_of_safety or np.nan, run.summary.factor_that_fails or np.nan
        wedge, bound = self.wedge, self.bound(self.cohesion)
        strained = "rigid bodies in the reference, which strain by 1e-4 here"
        checks = {
            "factor that holds, over the bound": Check(
                low / bound, 1.0, 1e-4, strained, bound="at_most"
            ),
            "factor that fails, over the wedge's": Check(
                high / wedge, 1.0, 1e-4, strained, bound="at_least"
            ),
            "width of the bracket": Check(high - low, WIDTH, 1e-9, "as asked", bound="at_most"),
            "failing is the structure's": holds(run.summary.status == "converged", "it is shown"),
        }
        if self.reached == "wedge":
            checks["factor"] = Check((low + high) / 2, wedge, WIDTH / wedge, "width of the bracket")
        if self.reached == "bound":
            checks["factor"] = Check(high, bound, 1e-4, strained)
        return checks
