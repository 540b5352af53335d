"""Beams of concrete that break: four-point bending of bonded Voronoi blocks."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from nmm.shipped import example
from nmm.verification.base import Check, Checks, SceneCase, holds, limit

if TYPE_CHECKING:
    from nmm.results.frame import Frame
    from nmm.stepping.run import Run

RANGES = {130: (8.6e3, 11e3), 455: (8.4e3, 10.2e3)}
"""Loads (N) between which beams of so many blocks must fail."""


MIDDLE = "the third with the largest moment, and half a block"


def _text(name: str) -> str:
    """Scene of an example."""
    return example(f"kitoh_beam/kitoh_{name}.toml").read_text(encoding="utf-8")


def _failure(run: "Run") -> float:
    found = run.summary.failure_load
    return float("nan") if found is None else found


@dataclass(frozen=True)
class PlainBeam(SceneCase):
    """A plain beam of bonded blocks breaks at its first joint.

    Dimensions but the height are a reconstruction, see the scene.
    """

    name = "C1"
    title = "Plain concrete beam of 130 and 455 Voronoi blocks"
    source = "Rigid blocks on brittle springs by another program, 12 tessellations"
    blocks: int = 130
    seed: int = 1
    parameters: ClassVar = {"blocks": (130, 455)}
    label = "{0.blocks} blocks"

    @property
    def slow(self) -> bool:
        """The finer one takes half a minute."""
        return self.blocks > 130

    def scene(self) -> str:
        """Return the scene of the example with a tessellation of its own."""
        written = _text(str(self.blocks))
        return written.replace("seed = 1\n", f"seed = {self.seed}\n")

    def measure(self, run: "Run") -> Checks:
        low, high = RANGES[self.blocks]
        load = _failure(run)
        reason = "means of the other program with both kinds of springs, and their scatter"
        frame = run.frames[-1]
        pull = frame.contact_force[:, 0] / frame.contact_length
        x = float(frame.contact_position[pull.argmax(), 0])
        return {
            "failure load (N)": Check(load, high, 0.0, reason, bound="at_most"),
            "the same, at least (N)": Check(load, low, 0.0, reason, bound="at_least"),
            "most loaded joint from midspan (m)": limit(abs(x - 0.2), 0.067, MIDDLE),
        }


class ReinforcedBeam(SceneCase):
    """A row of steel blocks that do not part carries on where the concrete has cracked.

    There is no reference load: strengths are the benchmark's, bar and cover an assumption.
    """

    name = "C1b"
    title = "Concrete beam of 455 blocks with a row of steel blocks"
    source = "Failure load of the plain beam; composite section with plane sections"
    slow = True

    def scene(self) -> str:
        """Return the scene of the example, which follows the load bond by bond."""
        return _text("reinforced")

    def measure(self, run: "Run") -> Checks:
        load, frame = _failure(run), run.frames[-1]
        last = load * frame.load_factor / (run.summary.failure_factor or np.nan)
        ends = "a limit point of the path is passed"
        plain = "largest load at which a plain beam of as many blocks may fail"
        whole = "where concrete has cracked steel carries more than the whole section would"
        return {
            "ends in failure": holds(run.summary.status == "failure_load", ends),
            "failure load (N)": Check(load, RANGES[455][1], 0.0, plain, bound="at_least"),
            "pull of steel at midspan (N)": Check(
                _pull_of_steel(frame), _pull_in_whole_section(last), 0.0, whole, bound="at_least"
            ),
            "farthest crack in the cover from midspan (m)": limit(
                _farthest_crack(frame), 0.067, MIDDLE
            ),
        }


def _pull_of_steel(frame: "Frame") -> float:
    """Force (N) in the joint of the bar at midspan, 18 to 22 mm above the bottom."""
    x, y = frame.contact_position.T
    across = np.abs(frame.contact_normal[:, 0]) > 0.99
    here = across & (np.abs(x - 0.2) < 1e-3) & (y > 0.017) & (y < 0.023)
    return float(frame.contact_force[here, 0].sum())


def _pull_in_whole_section(load: float) -> float:
    """Force (N) in the bar of an uncracked section under the moment of a load (N).

    ``n = E_s / E_c`` times the bar's area counts as concrete; lengths in m.
    """
    height, width, bar, arm, n = 0.1, 0.1, 4e-4, 0.03, 200 / 27.5
    concrete, more = height * width, (n - 1) * bar
    centre = more * arm / (concrete + more)
    inertia = width * height**3 / 12 + concrete * centre**2 + more * (arm - centre) ** 2
    return n * bar * (load / 2 * 0.1) * (arm - centre) / inertia


def _farthest_crack(frame: "Frame") -> float:
    """Distance (m) from midspan of the joints below the bar that stand open across the beam.

    Infinite where there is none.
    """
    from nmm.contact.problem.step_problem import BROKEN

    x, y = frame.contact_position.T
    across = np.abs(frame.contact_normal[:, 0]) > 0.7
    cracked = across & (y < 0.0175) & (frame.contact_state == int(BROKEN))
    return float(np.abs(x[cracked] - 0.2).max()) if cracked.any() else float("inf")
