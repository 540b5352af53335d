"""Plastic regions that grow in a body: about a hole under pressure, below a footing."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, ClassVar, Self

import numpy as np

from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase, holds
from nmm.verification.continuum import quarter
from nmm.verification.problems.solids.plasticity import flowing
from nmm.verification.reading import way

if TYPE_CHECKING:
    from nmm.stepping.run import Run


@dataclass(frozen=True)
class PlasticCylinder(SceneCase):
    """A thick cylinder under inner pressure flows from inside out until it is plastic throughout.

    By Tresca's law, as which Mohr-Coulomb acts without friction, the closed form is exact while the
    stress across is between the others. By von Mises it is for matter that is nearly
    incompressible, whose stress across is the mean of the others; the collapse is in any case.
    """

    name = "PL3"
    title = "Thick cylinder that flows"
    source = (
        "Hill 1950: p = k (1 - c^2 / b^2 + 2 ln(c / a)), u(b) = 2 (1 - nu^2) k c^2 / (E b), "
        "collapse 2 k ln(b / a), k = 1"
    )
    formulations = ("manifold degree 2", "quads degree 2")
    law: str = "von_mises"
    modulus = 1000.0
    sides = 32
    parameters: ClassVar = {"law": ("von_mises", "mohr_coulomb")}
    label = "{0.law}"
    slow = True

    @property
    def poisson(self) -> float:
        """Poisson's ratio."""
        return 0.49 if self.law == "von_mises" else 0.3

    def scene(self) -> str:
        """Return a quarter, a = 1, b = 2; the load factor is the pressure over k = 1 Pa."""
        inner = quarter(1.0, self.sides)
        steel = flowing(np.sqrt(3.0).item(), self.modulus, self.poisson)
        if self.law == "mohr_coulomb":
            steel = (
                f'[materials.steel]\nlaw = "mohr_coulomb"\nyoung_modulus = {self.modulus!r}\n'
                f"poisson_ratio = {self.poisson!r}\ncohesion = 1.0\nfriction_angle = 0.0\n"
            )
        pushes = []
        for number, (start, end) in enumerate(pairwise(inner)):
            out = (start + end) / np.linalg.norm(start + end)
            pushes.append(text.pulled_edge(f"p{number}", [tuple(start), tuple(end)], out))
        return text.scene(
            'title = "Cylinder that flows"\nplane = "strain"\n',
            [
                steel,
                text.block("ring", "steel", np.concatenate([inner, 2 * inner[::-1]])),
                text.fixed_edge("x", [(0, 1), (0, 2)], "x"),
                text.fixed_edge("y", [(1, 0), (2, 0)], "y"),
                *pushes,
                text.monitor("outer", (2, 0), "ring"),
                '[loading]\nuntil = "failure"\nmaximum_factor = 2.0\n',
                "[formulation.loading]\nincrement = 0.1\ntolerance = 0.002\n",
            ],
        )

    def measure(self, run: "Run") -> Checks:
        at = run.history["load_factor"]
        checks: Checks = {}
        for wanted in (0.9, 1.2, 1.3):
            step = int(np.argmin(np.abs(at - wanted)))
            c = plastic_radius(float(at[step]))
            expected = (1 - self.poisson**2) * c**2 / self.modulus
            found = float(way(run, "outer")[step, 0])
            checks[f"u(b) at p = {wanted} k (m)"] = Check(found, expected, 0.02, "the aim is 1 %")
        checks["collapse over k"] = Check(
            run.summary.failure_factor or np.nan,
            2 * np.log(2),
            0.02,
            "the bracket, and a displacement method's limit from above",
        )
        checks["a mechanism"] = holds(
            run.summary.status == "failure_load", "failing is shown to be the structure's"
        )
        return checks


@dataclass(frozen=True)
class Footing(SceneCase):
    """A strip footing on weightless soil sinks in at Prandtl's pressure.

    Half of it is modelled; a displacement method comes from above. The pressure is given, so that
    whether the footing is smooth or rough makes no difference.
    """

    name = "PL4"
    title = "Strip footing"
    source = "Prandtl 1920, Reissner 1924: Nc = 2 + pi without friction, 14.8347 at 20"
    formulations = ("quads degree 2",)
    friction: int = 0
    law: str = "mohr_coulomb"

    @classmethod
    def variants(cls) -> Sequence[Self]:
        """Return clay, and soil with friction whose dilation is as large.

        Drucker and Prager's cone that is matched in plane strain collapses under the same load.
        """
        return [cls(0), cls(20), cls(20, "drucker_prager")]

    @property
    def variant(self) -> str:
        cone = ", cone" if self.law == "drucker_prager" else ""
        return f"phi {self.friction}{cone}"

    @property
    def slow(self) -> bool:
        """Half a minute with friction."""
        return self.friction > 0

    @property
    def capacity(self) -> float:
        """Pressure over cohesion at failure."""
        if not self.friction:
            return 2 + np.pi
        angle = np.radians(self.friction)
        quotient = np.exp(np.pi * np.tan(angle)) * np.tan(np.pi / 4 + angle / 2) ** 2
        return float((quotient - 1) / np.tan(angle))

    def scene(self) -> str:
        """Return the soil beside the middle, deep and wide enough for the mechanism."""
        wide, deep = (4.0, 2.0) if not self.friction else (7.0, 3.0)
        angles = f'"{self.friction} deg"'
        match = 'match = "plane_strain"\n' if self.law == "drucker_prager" else ""
        return text.scene(
            'title = "Strip footing"\nplane = "strain"\n',
            [
                f'[materials.soil]\nlaw = "{self.law}"\nyoung_modulus = 1000.0\n'
                f"poisson_ratio = 0.3\ncohesion = 1.0\nfriction_angle = {angles}\n"
                f"dilation_angle = {angles}\n{match}",
                text.block("soil", "soil", [(0, 0), (wide, 0), (wide, deep), (1, deep), (0, deep)]),
                text.fixed_edge("middle", [(0, 0), (0, deep)], "x"),
                text.fixed_edge("far", [(wide, 0), (wide, deep)], "x"),
                text.fixed_edge("base", [[0, 0], [wide, 0]]),
                text.pulled_edge("footing", [(0, deep), (1, deep)], [0, -1]),
                f'[loading]\nuntil = "failure"\nmaximum_factor = {2 * self.capacity!r}\n',
                f"[formulation.loading]\nincrement = {self.capacity / 10!r}\ntolerance = 0.005\n",
            ],
        )

    def measure(self, run: "Run") -> Checks:
        found = run.summary.failure_factor or np.nan
        return {
            "pressure over cohesion": Check(
                found, self.capacity, 0.08, "half a metre of cells under half a footing of one"
            ),
            "from above": Check(
                found, self.capacity, 0.005, "the bracket of 0.5 %", bound="at_least"
            ),
            "a mechanism": holds(
                run.summary.status == "failure_load", "failing is shown to be the structure's"
            ),
        }


def plastic_radius(pressure: float) -> float:
    """Return the radius c of the plastic zone, a = 1, b = 2, at a pressure over k."""
    low, high = 1.0, 2.0
    for _ in range(60):
        c = (low + high) / 2
        low, high = (c, high) if 1 - c**2 / 4 + 2 * np.log(c) < pressure else (low, c)
    return low
