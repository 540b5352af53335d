"""Water that presses on dams, slopes and submerged blocks."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from nmm.study.samples import fields
from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase, holds
from nmm.verification.reading import converged

if TYPE_CHECKING:
    from nmm.stepping.run import Run

EXACT = "statics of a rigid body; contact forces balance what acts to the residual of the step"


def water(name: str, more: str) -> str:
    """Table of a water pressure."""
    return f'[[water_pressures]]\nname = "{name}"\n{more}\n'


@dataclass(frozen=True)
class Dam(SceneCase):
    """A gravity dam on its joint, dry below or under full linear uplift."""

    name = "WA1"
    title = "Dam on a joint under uplift"
    source = "Equilibrium: base 24 m, crest 4 m, height 30 m, water 28 m"
    formulations = ("cone", "lagrange", "degree 2")
    uplift: bool = True
    parameters: ClassVar = {"uplift": (False, True)}

    @property
    def variant(self) -> str:
        return "uplift" if self.uplift else "no uplift"

    def scene(self) -> str:
        """Return the dam on a held foundation."""
        below = 'segment = [[0, 0], [24, 0]]\nblock = "dam"\npressures = [274680.0, 0.0]'
        return text.scene(
            'title = "Dam"\nplane = "strain"\n[gravity]\n[contact]\n',
            [
                text.material("concrete", 30e9, 0.2, 2400.0),
                text.interface("joint", 45.0),
                text.block("dam", "concrete", [(0, 0), (24, 0), (4, 30), (0, 30)]),
                text.box("rock", (-6, -10), (36, 10), "concrete"),
                text.fixed_block("rock"),
                water("reservoir", 'segment = [[0, 0], [0, 30]]\nblock = "dam"\nlevel = 28.0'),
                *([water("uplift", below)] if self.uplift else []),
            ],
        )

    def measure(self, run: "Run") -> Checks:
        last = run.frames[-1]
        base = np.abs(last.contact_position[:, 1]) < 0.01
        normal = -last.contact_force[base, 0]
        place = float(normal @ last.contact_position[base, 0] / normal.sum())
        shear = float(np.abs(last.contact_force[base, 1].sum()))
        upward = 3296160.0 if self.uplift else 0.0
        arm = 13.73015873 if self.uplift else 11.82010582
        near = "contacts turn with the block, by millimetres over 24 m"
        checks = {
            "normal force (N/m)": Check(float(normal.sum()), 9888480.0 - upward, 2e-5, near),
            "shear (N/m)": Check(shear, 3845520.0, 1e-4, near),
            "resultant from the heel (m)": Check(place, arm, 1e-3, near),
            "water on the face (N/m)": Check(
                run.history["water pressures:reservoir:x"][-1], 3845520.0, 1e-6, EXACT
            ),
        }
        slide = np.tan(np.radians(45)) * float(normal.sum()) / shear
        wanted = 1.71428571 if self.uplift else 2.57142857
        return checks | {"safety against sliding": Check(slide, wanted, 1e-4, near)}


@dataclass(frozen=True)
class PlaneFailure(SceneCase):
    """A slope that fails on a plane behind a crack full of water, 1 % this and that side of it."""

    name = "WA2"
    title = "Plane failure with a tension crack full of water"
    source = "Hoek and Bray's section; without cohesion safe from 42.413087 deg on"
    formulations = ("cone", "lagrange")
    share: float = 1.01
    parameters: ClassVar = {"share": (0.99, 1.01)}  # a slope that slides and one that holds
    label = "factor of safety {0.share:g}"

    def scene(self) -> str:
        """Return the block that slides, the ground below and behind it, and the water."""
        dip, high = np.radians(35), 60.0
        toe, crest = np.zeros(2), np.array([high / np.tan(np.radians(60)), high])
        # The crack meets the plane z below the crest's level.
        z = 14.0
        foot = np.array([(high - z) / np.tan(dip), high - z])
        top = np.array([foot[0], high])
        pull = f'segment = {[[0.0, 0.0], foot.tolist()]}\nblock = "slab"\n'
        pull += f"pressures = {[0.0, 9810.0 * z]}"
        face = f'segment = {[foot.tolist(), top.tolist()]}\nblock = "slab"\nlevel = 60.0'
        friction = float(np.degrees(np.arctan(self.share * np.tan(np.radians(42.413087)))))
        # The plane comes out of the ground at the toe and goes on below it.
        below = (-20.0, -20.0 * float(np.tan(dip)))
        ground = [below, (-20, -40), (120, -40), (120, 60), top, foot]
        return text.scene(
            'title = "Plane failure"\nplane = "strain"\n[gravity]\n[contact]\n',
            [
                text.material("rock", 20e9, 0.2, 26e3 / 9.81),
                text.interface("joint", friction),
                text.block("slab", "rock", np.array([toe, foot, top, crest])),
                text.block("ground", "rock", np.array(ground)),
                text.fixed_block("ground"),
                water("plane", pull),
                water("crack", face),
            ],
        )

    def measure(self, run: "Run") -> Checks:
        """Say whether it holds."""
        why = "1 % from the limit"
        if self.share > 1:
            return {"holds": holds(converged(run), why)}
        return {"slides": holds(run.summary.status in ("collapsed", "failure"), why)}


@dataclass(frozen=True)
class Submerged(SceneCase):
    """A block under water weighs what it displaces less, unless its base is sealed."""

    name = "WA8"
    title = "Buoyancy"
    source = "Archimedes: 2 m by 1 m, 2500 kg/m3, 5 m of water above the floor"
    formulations = ("cone", "degree 2")
    sealed: bool = False
    parameters: ClassVar = {"sealed": (False, True)}

    @property
    def variant(self) -> str:
        return "sealed base" if self.sealed else "water below"

    def scene(self) -> str:
        """Return the block on its floor."""
        sides = [((0, 0), (0, 1)), ((2, 0), (2, 1)), ((0, 1), (2, 1))]
        if not self.sealed:
            sides.append(((0, 0), (2, 0)))
        tables = [
            water(f"side {i}", f'segment = {[list(a), list(b)]}\nblock = "block"\nlevel = 5.0')
            for i, (a, b) in enumerate(sides)
        ]
        return text.scene(
            'title = "Submerged"\nplane = "strain"\n[gravity]\n[contact]\n',
            [
                text.material("rock", 20e9, 0.2, 2500.0),
                text.interface("joint", 30.0),
                text.box("block", (0, 0), (2, 1), "rock"),
                text.box("floor", (-1, -1), (4, 1), "rock"),
                text.fixed_block("floor"),
                *tables,
            ],
        )

    def measure(self, run: "Run") -> Checks:
        force = -float(run.frames[-1].contact_force[:, 0].sum())
        wanted = 127530.0 if self.sealed else 29430.0
        return {"force on the floor (N/m)": Check(force, wanted, 1e-6, EXACT)}


class PressurisedCrack(SceneCase):
    """Water in an inclined crack of a large plate opens it to an ellipse."""

    name, title = "WA7", "Crack under the pressure of its water"
    source = "Griffith (1921), Sneddon (1946): w = 4 (1 - nu^2) p a / E, work p V / 2 = 589.04862 J"
    formulations = ("manifold",)
    slow = True

    def scene(self) -> str:
        """Return a crack of 2 m under 2 MPa in a plate of 20 m."""
        tip = [0.9, 0.435889894354067]
        return text.scene(
            'title = "Pressurised crack"\nplane = "strain"\n',
            [
                text.material("rock", 20e9, 0.25, None),
                text.box("plate", (-10, -10), (20, 20), "rock"),
                f'[[cracks]]\nname = "crack"\npoints = {[[-x for x in tip], tip]}\n',
                # A level so high that the pressure is even to 1e-6.
                water("water", 'crack = "crack"\nlevel = 1e6\nunit_weight = 2.0'),
                text.fixed_point("a", [-10, -10]),
                text.fixed_point("b", [10, -10], "y"),
            ],
        )

    def measure(self, run: "Run") -> Checks:
        across = np.array([-0.435889894354067, 0.9])
        sides = fields(run, np.outer([1e-6, -1e-6], across)).displacement
        opening = float((sides[0] - sides[1]) @ across)
        plate = "the aim; a plate of ten half-lengths gives more than an endless one, by 1 %"
        return {
            "work (J)": Check(run.history["external_work"][-1], 589.04862, 0.02, plate),
            "opening in the middle (m)": Check(opening, 0.375e-3, 0.02, plate),
        }
