"""A bar with one bonded joint that softens: followed back as its closed form says."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Self

import numpy as np

from integration.arrays import Floats
from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase, limit

if TYPE_CHECKING:
    from nmm.stepping.run import Run

# N, m: the area is 100 mm2, the strength ends at 300 N.
MODULUS, AREA, STRENGTH, ENERGY = 30e9, 1e-4, 3e6, 100.0
CRITICAL = 2 * MODULUS * ENERGY / STRENGTH**2
"""Length of bar (m) above which linear softening snaps back."""


def softening_bar(
    length: float, energy: float | None, control: str, law: str = "linear", more: str = ""
) -> str:
    """Return two halves of a bar, held left and pulled right by 1 N, whose bond softens.

    Without an ``energy`` (J/m2) it is brittle. A track keeps the halves from turning as they part:
    else one end of the joint would open before the other.
    """
    joint = {"cohesion": 1e9, "tensile_strength": STRENGTH, "bonded": True}
    high, half = 0.01, length / 2
    softening = "" if energy is None else f"fracture_energy = {energy!r}\n"
    softening += "" if energy is None or law == "linear" else f'law = "{law}_softening"\n'
    return text.scene(
        f'plane = "stress"\nthickness = {AREA / high!r}\n[contact]\n'
        f'[loading]\nuntil = "failure"\n[loading.control]\n{control}',
        [
            text.material("rock", modulus=MODULUS, poisson=0.0),
            text.interface("joint", 30.0, more=joint) + softening,
            text.block("a", "rock", text.rectangle((0, 0), (half, high))),
            text.block("b", "rock", text.rectangle((half, 0), (length, high))),
            text.fixed_edge("left", [[0, 0], [0, high]]),
            text.pulled_edge("pull", [[length, 0], [length, high]], [1 / AREA, 0]),
            text.fixed_edge("track", [[half, 0], [length, 0]], "y"),
            text.monitor("end", (length, high / 2), "b"),
            text.monitor("one", (half, high / 2), "a"),
            text.monitor("other", (half, high / 2), "b"),
            more,
        ],
    )


def opening(width: float, steps: int = 20) -> str:
    """Table of a control by the opening of the joint, to just beyond ``width`` (m)."""
    return (
        f'type = "opening"\nmonitors = ["other", "one"]\nincrement = {width / steps!r}\n'
        f"end = {1.05 * width!r}\n"
    )


@dataclass(frozen=True)
class SofteningBar(SceneCase):
    """The path is a polygon: up to the strength, and to no force at all, back or on."""

    ratio: float = 2.0
    law: str = "linear"
    name = "PA2"
    title = "A bar that softens in one joint, snaps back as far as it is long"
    source = "Straight from (f L / E, f A) to (w, 0); work G A, Petersson's knee"
    formulations = ("dda", "bilinear quads")
    label = "{0.law}, {0.ratio:.10g} of the critical length"

    @classmethod
    def variants(cls) -> Sequence[Self]:
        """Return bars about the critical length, and one whose law has two pieces."""
        return [
            *(cls(ratio) for ratio in (0.5, 1.0, 1 + 1e-9, 2.0, 100.0)),
            cls(1 / CRITICAL, "bilinear"),
        ]

    @property
    def width(self) -> float:
        """Opening (m) at which no force is left."""
        return (2.0 if self.law == "linear" else 3.6) * ENERGY / STRENGTH

    def scene(self) -> str:
        """Return the bar, led by the opening of its joint."""
        steps = 20 if self.law == "linear" else 36
        return softening_bar(
            self.ratio * CRITICAL, ENERGY, opening(self.width, steps), law=self.law
        )

    def measure(self, run: "Run") -> Checks:
        history, long = run.history, max(self.ratio, 1.0)
        force, end = history["load_factor"], history["monitor:end:ux"]
        crack = history["monitor:other:ux"] - history["monitor:one:ux"]
        soft = "springs of the held end and of the joint give by 1e-4 of the bar"
        softened = self.force_at(crack[1:])
        stretched = force / AREA * self.ratio * CRITICAL / MODULUS
        peak, work = run.summary.failure_factor or 0.0, float(history["external_work"][-1])
        off = float(np.abs(force[1:] - softened).max()) / (STRENGTH * AREA)
        back = float(np.abs(end - stretched - self.opening_at(force)).max()) / self.width
        return {
            "peak (N)": Check(peak, STRENGTH * AREA, 1e-8, "events are located"),
            "work (J)": Check(work, ENERGY * AREA, 2e-4 * long, soft),
            "force off its law, over the peak": limit(off, 2e-4 * long, soft),
            "end off its path, over the last opening": limit(back, 2e-4 * long, soft),
        }

    @property
    def corners(self) -> tuple[Floats, Floats]:
        """Openings (m) and forces (N) between which the law is straight."""
        knee = 0.8 * ENERGY / STRENGTH
        bent = self.law == "bilinear"
        openings = [0.0, knee, self.width] if bent else [0.0, self.width]
        shares = [1.0, 1 / 3, 0.0] if bent else [1.0, 0.0]
        return np.array(openings), np.array(shares) * STRENGTH * AREA

    def force_at(self, opening: Floats) -> Floats:
        """Force (N) of an opening (m)."""
        return np.interp(opening, *self.corners)

    def opening_at(self, force: Floats) -> Floats:
        """Opening (m) past the peak of a force (N); the first row is before it."""
        openings, forces = self.corners
        found = np.interp(force, forces[::-1], openings[::-1])
        found[0] = 0.0
        return found
