"""Cracks that grow past one another, and past a hole."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from nmm.verification import text
from nmm.verification.base import Check, Checks, holds, limit
from nmm.verification.problems.cracks.crack_scenes import (
    GrowingCrack,
    crack,
    energy_kept,
    grown,
    net,
    path,
)

if TYPE_CHECKING:
    from nmm.stepping.run import Run


class PassingCracks(GrowingCrack):
    """Two cracks from opposite edges: first apart, then each hooks into the flank of the other."""

    name = "GR8"
    title = "Two offset edge cracks that pass, hook and coalesce"
    source = "Finite elements of degree 3 graded to the tips, pieces of 0.01"
    path = (
        *((0.3, 0.05), (0.3397, 0.0552), (0.379, 0.0626), (0.4178, 0.0723), (0.4565, 0.0823)),
        *((0.496, 0.0881), (0.5359, 0.086), (0.5743, 0.075), (0.6091, 0.0555), (0.6383, 0.0283)),
        *((0.66, -0.0052), (0.6735, -0.0428), (0.6756, -0.053)),
    )

    @property
    def tables(self) -> Sequence[str]:
        """Return the plate with both cracks; tips that are nearly critical grow together."""
        return [
            text.block("plate", "m", text.rectangle((0.0, -1.0), (1.0, 1.0))),
            crack("left", [[0.0, 0.05], [0.3, 0.05]]),
            crack("right", [[1.0, -0.05], [0.7, -0.05]]),
            text.pulled_edge("up", [[0.0, 1.0], [1.0, 1.0]], [0.0, 1.0]),
            text.pulled_edge("down", [[0.0, -1.0], [1.0, -1.0]], [0.0, -1.0]),
            text.fixed_point("lower", [1.0, -1.0]),
            text.fixed_point("other", [0.0, -1.0], "y"),
            grown(0.02, 10.0) + "together = 0.1\n",
            net(0.05, 17.0),
        ]

    def measure(self, run: "Run") -> Checks:
        import shapely

        (place, _), (other, _) = path(run, "left:end"), path(run, "right:end")
        line = shapely.LineString(self.path)
        off = shapely.distance(shapely.points(place), line)
        return {
            "distance from the path (m)": limit(float(np.max(off)), 0.02, "the benchmark's"),
            "point symmetry (m)": limit(
                float(np.abs(place + other - np.array([1.0, 0.0])).max()), 1e-3, "of the scene"
            ),
            "parts are free": holds("came free" in run.summary.sentence, "they meet"),
            **energy_kept(run),
        }


class PassedHole(GrowingCrack):
    """A crack from the edge is pushed away by a hole, drawn to it, and passes; the plate parts."""

    name = "GR5"
    title = "Edge crack deflected by a hole, and passing it"
    source = "Finite elements of degree 3 graded to the tip, pieces of 0.01"
    path = (
        *((0.2, 0.0), (0.26, -0.0024), (0.3199, -0.0044), (0.3799, -0.0052), (0.4399, -0.0038)),
        *((0.4996, 0.0015), (0.5585, 0.0131), (0.6150, 0.0331), (0.6689, 0.0594)),
        *((0.7270, 0.0724), (0.7870, 0.0714), (0.8470, 0.0704), (0.9070, 0.0701), (0.987, 0.07)),
    )
    hole = 0.1

    @property
    def tables(self) -> Sequence[str]:
        """Return the plate with its hole."""
        turn = np.linspace(0.0, 2 * np.pi, 97)[:-1]
        ring = np.array([0.6, 0.2]) + self.hole * np.stack([np.cos(turn), np.sin(turn)], axis=1)
        plate = text.block("plate", "m", text.rectangle((0.0, -1.0), (1.0, 1.0)))
        return [
            f"{plate}holes = [{ring.tolist()}]\n",
            crack("c", [[0.0, 0.0], [0.2, 0.0]]),
            text.pulled_edge("up", [[0.0, 1.0], [1.0, 1.0]], [0.0, 1.0]),
            text.pulled_edge("down", [[0.0, -1.0], [1.0, -1.0]], [0.0, -1.0]),
            text.fixed_point("lower", [1.0, -1.0]),
            text.fixed_point("upper", [1.0, 1.0], "x"),
            grown(0.04, 10.0),
            net(0.05, 11.0),
        ]

    def measure(self, run: "Run") -> Checks:
        place, _ = path(run, "c:end")
        x, y = place.T
        off = np.abs(y - np.interp(x, *np.transpose(self.path)))
        elements = run.topologies[-1].elements
        side = 96 * self.hole**2 * np.sin(2 * np.pi / 96) / 2
        return {
            "distance from the path before the hole (m)": limit(
                float(off[x < 0.6].max()), 0.01, "the benchmark's; four times its pieces"
            ),
            "distance behind it (m)": limit(float(off[x >= 0.6].max()), 0.015, "the benchmark's"),
            "where it leaves the plate (m)": Check(
                float(y[-1]), 0.07, 0.015, "the benchmark's", 1.0
            ),
            "area of both parts (m2)": Check(
                float(elements.areas.sum()), 2 - side, 1e-9, "of polygons"
            ),
            "a part is free": holds("came free" in run.summary.sentence, "it parts the plate"),
            **energy_kept(run),
        }
