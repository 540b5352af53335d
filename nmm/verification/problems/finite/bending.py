"""Strips that bend by large angles: under a force, under a couple, and as a column that buckles."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from integration.arrays import Floats
from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase, holds
from nmm.verification.reading import converged, last_way, way

if TYPE_CHECKING:
    from nmm.stepping.run import Run

MODULUS, LENGTH = 1e6, 10.0


def strip(depth: float, tables: Sequence[str], increment: float) -> str:
    """Scene in plane stress without lateral contraction, of finite strain, held at x = 0."""
    return text.scene(
        'title = "Strip"\nplane = "stress"\n[loading]\nuntil = 1.0\n',
        [
            text.material("strip", MODULUS, 0.0, None),
            text.fixed_edge("root", [[0, 0], [0, depth]]),
            *tables,
            f"[formulation.loading]\nincrement = {increment!r}\n"
            '[formulation.rotation]\nupdate = "finite"\n',
        ],
    )


@dataclass(frozen=True)
class Elastica(SceneCase):
    """A strip under a force across its end, which keeps its direction."""

    name = "FK1"
    title = "Elastica under a dead force"
    source = "Elliptic integrals; Mattiasson 1981"
    formulations = ("manifold", "quads degree 2", "splines")
    load: int = 1
    depth = 0.2
    # P L^2 / (E I): deflection and shortening over the length.
    exact: ClassVar[dict[int, tuple[float, float]]] = {
        1: (0.3017207738, 0.0564332363),
        5: (0.7137915236, 0.3876283607),
        10: (0.8106090249, 0.5549955978),
    }
    parameters: ClassVar = {"load": exact}
    label = "P L^2 = {0.load} E I"

    def scene(self) -> str:
        """Return a strip of a fiftieth of its length, loaded in one increment."""
        h = self.depth
        traction = self.load * MODULUS * h**2 / 12 / LENGTH**2
        tables = [
            text.box("strip", (0, 0), (LENGTH, h), "strip"),
            text.pulled_edge("end", [(LENGTH, 0), (LENGTH, h)], [0, traction]),
            text.monitor("tip", (LENGTH, h / 2), "strip"),
        ]
        return strip(h, tables, 1.0)

    def measure(self, run: "Run") -> Checks:
        x, y = last_way(run, "tip") / LENGTH
        rise, short = self.exact[self.load]
        reason = "shear and stretch of a strip of a fiftieth of its length"
        return {
            "deflection / L": Check(float(y), rise, 5e-3, reason),
            "shortening / L": Check(-float(x), short, 5e-3, reason),
            "at rest": holds(converged(run), "one increment from rest is in equilibrium"),
        }


def moment_of_bending(bend: float) -> float:
    """Moment over that of a beam, ``M / (E I k)``, of a strip without lateral contraction.

    Fibres along and across follow St Venant and Kirchhoff's law: radii ``r`` of the bent strip
    obey ``d/dz (r' (r'^2 - 1)) = k^2 r (k^2 r^2 - 1)`` with ``r' = 1`` on both faces, solved by
    collocation. ``bend`` is ``k h``.
    """
    from scipy.integrate import simpson, solve_bvp

    def slopes(_: Floats, y: Floats) -> Floats:
        r, g = y
        return np.vstack([g, bend**2 * r * (bend**2 * r**2 - 1) / (3 * g**2 - 1)])

    def faces(low: Floats, high: Floats) -> Floats:
        return np.array([low[1] - 1, high[1] - 1])

    z = np.linspace(-0.5, 0.5, 101)
    guess = np.vstack([1 / bend + z, np.ones_like(z)])
    r = solve_bvp(slopes, faces, z, guess, tol=1e-10).sol(z)[0]
    return float(6 / bend * simpson(bend * r**2 * (bend**2 * r**2 - 1), x=z))


class RollUp(SceneCase):
    """A couple of two pressures on a head at its end, which turns with it, rolls a strip up.

    A strip of finite thickness is softer than a beam: fibres that bend press on each other.
    """

    name = "FK2"
    title = "Strip rolled up by a couple"
    source = "Collocation of uniform bending with finite strain along and across"
    formulations = ("quads degree 2",)
    depth = 0.2
    sections = (3.0, 6.0)
    wide = 1.5

    def scene(self) -> str:
        """Return a strip with a head of one on both sides; the couple of a beam's full turn."""
        h, end = self.depth, LENGTH + self.wide
        corners = [(0, 0), (LENGTH, 0), (LENGTH, -1), (end, -1), (end, h)]
        corners += [(end, 1 + h), (LENGTH, 1 + h), (LENGTH, h), (0, h)]
        tables = [text.block("strip", "strip", corners)]
        for name, ends in self._faces().items():
            tables.append(
                f'[[loads]]\nname = "{name}"\nkind = "pressure"\n'
                f"segment = {[list(map(float, end)) for end in ends]}\n"
                f"pressure = {self._pressure!r}\n"
            )
            tables += [text.monitor(f"{name} {n}", end, "strip") for n, end in enumerate(ends)]
        for x in self.sections:
            tables += [text.monitor(f"{x:g} {n}", (x, n * h), "strip") for n in (0, 1)]
        return strip(h, tables, 0.25)

    def _faces(self) -> dict[str, tuple[text.Corner, text.Corner]]:
        """Ends of the pressed faces, matter to their left."""
        h, end = self.depth, LENGTH + self.wide
        return {"above": ((end, h), (end, 1 + h)), "below": ((LENGTH, 0), (LENGTH, -1))}

    @property
    def _pressure(self) -> float:
        """Of both faces of one, 1 + h apart, for a beam's full turn (Pa)."""
        return float(2 * np.pi * self._stiffness / LENGTH / (1 + self.depth))

    @property
    def _stiffness(self) -> float:
        """E I of a beam (N m2)."""
        return MODULUS * self.depth**3 / 12

    def measure(self, run: "Run") -> Checks:
        h, low, high = self.depth, *self.sections
        ends = [self._section(run, x) for x in self.sections]
        turns = [float(np.unwrap(np.arctan2(-one[1][:, 0], one[1][:, 1]))[-1]) for one in ends]
        curvature = (turns[1] - turns[0]) / (high - low)
        middle = (ends[0][0][-1] + ends[1][0][-1]) / 2
        moment = 0.0
        for name, places in self._faces().items():
            start, end = (
                np.array(place) + last_way(run, f"{name} {n}") - middle
                for n, place in enumerate(places)
            )
            # An even pressure on any line makes the moment of the squares of its ends' distances.
            moment += self._pressure * float(end @ end - start @ start) / 2
        found = moment / (self._stiffness * curvature)
        return {
            "turn over 2 pi": Check(
                curvature * LENGTH / (2 * np.pi), 1.0, 0.02, "a beam's, to the softening"
            ),
            "M / (E I k)": Check(
                found, moment_of_bending(curvature * h), 2e-3, "the moment varies along the strip"
            ),
            "at rest": holds(converged(run), "every increment is in equilibrium"),
        }

    def _section(self, run: "Run", x: float) -> tuple[Floats, Floats]:
        """Middle (steps, 2) of a section, and the way from its lower to its upper face."""
        low, high = (np.array([x, n * self.depth]) + way(run, f"{x:g} {n}") for n in (0, 1))
        return (low + high) / 2, high - low


@dataclass(frozen=True)
class BuckledColumn(SceneCase):
    """A column is pressed beyond its critical load and bends over, led by a small force across."""

    name = "FK4"
    title = "Column beyond its critical load"
    source = "Elliptic integrals of the perfect column"
    formulations = ("manifold degree 2", "quads degree 2")
    tip: int = 60
    depth = 0.1
    # Angle of the tip in degrees: load over the critical one, place of the tip over the length.
    exact: ClassVar[dict[int, tuple[float, float, float]]] = {
        60: (1.1517196205, 0.7410196061, 0.5932076462),
        120: (1.8848008690, 0.1231599724, 0.8031709900),
    }
    parameters: ClassVar = {"tip": exact}
    label = "{0.tip} deg"

    def scene(self) -> str:
        """Return a column that lies along x."""
        h, load = self.depth, self.exact[self.tip][0]
        pressure = load * np.pi**2 / 4 * MODULUS * h**2 / 12 / LENGTH**2
        tables = [
            text.box("strip", (0, 0), (LENGTH, h), "strip"),
            text.pulled_edge("end", [(LENGTH, 0), (LENGTH, h)], [-pressure, 1e-3 * pressure]),
            text.monitor("tip", (LENGTH, h / 2), "strip"),
        ]
        return strip(h, tables, 0.1)

    def measure(self, run: "Run") -> Checks:
        x, y = last_way(run, "tip") / LENGTH + np.array([1.0, 0.0])
        _, along, across = self.exact[self.tip]
        reason = "a force across of a thousandth; cells of five times the thickness"
        return {
            "x / L": Check(float(x), along, 1e-2, reason, scale=1.0),
            "y / L": Check(float(y), across, 1e-2, reason, scale=1.0),
            "at rest": holds(converged(run), "every increment is in equilibrium"),
        }
