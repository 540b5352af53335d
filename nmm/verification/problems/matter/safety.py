"""Factors of safety by strength reduction: a slope of soil, and wedges of rock on a plane."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase, holds
from nmm.verification.text import G

if TYPE_CHECKING:
    from nmm.stepping.run import Run

WEIGHT = 20e3
"""Of soil (N/m3)."""


class SoilSlope(SceneCase):
    """A slope 2 to 1 on firm ground: phi = 20, c / (gamma H) = 0.05, no dilation.

    A factor fails where no equilibrium is found under the weight; matter then flows with less than
    a hundredth of its elastic stiffness. Tension is limited by the apex alone.
    """

    name = "PL5"
    title = "Slope of soil: strength reduction"
    source = (
        "Griffiths and Lane 1999 (1.4), Bishop and Morgenstern (1.380), log-spiral upper bound for "
        "associated flow 1.3978"
    )
    formulations = ("quads degree 2",)
    slow = True
    cover: ClassVar = {"size": 1.25}

    def scene(self) -> str:
        """Return the slope, 10 m high, its crest 22 m wide."""
        return text.scene(
            'title = "Slope of soil"\nplane = "strain"\n',
            [
                '[materials.soil]\nlaw = "mohr_coulomb"\nyoung_modulus = 1e8\n'
                f"poisson_ratio = 0.3\ndensity = {WEIGHT / 9.81!r}\ncohesion = 1e4\n"
                'friction_angle = "20 deg"\n',
                text.block("slope", "soil", [(0, 0), (42, 0), (42, 10), (20, 10)]),
                text.fixed_edge("base", [[0, 0], [42, 0]]),
                text.fixed_edge("far", [[42, 0], [42, 10]], "x"),
                "[gravity]\n[strength_reduction]\nlowest = 0.8\nhighest = 2.0\n",
            ],
        )

    def measure(self, run: "Run") -> Checks:
        low, high = run.summary.factor_of_safety or np.nan, run.summary.factor_that_fails or np.nan
        band = "1.34 to 1.40 hold limit analyses and finite elements"
        return {
            "factor of safety": Check((low + high) / 2, 1.37, 0.03 / 1.37, band),
            "width of the bracket": Check(high - low, 0.01, 0.0, "as asked", bound="at_most"),
            "failing is the structure's": holds(
                run.summary.status == "converged", "matter is shown to flow"
            ),
        }


@dataclass(frozen=True)
class SlidingWedge(SceneCase):
    """A slope of rock whose joint comes out at its foot: the wedge above slides along it.

    Blocks are deformable and the joint follows them: lengths differ by strains of 1e-5.
    """

    name = "PL5 plane"
    title = "Wedge on a joint: strength reduction"
    source = "Plane failure (Hoek and Bray 1981): (c A + W cos beta tan phi) / (W sin beta)"
    formulations = ("dda",)
    face: float = 60.0
    joint: float = 35.0
    friction: float = 45.0
    cohesion: float = 0.0
    cut: bool = False

    height = 10.0
    density = 2600.0

    @classmethod
    def variants(cls) -> "tuple[SlidingWedge, ...]":
        """Without and with cohesion, steeper, and cut by a cross joint that changes nothing."""
        return (
            cls(),
            cls(friction=30.0, cohesion=20e3),
            cls(face=70.0, joint=40.0, friction=30.0, cohesion=40e3),
            cls(cut=True),
        )

    @property
    def variant(self) -> str:
        said = f"face {self.face:g}, joint {self.joint:g}, friction {self.friction:g}"
        more = f", cohesion {self.cohesion / 1e3:g} kPa" if self.cohesion else ""
        return said + more + (", cut" if self.cut else "")

    @property
    def _corners(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Crest, and end of the joint at the top."""
        slopes = np.tan(np.radians([self.face, self.joint]))
        crest, back = self.height / slopes
        return (float(crest), self.height), (float(back), self.height)

    @property
    def factor(self) -> float:
        """The closed form."""
        crest, back = self._corners
        angle = np.radians(self.joint)
        weight = self.density * G * self.height * (back[0] - crest[0]) / 2
        shear = self.cohesion * self.height / np.sin(angle)
        rubs = weight * np.cos(angle) * np.tan(np.radians(self.friction))
        return float((shear + rubs) / (weight * np.sin(angle)))

    def scene(self) -> str:
        """Return the wedge on rock that goes on along the joint."""
        crest, back = self._corners
        up = (back[0] + 2, back[1] + 2 * float(np.tan(np.radians(self.joint))))
        right = up[0] + 4
        base = [(0, -4), (right, -4), (right, up[1]), up, (0, 0)]
        cross = (
            '[[joint_sets]]\nname = "cross"\nblock = "wedge"\ndip = "110 deg"\nspacing = 4.0\n'
            f"origin = [{crest[0] + 2}, {crest[1]}]\n"
        )
        return text.scene(
            'title = "Plane failure"\nplane = "strain"\n',
            [
                text.material("rock", 10e9, 0.25, self.density),
                f'[interfaces.joint]\nfriction_angle = "{self.friction} deg"\n'
                f"cohesion = {self.cohesion}\n",
                text.block("base", "rock", base),
                text.block("wedge", "rock", [(0, 0), back, crest]),
                cross if self.cut else "",
                text.fixed_block("base"),
                "[gravity]\n[contact]\n[strength_reduction]\n",
            ],
        )

    def measure(self, run: "Run") -> Checks:
        low, high = run.summary.factor_of_safety or np.nan, run.summary.factor_that_fails or np.nan
        strained = "rigid bodies in the closed form"
        return {
            "factor that fails": Check(high, self.factor, 1e-4, f"{strained}; a theorem's bound"),
            "factor that holds": Check(
                low, self.factor * (1 + 1e-4), 0.0, strained, bound="at_most"
            ),
            "width of the bracket": Check(high - low, 0.01, 1e-9, "as asked", bound="at_most"),
        }
