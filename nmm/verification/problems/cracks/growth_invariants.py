"""What growth of a crack must not hang on: where the scene lies, how it is turned and mirrored."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Floats
from nmm.verification import text
from nmm.verification.base import Check, Checks, limit
from nmm.verification.problems.cracks.crack_scenes import (
    GrowingCrack,
    crack,
    grown,
    net,
    path,
)

if TYPE_CHECKING:
    from nmm.stepping.run import Run


@dataclass(frozen=True)
class SceneElsewhere:
    """Where a scene lies: mirrored about y = 0 or not, then turned (rad), then shifted (m)."""

    mirrored: bool = False
    turn: float = 0.0
    shift: tuple[float, float] = (0.0, 0.0)

    def vector(self, way: Sequence[float]) -> list[float]:
        """Return a direction (2,) of the scene as it lies."""
        x, y = way[0], -way[1] if self.mirrored else way[1]
        c, s = np.cos(self.turn), np.sin(self.turn)
        return [float(c * x - s * y), float(s * x + c * y)]

    def point(self, place: Sequence[float]) -> list[float]:
        """Return a place (2,) of the scene as it lies."""
        return [one + by for one, by in zip(self.vector(place), self.shift, strict=True)]

    def back(self, places: Floats) -> Floats:
        """Return places (n, 2) as they would be in the scene itself."""
        x, y = (places - np.array(self.shift)).T
        c, s = np.cos(self.turn), np.sin(self.turn)
        found = np.stack([c * x + s * y, -s * x + c * y], axis=1)
        return found * [1.0, -1.0] if self.mirrored else found


@dataclass(frozen=True)
class SameAnywhere(GrowingCrack):
    """An edge crack that is not across the tension, and the same scene at other places."""

    name = "GR11"
    title = "Growth of a crack, shifted, turned and mirrored"
    source = "Mechanics knows no place and no direction; Griffith's balance"
    where: SceneElsewhere = SceneElsewhere()
    angle: float = 17.0

    @property
    def tables(self) -> Sequence[str]:
        """Return a plate that is pulled along y."""
        at, way = self.where.point, self.where.vector
        ring = [at(one) for one in ((0.0, -1.0), (1.0, -1.0), (1.0, 1.0), (0.0, 1.0))]
        return [
            text.block("plate", "m", np.array(ring[::-1] if self.where.mirrored else ring)),
            crack("c", [at((-0.05, -0.03)), at((0.3, 0.15))]),
            text.pulled_edge("up", [at((0.0, 1.0)), at((1.0, 1.0))], way((0.0, 1.0))),
            text.pulled_edge("down", [at((0.0, -1.0)), at((1.0, -1.0))], way((0.0, -1.0))),
            text.fixed_point("lower", at((1.0, -1.0))),
            text.fixed_point("other", at((0.0, -1.0))),
            grown(0.03, 0.24),
            net(0.08, self.angle + float(np.degrees(self.where.turn))),
        ]

    def measure(self, run: "Run") -> Checks:
        """Run the others and compare the paths; and the energies of this one."""
        place, _ = path(run, "c:end")
        summary = run.summary
        freed, taken = summary.freed_energy, summary.fracture_energy
        assert freed is not None
        assert taken is not None
        turned, half = float(np.radians(37.0)), self._far
        return {
            "shifted by 1e6 (m)": limit(
                half(place, SceneElsewhere(shift=(1e6, -1e6))), 1e-6, "rounding"
            ),
            "turned by 37 degrees (m)": limit(
                half(place, SceneElsewhere(turn=turned)),
                1e-3,
                "the net lies otherwise about the plate",
            ),
            "mirrored (m)": limit(
                half(place, SceneElsewhere(mirrored=True)), 1e-3, "the net is not mirrored"
            ),
            "energy freed, of the work": Check(
                freed,
                taken,
                1e-3 * float(run.history["external_work"].max()) / taken,
                "the benchmark's",
            ),
        }

    def _far(self, place: Floats, where: SceneElsewhere) -> float:
        """Largest distance (m) of the path from that of the scene elsewhere."""
        import nmm
        from nmm.scene.read import parse_scene

        other = nmm.run(parse_scene(SameAnywhere(where, self.angle).scene()))
        found = where.back(path(other, "c:end")[0])
        return float(np.hypot(*(found - place).T).max())
