"""The pull-out of an anchor from a plate of bonded blocks: load, place and kind of its failure."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Self

import numpy as np

from integration.arrays import Floats
from nmm.shipped import example
from nmm.verification.base import Check, Checks, SceneCase, limit

if TYPE_CHECKING:
    from nmm.stepping.run import Run

STRENGTH = 2.9e6
"""Tensile strength of a joint (Pa)."""

THICKNESS = 0.1
"""Of the plate (m)."""

BOUND = 94.9e3
"""Load (N) above which no stress within the strengths is in equilibrium, by hand."""

CORNERS = np.array([[-0.02, 0.2], [0.02, 0.2]])
"""Corners (m) of the head's upper face."""


@dataclass(frozen=True)
class AnchorPullOut(SceneCase):
    """Joints open from a corner of the head, and loads fall with the size of blocks.

    Geometry and bearing are a reconstruction, see the scene. The other program breaks springs at
    corners of rigid blocks; deviations are those of its tessellations, of which this is none.
    """

    name = "C2"
    title = "Pull-out of an anchor from a plate of Voronoi blocks"
    source = "Rigid blocks on brittle springs by another program, 5 tessellations"
    way: str = "springs"
    sides: bool = True
    blocks: int = 704
    mean: float = 13.1e3
    deviation: float = 0.8e3
    slow = True

    @classmethod
    def variants(cls) -> Sequence[Self]:
        """Return both ways of joining blocks, free sides, and smaller blocks."""
        return [
            cls(),
            cls("bonds"),
            cls(sides=False, mean=12.7e3, deviation=1.9e3),
            cls(blocks=2000, mean=10.3e3, deviation=1.1e3),
        ]

    @property
    def variant(self) -> str:
        return f"{self.way}, {self.blocks} blocks, k = {'infinity' if self.sides else '0'}"

    def scene(self) -> str:
        """Return the scene of the example, with blocks and sides of its own."""
        text = example(f"seed_cases/pull_out/{self.way}.toml").read_text(encoding="utf-8")
        text = text.replace("blocks = 704", f"blocks = {self.blocks}")
        if self.sides:
            return text
        text = re.sub(r'\[\[supports\]\]\nname = "\w+ side"\n(.+\n)+\n', "", text)
        return text.replace('fix = ["y"]', 'fix = ["x", "y"]', 1)

    def measure(self, run: "Run") -> Checks:
        """Compare the load, and see where and how joints broke."""
        load = run.summary.failure_load or np.nan
        first, pulls = _broken(run)
        two = "two deviations of the other program's tessellations"
        corner = "a block is 16 mm wide: the joint begins at the corner or beside it"
        tension = "three of four joints at least reach the tensile strength, not that of shear"
        checks = {
            "first joint from a corner of the head (m)": limit(first, 0.01, corner),
            "share of joints that break in tension": Check(
                float(np.mean(pulls > 0.99 * STRENGTH)), 0.75, 0.0, tension, bound="at_least"
            ),
            "failure load, no more than (N)": limit(load, BOUND, "rigorous, by hand"),
        }
        if self.way == "springs":
            within = 2 * self.deviation / self.mean
            return {"failure load (N)": Check(load, self.mean, within, two), **checks}
        low, high = 7e3, 25e3
        between = "asked for by the benchmark of blocks of any kind"
        return {
            "failure load, at most (N)": Check(load, high, 0.0, between, bound="at_most"),
            "failure load, at least (N)": Check(load, low, 0.0, between, bound="at_least"),
            **checks,
        }


def _broken(run: "Run") -> tuple[float, Floats]:
    """Distance (m) of the first joint that breaks from a corner, and pulls (Pa) as joints break.

    A frame is an event: what is broken in the next one is at its strength in this one. Points of
    joints come first and stay; contacts of bodies that meet come and go behind them.
    """
    from nmm.contact.problem.step_problem import BROKEN

    places: list[Floats] = []
    pulls: list[Floats] = []
    for before, after in zip(run.frames[1:-1], run.frames[2:], strict=True):
        broken = int(BROKEN)
        kept = min(len(before.contact_state), len(after.contact_state))
        one, other = before.contact_state[:kept], after.contact_state[:kept]
        new = np.flatnonzero((other == broken) & (one != broken))
        area = THICKNESS * before.contact_length[new]
        places.append(before.contact_position[new])
        pulls.append(before.contact_force[new, 0] / area)
    away = np.linalg.norm(np.concatenate(places)[:, None] - CORNERS, axis=2).min(axis=1)
    return float(away[0]), np.concatenate(pulls)
