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
[formulation.bars]
pieces = {pieces}
"""


def pulled(bond: str, way: float, increment: float, length: float = 0.3, pieces: int = 40) -> str:
    """Scene of a bar of 16 mm that a jack pulls out of a host which hardly gives way."""
    end = length + 0.1
    return text.scene(
        'plane = "stress"',
        [
            text.material("rock", modulus=1e15, poisson=0.0, density=None),
            text.block("host", "rock", text.rectangle((0, -0.1), (length, 0.1))),
            text.block("jack", "rock", text.rectangle((length, -0.1), (end, 0.1))),
            PULL.format(
                length=length, end=end, bond=bond, way=way, increment=increment, pieces=pieces
            ),
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


class LongBolt(SceneCase):
    """A long bolt in resin sheds its force within a few hole diameters of its collar."""

    name = "BO6"
    title = "Force and shear stress along a grouted bolt"
    source = (
        "exp(-alpha x) from the collar, alpha^2 = 2 G / (E a^2 ln(R / a)): resin of shear modulus "
        "G between the bolt's radius a and the hole's R (Farmer 1975)"
    )
    formulations = ("dda", "degree 2", "finite elements", "manifold", "quads", "splines")
    radius, hole, resin, steel, length, force = 8e-3, 14e-3, 0.9e9, 200e9, 1.2, 40e3

    @property
    def decay(self) -> float:
        """Farmer's alpha (1/m); times the length it is 19: infinitely long to 1e-8."""
        thick = np.log(self.hole / self.radius)
        return float(np.sqrt(2 * self.resin / (self.steel * self.radius**2 * thick)))

    def scene(self) -> str:
        """Return the bolt, pulled by the slip that the force has at its collar."""
        stiffness = self.resin / (self.radius * np.log(self.hole / self.radius))
        area = np.pi * self.radius**2
        slip = self.force / (self.steel * area * self.decay)
        return pulled(f"stiffness = {float(stiffness)!r}", float(slip), 1.0, self.length, 240)

    def measure(self, run: "Run") -> Checks:
        segments = run.stepper.plan.effects["bars"].segments(run.state)
        # The last piece is a half, up to the plate of the jack.
        force, place = segments.force[:-1], segments.place[:-1, :, 0].mean(axis=1)
        shear = np.diff(force) / (2 * np.pi * self.radius * np.diff(place))
        at_collar = self.decay * self.force / (2 * np.pi * self.radius)
        reason = "order 2 in pieces of 0.08 over alpha"
        checks: Checks = {}
        for way in (0.02, 0.1, 0.2, 0.4):
            left = float(np.exp(-self.decay * way))
            at = self.length - way
            along = float(np.interp(at, place, force))
            across = float(np.interp(at, (place[1:] + place[:-1]) / 2, shear))
            checks[f"force {way:g} m from the collar (N)"] = Check(
                along, self.force * left, 1e-3, reason, scale=self.force
            )
            checks[f"shear stress there, {way:g} m (Pa)"] = Check(
                across, at_collar * left, 2e-3, reason, scale=at_collar
            )
        return checks
