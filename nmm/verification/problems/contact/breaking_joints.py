"""Joints that break: pulled off along a bilinear law, and at once."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase

if TYPE_CHECKING:
    from nmm.stepping.run import Run


@dataclass(frozen=True)
class PullOff(SceneCase):
    """A bonded block is pulled off, centrally or off centre.

    Two springs at the corners of a joint of width B hold ``F = f_t A / (1 + 2 e / B)``; at the
    Gauss points of the joint ``f_t A / (1 + 2 sqrt(3) e / B)``. A stress that is linear over the
    face would hold ``f_t A / (1 + 6 e / B)``; two springs do not.
    """

    name = "B31 pull-off"
    title = "Pull on a bonded block, central and eccentric"
    source = "Lever rule of the more loaded of two springs"
    formulations = ("rigid", "dda")
    eccentricity: float = 0.0
    points: str = "corners"
    strength = 1e6
    parameters: ClassVar = {"points": ("corners", "gauss"), "eccentricity": (0.0, 0.1, 0.3)}
    label = "{0.points}, e {0.eccentricity}"

    def scene(self) -> str:
        """Return a square bonded to a held one and pulled at a point of its top."""
        return text.scene(
            'title = "Pull-off"\nplane = "stress"\n[contact]\n[loading]\nuntil = "failure"\n'
            f'[formulation.contact]\nbonds = "spring"\njoint_points = "{self.points}"\n'
            "[formulation.loading]\nincrement = 0.1\ntolerance = 1e-4\n",
            [
                *_bonded_squares(self.strength, modulus=1e11, density=None),
                '[[loads]]\nname = "pull"\nkind = "point"\n'
                f"point = [{0.5 + self.eccentricity!r}, 1]\nforce = [0, {self.strength!r}]\n",
            ],
        )

    def measure(self, run: "Run") -> Checks:
        lever = 2.0 if self.points == "corners" else 2.0 * float(np.sqrt(3.0))
        expected = self.strength / (1 + lever * self.eccentricity)
        found = run.summary.failure_load
        reason = "the bracket of the load, 1e-4, and a turn of 1e-4 rad"
        return {"load (N)": Check(float("nan") if found is None else found, expected, 3e-4, reason)}


class BrittleDrop(SceneCase):
    """A bond that breaks lets go at once; energy is kept but for the broken springs' own."""

    name = "B31 drop"
    title = "Energy of a bond that breaks"
    source = "Work = kinetic + stored + lost"
    formulations = ("dda", "newmark")
    strength = 1e6

    def scene(self) -> str:
        """Return a bonded block of 1 m pulled ever harder, in time."""
        return text.scene(
            'title = "Brittle drop"\nplane = "stress"\nduration = 0.01\n[contact]\n[inertia]\n'
            '[formulation.integrator]\nstep = 2e-5\n[formulation.contact]\nbonds = "spring"\n',
            [
                *_bonded_squares(self.strength, modulus=1e9, density=1000.0),
                text.pulled_edge("pull", [[0, 1], [1, 1]], [0, 2 * self.strength])
                + "history = [[0, 0], [0.01, 1]]\n",
            ],
        )

    def measure(self, run: "Run") -> Checks:
        h = run.history
        stored = h["strain_energy"] + h["contact_energy"] + h["support_energy"]
        rest = h["external_work"] - h["kinetic_energy"] - stored - h["friction_loss"]
        damping = "Shi's damping of the block's longest wave, omega dt / 4 = 0.01 a radian"
        return {
            "contact force (N)": Check(
                float(np.abs(run.contact_forces).sum()), 0.0, 0.0, "nothing holds"
            ),
            "broken points": Check(h["broken"][-1], 2.0, 0.0, "both"),
            "rest of energy over the work": Check(
                rest[-1], 0.0, 0.02, damping, scale=h["external_work"][-1]
            ),
            "energy lost by broken springs (J)": Check(
                h["friction_loss"][-1],
                self.strength**2 / (2 * 0.5 * 1e9),
                0.1,
                "F^2 / (2 k) at 1e6 N, exceeded by the rise of the force in a step",
            ),
        }


def _bonded_squares(strength: float, modulus: float, density: float | None) -> list[str]:
    """Return a square of 1 m on a held one, bonded by a tensile strength (Pa)."""
    law = {"cohesion": 10 * strength, "tensile_strength": strength, "bonded": True}
    return [
        text.material("rock", modulus=modulus, poisson=0.0, density=density),
        text.interface("bond", 30.0, more=law),
        text.block("lower", "rock", text.rectangle((0, -1), (1, 0))),
        text.block("upper", "rock", text.rectangle((0, 0), (1, 1))),
        text.fixed_block("lower"),
    ]
