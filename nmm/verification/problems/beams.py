"""Beams of concrete that break: four-point bending of bonded Voronoi blocks."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar, Self

from nmm.shipped import example
from nmm.verification.base import Check, Checks, SceneCase, limit

if TYPE_CHECKING:
    from nmm.stepping.run import Run

RANGES = {130: (8.6e3, 11e3), 455: (8.4e3, 10.2e3)}
"""Loads (N) between which beams of so many blocks must fail."""


def _plain(blocks: int, seed: int) -> str:
    """Scene of a plain beam with a tessellation of its own; what follows failure is left out."""
    written = example(f"kitoh_beam/kitoh_{blocks}.toml").read_text(encoding="utf-8")
    written = written.replace("seed = 1\n", f"seed = {seed}\n")
    return written.replace("motion_after_failure", "# motion_after_failure")


def _failure(run: "Run") -> float:
    found = run.summary.failure_load
    return float("nan") if found is None else found


@dataclass(frozen=True)
class PlainBeam(SceneCase):
    """A plain beam of bonded blocks breaks at its first joint.

    Dimensions but the height are a reconstruction, see the scene.
    """

    name: ClassVar[str] = "C1"
    title: ClassVar[str] = "Plain concrete beam of 130 and 455 Voronoi blocks"
    source: ClassVar[str] = "Rigid blocks on brittle springs by another program, 12 tessellations"
    blocks: int = 130
    seed: int = 1

    @classmethod
    def variants(cls) -> Sequence[Self]:
        """Return both numbers of blocks."""
        return [cls(130), cls(455)]

    @property
    def variant(self) -> str:
        """The number of blocks."""
        return f"{self.blocks} blocks"

    @property
    def slow(self) -> bool:
        """The finer one takes half a minute."""
        return self.blocks > 130

    def scene(self) -> str:
        """Return the scene of the example."""
        return _plain(self.blocks, self.seed)

    def measure(self, run: "Run") -> Checks:
        """Compare the failure load with the range, and the first joint's place with the span."""
        low, high = RANGES[self.blocks]
        load = _failure(run)
        reason = "means of the other program with both kinds of springs, and their scatter"
        frame = run.frames[-1]
        pull = frame.contact_force[:, 0] / frame.contact_length
        x = float(frame.contact_position[pull.argmax(), 0])
        middle = "the third with the largest moment, and half a block"
        return {
            "failure load (N)": Check(load, high, 0.0, reason, bound="at_most"),
            "the same, at least (N)": Check(load, low, 0.0, reason, bound="at_least"),
            "most loaded joint from midspan (m)": limit(abs(x - 0.2), 0.067, middle),
        }
