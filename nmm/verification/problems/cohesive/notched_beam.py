"""A notched beam whose cohesive crack is drawn, or grows."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase, limit
from nmm.verification.problems.cracks.crack_scenes import crack, net

if TYPE_CHECKING:
    from nmm.stepping.run import Run


@dataclass(frozen=True)
class CohesiveBeam(SceneCase):
    """A notched beam of 100 mm, span 400 mm: a plane that is drawn, and zones that grow.

    The mouth of the notch is opened; the load follows, past its peak.
    """

    name = "CO3"
    title = "Notched beam in three-point bending with a cohesive crack"
    source = "Finite elements with the same plane, 40 and 80 layers, extrapolated"
    formulations = ("dda",)
    peak = 4216.5
    mouth = 5.06e-5
    height = 0.1
    notch = 0.03
    angle: float | None = None
    # A drawn plane, and zones in nets that are turned.
    parameters: ClassVar = {"angle": (None, 0.0, 17.0, 40.0)}
    slow = True

    @property
    def variant(self) -> str:
        if self.angle is None:
            return "drawn plane, net at 17 degrees"
        return f"zone that grows, net at {self.angle:g} degrees"

    def scene(self) -> str:
        """Return the beam with notch, plane or zone, and the control of its mouth."""
        bond = {
            "cohesion": 30e6,
            "tensile_strength": 3e6,
            "bonded": True,
            "fracture_energy": 100.0,
        }
        grows = "[cohesive_zones]\nincrement = 0.02\n"
        plane = [[0.0, self.notch], [0.0, self.height + 0.005]]
        drawn = crack("plane", plane) + "bonded = true\n"
        return text.scene(
            'title = "Cohesive crack"\nplane = "stress"\nthickness = 0.1\n[contact]\n'
            '[loading]\nuntil = "failure"\n[loading.control]\ntype = "opening"\n'
            'monitors = ["right", "left"]\nincrement = 4e-6\nend = 8e-5\n',
            [
                text.material("concrete", modulus=30e9, poisson=0.2, density=None),
                text.interface("crack", 35.0, more=bond) + 'law = "linear_softening"\n',
                text.block("beam", "concrete", text.rectangle((-0.2125, 0), (0.2125, self.height))),
                crack("notch", [[0.0, -0.01], [0.0, self.notch]]),
                grows if self.angle is not None else drawn,
                text.fixed_point("pin", [-0.2, 0.0]),
                text.fixed_point("roller", [0.2, 0.0], "y"),
                text.pulled_edge(
                    "push", [[-0.005, self.height], [0.005, self.height]], [0, -1000.0]
                ),
                text.monitor("left", (-0.001, 0.0), "beam"),
                text.monitor("right", (0.001, 0.0), "beam"),
                net(0.02, 17.0 if self.angle is None else self.angle),
            ],
        )

    def measure(self, run: "Run") -> Checks:
        load, history = run.history["load_factor"], run.history
        mouth = history["monitor:right:ux"] - history["monitor:left:ux"]
        free = self.angle is not None
        found = {
            "largest load (N)": Check(
                float(load.max()),
                self.peak,
                0.04 if free else 0.02,
                "the benchmark's, of a free path and of a prescribed one",
            ),
            "load at the mouth of the reference's peak (N)": Check(
                float(np.interp(self.mouth, mouth, load)),
                self.peak,
                0.04,
                "the peak is flat, and cells are a fifth of the height",
            ),
            "energy made or lost, share": limit(
                abs(run.summary.energy_balance or 0.0), 1e-3, "steps of 4 um"
            ),
        }
        if free:
            away = np.abs(history["cohesive zones:notch:end:x"]).max()
            reason = "a third of a cell at the upper edge"
            found["largest distance from the plane (m)"] = limit(float(away), 0.007, reason)
        return found
