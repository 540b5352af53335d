"""A wedge in a roof that friction and the stress across it hold."""

from typing import TYPE_CHECKING

import numpy as np

from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase

if TYPE_CHECKING:
    from nmm.stepping.run import Run

STIFF = 1e14
"""Young's modulus of blocks that hardly deform beside joints of 1e10 Pa/m (Pa)."""


class RoofWedge(SceneCase):
    """A symmetric wedge between joints of given stiffness is pulled out of a roof.

    As it comes down its joints open by ``sin a`` and lose pressure, so that it carries less than
    limit equilibrium under the first stress, ``2 H0 sin(phi - a) / cos(phi) cos(a)``, says.

    The sides are moved towards each other until they press with ``H0``. With both joints elastic
    that takes ``H0 (ks cos^2 a + kn sin^2 a) / (kn ks)`` a side, without shear beyond friction.
    """

    name = "B29"
    title = "Roof wedge of 40 degrees at its top, phi = 40, kn / ks = 10"
    source = (
        "Crawford and Bray 1983: 2 H0 (ks cos^2 a + kn sin^2 a) sin(phi - a) /"
        " (ks cos a cos phi + kn sin a sin phi)"
    )
    formulations = ("rigid", "dda")
    angle = 20.0
    friction = 40.0
    normal = 1e10
    shear = 1e9
    force = 1e5
    height = 0.9

    @property
    def limit(self) -> float:
        """Largest pull over H0."""
        a, phi = np.radians([self.angle, self.friction])
        top = self.shear * np.cos(a) ** 2 + self.normal * np.sin(a) ** 2
        below = self.shear * np.cos(a) * np.cos(phi) + self.normal * np.sin(a) * np.sin(phi)
        return float(2 * top * np.sin(phi - a) / below)

    def scene(self) -> str:
        """Return the wedge without its top between two blocks that are moved.

        The sides are where they shall be at a pull of a tenth of H0, far from the limit.
        """
        a = np.radians(self.angle)
        foot, top, high = float(np.tan(a)), float(np.tan(a) * (1 - self.height)), self.height
        area = high / np.cos(a)
        joint = {"normal_stiffness": self.normal, "shear_stiffness": self.shear}
        soft = self.shear * np.cos(a) ** 2 + self.normal * np.sin(a) ** 2
        way = float(self.force * soft / (self.normal * self.shear * area))
        right = np.array([(1, high), (top, high), (foot, 0), (1, 0)])
        return text.scene(
            'title = "Roof wedge"\nplane = "stress"\n[contact]\n[loading]\nuntil = "failure"\n'
            "[formulation.loading]\nincrement = 0.02\ntolerance = 1e-4\n",
            [
                text.material("rock", modulus=STIFF, poisson=0.0, density=None),
                text.interface("joint", self.friction, more=joint),
                text.block("wedge", "rock", [(-foot, 0), (foot, 0), (top, high), (-top, high)]),
                text.block("right", "rock", right),
                text.block("left", "rock", right[::-1] * [-1, 1]),
                *(
                    f'[[supports]]\nname = "hold {side}"\nblock = "{side}"\nfix = ["x", "y"]\n'
                    f"displacement = [{sign * way!r}, 0]\nhistory = [[0, 0], [0.1, 1]]\n"
                    for side, sign in (("right", -1), ("left", 1))
                ),
                f'[[loads]]\nname = "pull"\nkind = "point"\npoint = [0, 0]\nblock = "wedge"\n'
                f"force = [0, {-self.force!r}]\n",
            ],
        )

    def measure(self, run: "Run") -> Checks:
        found = run.summary.failure_factor
        reason = "the wedge moves by 1e-4 of its size, and hardly anything resists at the limit"
        computed = float("nan") if found is None else found
        return {"largest pull over H0": Check(computed, self.limit, 2e-3, reason)}
