"""Bars and bolts: shear lag, pull-out, a joint that opens, blocks that hang and slide."""

from typing import TYPE_CHECKING

import numpy as np

from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase, holds
from nmm.verification.reading import converged, last_way

if TYPE_CHECKING:
    from nmm.stepping.run import Run
GROUTED = """
[[bars]]
name = "bolt"
points = [[-1.5, 0], [1.5, 0]]
diameter = "25 mm"
young_modulus = "200 GPa"
bond = { stiffness = "5 GPa/m" }
[[supports]]
name = "left"
segment = [[-1.5, -0.5], [-1.5, 0.5]]
fix = ["x", "y"]
[[supports]]
name = "right"
segment = [[1.5, -0.5], [1.5, 0.5]]
fix = ["x", "y"]
displacement = ["0.5 mm", 0]
"""


class GroutedBolt(SceneCase):
    """A grouted bolt across a joint resists its opening as two bars that are pulled out."""

    name = "BO4"
    title = "Grouted bolt across an opening joint"
    source = "T = E A beta tanh(beta L) w / 2"
    formulations = ("dda", "manifold")

    def scene(self) -> str:
        """Return two blocks that part by half a millimetre."""
        return text.scene(
            'plane = "stress"',
            [
                text.material("rock", modulus=1e15, poisson=0.0, density=None),
                text.block("left", "rock", text.rectangle((-1.5, -0.5), (0, 0.5))),
                text.block("right", "rock", text.rectangle((0, -0.5), (1.5, 0.5))),
                GROUTED,
            ],
        )

    def measure(self, run: "Run") -> Checks:
        force = float(run.history["bars:bolt:force"][-1])
        reason = "order 2: an eighth of the square of pieces of 0.15 over beta"
        return {"force across the joint (N)": Check(force, 48844.636, 4e-3, reason)}


DOWEL = """
[[bars]]
name = "bolt"
points = [[-0.9, 0], [0.9, 0]]
diameter = "25 mm"
young_modulus = "200 GPa"
ends = "free"
bond = { stiffness = 1 }
dowel = { bedding_stiffness = "50 MPa" }
[[supports]]
name = "left"
block = "left"
fix = ["x", "y"]
[[supports]]
name = "right"
block = "right"
fix = ["x", "y"]
displacement = [0, "12.089477 mm"]
"""


class DoweledJoint(SceneCase):
    """A bolt across a joint that slides bends against its bed on both sides."""

    name = "BO4 dowel"
    title = "Dowel action of a bolt across a sliding joint"
    source = "w = 4 V l / k, M = 0.3224 V / l, l = (k / (4 E I))^(1/4) (Hetenyi 1946)"
    formulations = ("dda", "manifold", "degree 2")

    def scene(self) -> str:
        """Return two blocks, one of which moves along the joint by what 20 kN take."""
        return text.scene(
            'plane = "stress"',
            [
                text.material("rock", modulus=1e13, poisson=0.0, density=None),
                text.block("left", "rock", text.rectangle((-1, -0.5), (0, 0.5))),
                text.block("right", "rock", text.rectangle((0, -0.5), (1, 0.5))),
                DOWEL,
            ],
        )

    def measure(self, run: "Run") -> Checks:
        shear, moment = (
            float(run.history[f"dowels:bolt:{what}"][-1]) for what in ("shear", "moment")
        )
        reason = "printed digits, and what the blocks strain"
        return {
            "shear force (N)": Check(shear, 20e3, 1e-4, reason),
            "largest moment (N m)": Check(moment, 853.362, 1e-4, reason),
        }


class BoltedBlock(SceneCase):
    """A block slides down a plane until its bolt takes what friction does not."""

    name = "BO5 plane"
    title = "Bolted block on a plane"
    source = "T = W (sin a - cos a tan phi) / (cos b + sin b tan phi)"
    formulations = ("dda", "lagrange", "cone")

    def scene(self) -> str:
        """Return the plane drawn level, weight turned by 40 degrees, the bolt at 60."""
        slope, bolt, pull = np.radians(40), np.radians(60), 100e3 / 2000
        anchor = [0.5 - 2 * np.cos(bolt), 0.5 - 2 * np.sin(bolt)]
        down = [pull * np.sin(slope), -pull * np.cos(slope)]
        return text.scene(
            'plane = "stress"\n[contact]',
            [
                text.material("rock", modulus=1e12, poisson=0.0, density=1000.0),
                text.interface("joint", 30.0),
                text.block("base", "rock", text.rectangle((-3, -3), (5, 0))),
                text.block("block", "rock", text.rectangle((0, 0), (2, 1))),
                text.fixed_edge("floor", [[-3, -3], [5, -3]]),
                f"[gravity]\nacceleration = {[float(g) for g in down]}\n",
                f'[[springs]]\nname = "bolt"\npoints = [[0.5, 0.5], {[float(x) for x in anchor]}]\n'
                'blocks = ["block", "base"]\nstiffness = "20 MN/m"\n',
                text.monitor("block", (1, 0), "block"),
            ],
        )

    def measure(self, run: "Run") -> Checks:
        force = float(run.history["springs:bolt:force"][-1])
        slid = float(last_way(run, "block")[0])
        reason = "the bolt turns by a thousandth as the block slides"
        return {
            "in equilibrium": holds(converged(run), "statics ends at load factor 1"),
            "force of the bolt (N)": Check(force, 20051.164, 3e-3, reason),
            "slip (m)": Check(slid, 2.00511644e-3, 3e-3, reason),
        }


BOLT = """
[[bars]]
name = "{name}"
points = [[{x}, 3], [{x}, 0]]
blocks = ["roof", "block"]
diameter = "25 mm"
young_modulus = "200 GPa"
pretension = "20 kN"
"""


class HungBlock(SceneCase):
    """A block hangs on two pretensioned bolts: the joint opens by what they lack."""

    name = "BO5 roof"
    title = "Block hung on two pretensioned bolts"
    source = "Balance of forces, E A / L = 32.724923 MN/m"
    formulations = ("dda", "lagrange", "cone", "finite elements")

    def scene(self) -> str:
        """Return a roof with 60 kN under it, on bolts of 20 kN each."""
        return text.scene(
            'plane = "stress"\n[contact]\n[gravity]',
            [
                text.material("rock", modulus=1e13, poisson=0.0, density=30e3 / text.G),
                text.interface("joint", 30.0),
                text.block("roof", "rock", text.rectangle((0, 0), (4, 3))),
                text.block("block", "rock", text.rectangle((1, -1), (3, 0))),
                text.fixed_edge("top", [[0, 3], [4, 3]]),
                *(BOLT.format(name=name, x=x) for name, x in (("left", 1.5), ("right", 2.5))),
                text.monitor("block", (2, -1), "block"),
            ],
        )

    def measure(self, run: "Run") -> Checks:
        reason = "the roof gives way by 1e-3 of a bolt"
        forces = (float(run.history[f"bars:{name}:force"][-1]) for name in ("left", "right"))
        opening = float(-last_way(run, "block")[1])
        checks = {
            f"force of the {name} bolt (N)": Check(force, 30e3, 1e-3, reason)
            for name, force in zip(("left", "right"), forces, strict=True)
        }
        return checks | {"opening (m)": Check(opening, 0.305577e-3, 4e-3, reason)}
