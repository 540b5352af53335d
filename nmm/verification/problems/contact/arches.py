"""Structures that stand by thrust alone: a beam of two blocks, and arches of voussoirs."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase, holds
from nmm.verification.reading import converged, joint_force, last_way
from nmm.verification.text import G

if TYPE_CHECKING:
    from nmm.stepping.run import Run

DENSITY = 2600.0
STIFF = 1e13
"""Young's modulus of blocks that hardly shorten (Pa)."""


def _head(title: str, more: str = "") -> str:
    return f'title = "{title}"\nplane = "stress"\n[gravity]\n[contact]\n{more}'


@dataclass(frozen=True)
class ThreeHinges(SceneCase):
    """Two blocks between abutments carry their weight by hinges at the crown and the feet."""

    name = "B25"
    title = "Voussoir beam of two blocks, span 2 l, depth t"
    source = "Moments about the hinges: H = w l / (2 t); slides iff tan phi < 2 t / l"
    formulations = ("rigid", "dda")
    half_span = 4.0
    depth = 1.0
    friction: float = 40.0
    # Friction that holds with ease, hardly, and not.
    parameters: ClassVar = {"friction": (40.0, 27.5, 25.5)}
    label = "phi {0.friction}"

    def scene(self) -> str:
        """Return both blocks between two held ones."""
        span, depth = self.half_span, self.depth
        return text.scene(
            _head("Beam of two blocks"),
            [
                text.material("rock", modulus=STIFF, poisson=0.0, density=DENSITY),
                text.interface("contact", self.friction),
                text.box("west", (-span - 1, -1), (1, depth + 2)),
                text.box("east", (span, -1), (1, depth + 2)),
                text.box("left", (-span, 0), (span, depth)),
                text.box("right", (0, 0), (span, depth)),
                text.fixed_block("west"),
                text.fixed_block("east"),
                text.monitor("crown", (0, depth), "left"),
            ],
        )

    def measure(self, run: "Run") -> Checks:
        across = np.array([1.0, 0.0])
        if np.tan(np.radians(self.friction)) < 2 * self.depth / self.half_span:
            # They may come to rest far below, at the lower corners of the held blocks.
            fell = not converged(run) or float(last_way(run, "crown")[1]) < -0.1
            return {"slides": holds(fell, "1 degree below the limit")}
        weight = DENSITY * G * self.half_span * self.depth
        thrust = weight * self.half_span / (2 * self.depth)
        at_foot = joint_force(run, across * -self.half_span, across)
        at_crown = joint_force(run, 0 * across, across)
        rigid = "hinges lie within 1e-6 m of the corners of stiff blocks"
        return {
            "thrust at the foot (N)": Check(-float(at_foot[0]), thrust, 1e-3, rigid),
            "thrust at the crown (N)": Check(-float(at_crown[0]), thrust, 1e-3, rigid),
            "shear at the foot (N)": Check(abs(float(at_foot[1])), weight, 1e-3, rigid),
            "shear at the crown (N)": Check(
                float(at_crown[1]), 0.0, 1e-3, "symmetry", scale=weight
            ),
        }


def voussoirs(inner: float, outer: float, embrace: float, number: int) -> list[str]:
    """Tables of an arch about the origin, cut along radii; straight faces; both feet held."""
    angle = np.pi / 2 + embrace * (np.arange(number + 3) - (number + 2) / 2) / number
    inside, outside = (r * np.column_stack([np.cos(angle), np.sin(angle)]) for r in (inner, outer))
    tables = []
    for k in range(number + 2):
        name = {0: "east", number + 1: "west"}.get(k, f"stone {k}")
        corners = np.array([inside[k], outside[k], outside[k + 1], inside[k + 1]])
        tables.append(text.block(name, "rock", corners))
    return [*tables, text.fixed_block("east"), text.fixed_block("west")]


@dataclass(frozen=True)
class Semicircle(SceneCase):
    """A semicircular arch of 27 voussoirs stands if it is thick enough."""

    name = "B26"
    title = "Least thickness of a semicircular arch"
    source = "Linear programme for 27 straight voussoirs: t / R = 0.10672"
    formulations = ("rigid",)
    share: float = 1.05
    number = 27
    # Arches 5 % thicker and 5 % thinner than the least.
    parameters: ClassVar = {"share": (1.05, 0.95)}
    label = "t {0.share} of the least"

    @property
    def slow(self) -> bool:
        """A falling arch is followed down."""
        return self.share < 1

    def scene(self) -> str:
        """Return the arch with a mean radius of 10 m."""
        half = self.share * 0.10672 * 10 / 2
        return text.scene(
            _head("Semicircular arch"),
            [
                text.material("rock", modulus=STIFF, poisson=0.0, density=DENSITY),
                text.interface("contact", 75.0),
                *voussoirs(10 - half, 10 + half, np.pi, self.number),
            ],
        )

    def measure(self, run: "Run") -> Checks:
        """Say whether statics finds an equilibrium."""
        stands = self.share > 1
        reason = "5 % of 1 m is far above the give of stiff contacts"
        return {"stands" if stands else "falls": holds(converged(run) == stands, reason)}


class ShakenArch(SceneCase):
    """An arch of seven voussoirs fails under a horizontal share of its weight."""

    name = "B27"
    title = "Arch under horizontal acceleration"
    source = "Linear programme: lambda = 0.37361 for t / R = 0.15, 157.5 degrees"
    formulations = ("rigid",)

    def scene(self) -> str:
        """Return the arch with a body force that grows until it fails."""
        return text.scene(
            _head(
                "Arch under horizontal acceleration",
                '[loading]\nuntil = "failure"\n[formulation.loading]\n'
                "increment = 0.05\ntolerance = 0.002\n",
            ),
            [
                text.material("rock", modulus=STIFF, poisson=0.0, density=DENSITY),
                text.interface("contact", 75.0),
                *voussoirs(9.25, 10.75, float(np.radians(157.5)), 7),
                f'[[loads]]\nname = "push"\nkind = "body"\ndensity = [{DENSITY * G!r}, 0]\n',
            ],
        )

    def measure(self, run: "Run") -> Checks:
        found = run.summary.failure_factor
        return {
            "factor": Check(
                float("nan") if found is None else found, 0.37361, 0.03, "the benchmark's"
            )
        }
