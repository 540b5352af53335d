"""Matter that creeps under a load that stays: in pure shear, under pressure, around a hole."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from integration.arrays import Floats
from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase, holds
from nmm.verification.continuum import quarter
from nmm.verification.reading import converged, way

if TYPE_CHECKING:
    from nmm.stepping.run import Run

# Shear moduli (Pa) and viscosities (Pa s) of the spring and dashpot in series and side by side.
SPRING, DASHPOT, DELAYED, DELAY = 10e9, 1e15, 5e9, 2e14
LAWS = {
    "maxwell": (("viscosity", DASHPOT),),
    "kelvin": (("viscosity", DELAY),),
    "standard_solid": (("delayed_modulus", DELAYED), ("delayed_viscosity", DELAY)),
    "burgers": (
        *(("viscosity", DASHPOT), ("delayed_modulus", DELAYED)),
        ("delayed_viscosity", DELAY),
    ),
}


def creeping(law: str, shear: float, poisson: float, constants: Sequence[tuple[str, float]]) -> str:
    """Table of a material "salt"."""
    young = 2 * shear * (1 + poisson)
    lines = [f'law = "{law}"', f"young_modulus = {young!r}", f"poisson_ratio = {poisson!r}"]
    lines += [f"{name} = {value!r}" for name, value in constants]
    return "[materials.salt]\n" + "\n".join(lines) + "\n"


def steps(length: float) -> str:
    """Table of the steps in time (s)."""
    return f"[formulation.integrator]\nstep = {length!r}\n"


def at_time(run: "Run", values: Floats, time: float) -> float:
    """Return the value (k,) of the last step that ends at a time (s)."""
    reached = np.flatnonzero(np.isclose(run.history["time"], time, rtol=1e-9))
    return float(values[reached[-1]])


@dataclass(frozen=True)
class ShearCreep(SceneCase):
    """A square in pure shear creeps as springs and dashpots do."""

    name = "VI1"
    title = "Creep of springs and dashpots"
    source = (
        "Creep functions t / eta, (1 - exp(-t G / eta)) / G and their sums; Findley et al. 1976"
    )
    formulations = ("dda", "manifold", "quads degree 2")
    law: str = "maxwell"
    stress = 1e6
    parameters: ClassVar = {"law": LAWS}
    label = "{0.law}"

    def scene(self) -> str:
        """Return the square: tractions along its sides from the start on."""
        corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
        ways = [(-1, 0), (0, 1), (1, 0), (0, -1)]
        sides = list(zip(corners, [*corners[1:], corners[0]], ways, strict=True))
        return text.scene(
            'title = "Creep in shear"\nplane = "strain"\nduration = 1e5\n',
            [
                creeping(
                    self.law, DELAYED if self.law == "kelvin" else SPRING, 0.25, LAWS[self.law]
                ),
                text.box("square", (0, 0), (1, 1), "salt"),
                text.fixed_point("pin", [0, 0]),
                text.fixed_point("slide", [1, 0], "y"),
                *(
                    text.pulled_edge(f"side{number}", (a, b), (self.stress * x, self.stress * y))
                    for number, (a, b, (x, y)) in enumerate(sides)
                ),
                text.monitor("top", (0, 1), "square"),
                steps(1000.0),
            ],
        )

    def strain(self, time: float) -> float:
        """Return the shear strain at a time (s)."""
        delayed = (1 - np.exp(-time * DELAYED / DELAY)) / DELAYED
        at_once = 0.0 if self.law == "kelvin" else 1 / SPRING
        flows = time / DASHPOT if self.law in ("maxwell", "burgers") else 0.0
        return float(self.stress * (at_once + flows + delayed * (self.law != "maxwell")))

    def measure(self, run: "Run") -> Checks:
        found = way(run, "top")[:, 0]
        why = "steps of a fortieth of the delay"
        return {
            **{
                f"shear after {time:g} s": Check(
                    at_time(run, found, time), self.strain(time), 1e-3, why
                )
                for time in (1e4, 1e5)
            },
            "at rest": holds(converged(run), "every step is in equilibrium"),
        }


class PressedCreep(SceneCase):
    """A block under pressure in plane strain settles at once, then ever on.

    Its volume is elastic, so that the pressure across delays the flow.
    """

    name = "VI2"
    title = "Creep under pressure in plane strain"
    source = (
        "Laplace transform: s / 4 (1 / G + t / eta + 3 (1 / 3K + (1 / (3K + G) - 1 / 3K) "
        "exp(-3 K t / (tau (3K + G)))))"
    )
    formulations = ("dda", "manifold", "quads degree 2")
    shear = 4e9
    viscosity = 4e14

    def scene(self) -> str:
        """Return the block on rollers."""
        return text.scene(
            'title = "Creep under pressure"\nplane = "strain"\nduration = 1e5\n',
            [
                creeping("maxwell", self.shear, 0.25, [("viscosity", self.viscosity)]),
                text.box("block", (0, 0), (1, 1), "salt"),
                text.fixed_edge("base", [(0, 0), (1, 0)], "y"),
                text.fixed_point("pin", [0, 0], "x"),
                text.pulled_edge("press", [(0, 1), (1, 1)], [0, -1e6]),
                text.monitor("top", (0.5, 1), "block"),
                text.monitor("base", (0.5, 0), "block"),
                steps(1000.0),
            ],
        )

    def strain(self, time: float) -> float:
        """Return the strain at a time (s)."""
        g, k, relaxes = self.shear, 20e9 / 3, self.viscosity / self.shear
        fades = np.exp(-3 * k * time / (relaxes * (3 * k + g)))
        volume = 3 * (1 / (3 * k) + (1 / (3 * k + g) - 1 / (3 * k)) * fades)
        return float(1e6 / 4 * (1 / g + time / self.viscosity + volume))

    def measure(self, run: "Run") -> Checks:
        found = (way(run, "base") - way(run, "top"))[:, 1]
        why = "steps of a hundredth of the relaxation"
        return {
            **{
                f"strain after {time:g} s": Check(
                    at_time(run, found, time), self.strain(time), 1e-3, why
                )
                for time in (1e3, 1e4, 1e5)
            },
            "at rest": holds(converged(run), "every step is in equilibrium"),
        }


class CylinderCreep(SceneCase):
    """A thick cylinder under inner pressure creeps; stresses in its plane stay elastic."""

    name = "VI3"
    title = "Thick cylinder that creeps"
    source = (
        "Lame's stresses at all times, the strain by Laplace transform: u(a) 1.875e-4 m at once, "
        "3.565225075e-4 m after the relaxation time"
    )
    formulations = ("manifold degree 2", "quads degree 2")
    sides = 32

    def scene(self) -> str:
        """Return a quarter, a = 1, b = 2, under 1 MPa."""
        inner = quarter(1.0, self.sides)
        pushes = []
        for number, (start, end) in enumerate(pairwise(inner)):
            out = 1e6 * (start + end) / np.linalg.norm(start + end)
            pushes.append(text.pulled_edge(f"p{number}", [tuple(start), tuple(end)], out))
        return text.scene(
            'title = "Cylinder that creeps"\nplane = "strain"\nduration = 1e5\n',
            [
                creeping("maxwell", 4e9, 0.25, [("viscosity", 4e14)]),
                text.block("ring", "salt", np.concatenate([inner, 2 * inner[::-1]])),
                text.fixed_edge("x", [(0, 1), (0, 2)], "x"),
                text.fixed_edge("y", [(1, 0), (2, 0)], "y"),
                *pushes,
                text.monitor("inner", (1, 0), "ring"),
                steps(5000.0),
            ],
        )

    def measure(self, run: "Run") -> Checks:
        found = way(run, "inner")[:, 0]
        why = "32 sides for the quarter circle; the aim is 1 %"
        return {
            "u(a) at once (m)": Check(at_time(run, found, 0.0), 1.875e-4, 0.01, why),
            "u(a) after 1e5 s (m)": Check(at_time(run, found, 1e5), 3.565225075e-4, 0.01, why),
            "at rest": holds(converged(run), "every step is in equilibrium"),
        }
