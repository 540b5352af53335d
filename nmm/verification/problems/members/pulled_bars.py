"""Bars pulled out of a block, by the bond along them."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase, holds

if TYPE_CHECKING:
    from nmm.stepping.run import Run
PULL = """
[[bars]]
name = "bar"
points = [[0, 0], [{length}, 0]]
blocks = ["host", "jack"]
diameter = "16 mm"
young_modulus = "200 GPa"
ends = ["free", "fixed"]
[bars.bond]
{bond}
[[supports]]
name = "wall"
segment = [[0, -0.1], [0, 0.1]]
fix = ["x", "y"]
[[supports]]
name = "jack"
segment = [[{end}, -0.1], [{end}, 0.1]]
fix = ["x", "y"]
displacement = [{way}, 0]
[loading]
[formulation.loading]
increment = {increment}
"""


def pulled(bond: str, way: float, increment: float, length: float = 0.3) -> str:
    """Scene of a bar of 16 mm that a jack pulls out of a host which hardly gives way."""
    end = length + 0.1
    return text.scene(
        'plane = "stress"',
        [
            text.material("rock", modulus=1e15, poisson=0.0, density=None),
            text.block("host", "rock", text.rectangle((0, -0.1), (length, 0.1))),
            text.block("jack", "rock", text.rectangle((length, -0.1), (end, 0.1))),
            PULL.format(length=length, end=end, bond=bond, way=way, increment=increment),
        ],
    )


class ShearLag(SceneCase):
    """The force of a bar passes into its surroundings over a length that its bond sets."""

    name = "BO1"
    title = "Elastic shear lag of a bar that is pulled out"
    source = "F coth(beta L) / (E A beta), beta^2 = k p / (E A) (Volkersen 1938)"
    formulations = ("dda", "degree 2", "finite elements", "manifold")

    def scene(self) -> str:
        """Return the bar, pulled by the slip that 50 kN have."""
        return pulled('stiffness = "10 GPa/m"', 4.474853334e-4, 1.0)

    def measure(self, run: "Run") -> Checks:
        force = float(run.history["bars:bar:force"][-1])
        wall = float(-run.history["reaction:wall:x"][-1])
        reason = "order 2 in pieces of 0.027 over beta"
        return {
            "force at the loaded end (N)": Check(force, 50e3, 2e-4, reason),
            "sum of the bond's forces (N)": Check(wall, 50e3, 2e-4, reason),
        }


@dataclass(frozen=True)
class PullOut(SceneCase):
    """A bond that softens fails zone by zone: the peak is less than all of its strength at once."""

    name = "BO2"
    title = "Pull-out with a bilinear bond"
    source = "Yuan, Teng, Seracino, Wu and Yao (2004), two zones in closed form"
    formulations = ("dda", "manifold")
    length: float = 0.3
    # A bar that is pulled out, and one whose loaded slip snaps back.
    parameters: ClassVar = {"length": (0.3, 1.0)}
    label = "{0.length:g} m"

    def scene(self) -> str:
        """Return the bar pulled until its force falls."""
        bond = 'law = "bilinear"\nstrength = "8 MPa"\nslips = ["0.1 mm", "1 mm"]'
        way, increment = (6e-4, 1 / 60) if self.length < 1 else (3e-3, 0.02)
        return pulled(bond, way, increment, self.length)

    def measure(self, run: "Run") -> Checks:
        force = run.history["bars:bar:force"]
        reason = "increments of 0.01 mm, pieces of a fortieth"
        if self.length < 1:
            slip = 6e-4 * run.history["load_factor"]
            middle = float(np.interp(0.25e-3, slip, force))
            return {
                "peak (N)": Check(float(force.max()), 101838.31, 1e-3, reason),
                "force at 0.25 mm (N)": Check(middle, 77087.065, 2e-3, reason),
            }
        last = 3e-3 * float(run.history["load_factor"][-1])
        return {
            "peak (N)": Check(float(force.max()), 127162.64, 2e-3, reason),
            "slip at the snap-back (m)": Check(last, 2.5925e-3, 0.02, "pieces of 25 mm"),
            "the snap-back is told": holds(
                "snap-back" in run.summary.sentence, "no stable slips beyond it"
            ),
        }
