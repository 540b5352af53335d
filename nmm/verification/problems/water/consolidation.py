"""Soil that is loaded at once and gives way as its water leaves: Terzaghi's column."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Self

import numpy as np

from integration.arrays import Floats
from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase, limit
from nmm.verification.problems.water.seepage import consolidating, pressure

if TYPE_CHECKING:
    from nmm.stepping.run import Run

HEIGHT, MODULUS, POISSON, LOAD = 5.0, 1e7, 0.2, 1e5
CONFINED = MODULUS * (1 - POISSON) / ((1 + POISSON) * (1 - 2 * POISSON))
# Water without weight to speak of: its rest pressure is 5e-5 of the load.
WEIGHT = 1.0
TERMS = 200


def isochrone(depth: Floats, time: float) -> Floats:
    """Excess pressure (m,) over that at the start at depths (m,) over the height (Terzaghi 1923).

    ``time`` is ``c t / H^2``.
    """
    roots = np.pi / 2 * (2 * np.arange(TERMS) + 1)
    parts = 2 / roots * np.sin(np.outer(depth, roots)) * np.exp(-(roots**2) * time)
    return np.asarray(parts.sum(axis=1))


def settled(time: float) -> float:
    """Share of the settlement by drainage that has come."""
    roots = np.pi / 2 * (2 * np.arange(TERMS) + 1)
    return float(1 - (2 / roots**2 * np.exp(-(roots**2) * time)).sum())


@dataclass(frozen=True)
class ConsolidatingColumn(SceneCase):
    """A column drained at its top, loaded there at once: pressures and settlement."""

    name = "WA13"
    title = "Consolidation of a column"
    source = "Terzaghi's series; p = B q at once, B = 1 / (1 + S M / w) (Biot 1941)"
    formulations = ("finite elements", "manifold", "quads", "splines")
    steps: int = 40
    storage: float = 1e-3
    time: float = 0.3
    label = "{0.steps} steps, S M / w = {0.storage:g}"

    @classmethod
    def variants(cls) -> Sequence[Self]:
        """Return steps of two lengths, and water that is compressed as easily as the soil."""
        return [cls(), cls(160), cls(160, storage=1.0)]

    def scene(self) -> str:
        """Return the column; the coefficient of consolidation is the height squared a second."""
        storage = self.storage * WEIGHT / CONFINED
        conductivity = HEIGHT**2 * (storage + WEIGHT / CONFINED)
        top, corner = [[0, HEIGHT], [1, HEIGHT]], [0, 0]
        return text.scene(
            consolidating("Consolidation", HEIGHT, WEIGHT, self.time, self.steps),
            [
                text.material("soil", MODULUS, POISSON, None)
                + f"hydraulic_conductivity = {conductivity!r}\nspecific_storage = {storage!r}\n",
                text.block("soil", "soil", text.rectangle((0, 0), (1, HEIGHT))),
                f'[[heads]]\nname = "top"\nsegment = {top}\nhead = {HEIGHT!r}\n',
                text.pulled_edge("fill", top, [0, -LOAD]),
                text.fixed_edge("base", [corner, [1, 0]], "y"),
                text.fixed_edge("left", [corner, top[0]], "x"),
                text.fixed_edge("right", [[1, 0], top[1]], "x"),
                text.monitor("top", (0.5, HEIGHT), "soil"),
            ],
        )

    def measure(self, run: "Run") -> Checks:
        depth = np.array([0.99, 0.5, 0.2])
        at_once = 1 / (1 + self.storage)
        points = np.stack([np.full(3, 0.5), HEIGHT * (1 - depth)], axis=1)
        found = pressure(run, points) / (LOAD * at_once)
        exact = isochrone(depth, self.time)
        free = LOAD * HEIGHT / CONFINED
        settlement = free * (1 - at_once + at_once * settled(self.time))
        down = -float(run.history["monitor:top:uy"][-1])
        share = 0.4 / self.steps
        steps = "of order 1 in the step, which is 0.3 over their number"
        seepage = run.stepper.plan.effects["consolidation"]
        checks = {
            f"pressure at a depth of {place:g} H (B q)": Check(one, other, share, steps, scale=0.6)
            for place, one, other in zip(depth, found, exact, strict=True)
        }
        return {
            **checks,
            "settlement (m)": Check(down, settlement, share, steps),
            "water unaccounted for": limit(seepage.imbalance(run.state), 1e-9, "rounding"),
        }
