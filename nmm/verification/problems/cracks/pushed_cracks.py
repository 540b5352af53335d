"""Cracks that are not free: under water, pressed shut, in stressed and in heated ground."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import atan, cos, pi, radians, sin, sqrt
from typing import TYPE_CHECKING, Self

import numpy as np

from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase
from nmm.verification.problems.cracks.crack_scenes import crack

if TYPE_CHECKING:
    from nmm.stepping.run import Run

MODULUS, POISSON, EXPANSION = 1e10, 0.2, 1e-5
# Half of the crack and of the plate (m), load (Pa), and slope of the temperature (K/m).
A, HALF, LOAD, SLOPE = 0.1, 1.0, 1e6, 100.0
SHUT = "; pressures are hats as wide as cells, up to 3 % of K_I on cells of 0.02 to 0.05"
# Cells (m), and what they leave of the intensities.
SIZE, REASON = 0.03, "the plate is ten cracks wide (0.6 %); cells of a seventh of a crack"


@dataclass(frozen=True)
class PushedCrack(SceneCase):
    """A crack in a wide plate, ``inclined`` from the vertical load (deg)."""

    name = "GR16"
    title = "Intensities of cracks under water, pressed shut, and heated"
    source = (
        "Closed forms in an infinite plane: p sqrt(pi a); (tau - mu sigma) sqrt(pi a) where faces "
        "slide; E alpha grad T a sqrt(pi a) / (4 (1 - nu)) of heat across a tight crack (Sih 1962)"
    )
    formulations = ("dda",)
    acts: str = "water"
    inclined: float = 90.0
    friction: float = 0.3
    slow = True

    @classmethod
    def variants(cls) -> Sequence[Self]:
        """Return all that acts, three inclinations, and one at which the faces stick."""
        shut = [cls("pressed shut", *one) for one in ((45, 0.3), (30, 0.2), (60, 0.1), (45, 1.2))]
        return [cls(), cls("stress from the start"), *shut, cls("heat")]

    @property
    def variant(self) -> str:
        how = f" at {self.inclined:g} degrees, friction {self.friction:g}"
        return self.acts + how * (self.acts == "pressed shut")

    def scene(self) -> str:
        """Return the plate with what acts on it."""
        turn = radians(self.inclined)
        end = [A * sin(turn), A * cos(turn)]
        low, high = [-HALF, -HALF], [HALF, HALF]
        rock = text.material("rock", modulus=MODULUS, poisson=POISSON, density=None)
        return text.scene(
            'title = "Plate with a crack"\nplane = "strain"\n',
            [
                rock + f"thermal_expansion = {EXPANSION}\nconductivity = 2.0\n",
                text.interface("any", float(np.degrees(atan(self.friction)))),
                text.block("plate", "rock", text.rectangle((-HALF, -HALF), (HALF, HALF))),
                crack("c", [[-end[0], -end[1]], end]),
                "[fracture]\ntoughness = 1e12\nincrement = 0.03\n",
                text.fixed_point("one", low),
                text.fixed_point("other", [high[0], low[1]], "y"),
                self._acting(),
                f'[formulation.cover]\ntype = "triangles"\nsize = {SIZE}\nangle = 0.19\n',
            ],
        )

    def _acting(self) -> str:
        top, bottom = [[-HALF, HALF], [HALF, HALF]], [[-HALF, -HALF], [HALF, -HALF]]

        def pulled(size: float) -> str:
            return text.pulled_edge("top", top, [0.0, size]) + text.pulled_edge(
                "bottom", bottom, [0.0, -size]
            )

        def warm(name: str, edge: list[list[float]], size: float) -> str:
            return f'[[temperatures]]\nname = "{name}"\nsegment = {edge}\ntemperature = {size}\n'

        t = SLOPE * HALF
        water = f'name = "w"\ncrack = "c"\npressure = {LOAD}\n'
        stress = f'block = "all"\nstress = [0, {LOAD}, 0]\n'
        exact = '[contact]\n[formulation.contact]\nenforcement = "lagrange"\n'
        acting: Mapping[str, str] = {
            "water": f"[[water_pressures]]\n{water}",
            "stress from the start": f"{pulled(LOAD)}[[initial_stresses]]\n{stress}",
            "pressed shut": pulled(-LOAD) + exact,
            "heat": "[heat]\nreference = 0.0\n" + warm("n", top, t) + warm("s", bottom, -t),
        }
        return acting[self.acts]

    @property
    def expected(self) -> tuple[float, float]:
        """K_I and K_II at the end of the crack (Pa m^1/2)."""
        turn = radians(self.inclined)
        pressed, shear = LOAD * sin(turn) ** 2, LOAD * sin(turn) * cos(turn)
        root = sqrt(pi * A)
        if self.acts == "heat":
            return 0.0, MODULUS * EXPANSION * SLOPE * A * root / (4 * (1 - POISSON))
        if self.acts == "pressed shut":
            return 0.0, -max(shear - self.friction * pressed, 0.0) * root
        return LOAD * root, 0.0

    def measure(self, run: "Run") -> Checks:
        scale = max(map(abs, (*self.expected, LOAD * sqrt(pi * A) * (self.acts != "heat"))))
        shut = self.acts == "pressed shut"
        tolerance = 0.035 if shut else 0.02
        reason = REASON + SHUT * shut
        found = (run.history[f"fracture:c:end:{name}"][-1] for name in ("K_I", "K_II"))
        return {
            f"{name} (Pa m^1/2)": Check(float(one), right, tolerance, reason, scale)
            for name, one, right in zip(("K_I", "K_II"), found, self.expected, strict=True)
        }
