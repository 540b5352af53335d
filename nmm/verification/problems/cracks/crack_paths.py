"""Paths of growing cracks: beams, a panel, and cracks that are stable or not under their stress."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from integration.arrays import Floats
from nmm.verification import text
from nmm.verification.base import Check, Checks, holds, limit
from nmm.verification.problems.cracks.crack_scenes import (
    GrowingCrack,
    crack,
    energy_kept,
    grown,
    net,
    path,
)

if TYPE_CHECKING:
    from nmm.stepping.run import Run

Points = tuple[tuple[float, float], ...]


def force(name: str, point: list[float], down: float) -> str:
    """Table of a force at a point, positive upwards."""
    return f'[[loads]]\nname = "{name}"\nkind = "point"\npoint = {point}\nforce = [0.0, {down}]\n'


def away(places: Floats, line: Points) -> Floats:
    """Distances (n,) of places from a polyline."""
    import shapely

    return np.asarray(shapely.distance(shapely.points(places), shapely.LineString(line)))


class BeamWithHoles(GrowingCrack):
    """A crack beside three holes in a bent beam: it passes the lowest and meets the middle one."""

    name = "GR6"
    title = "Beam with three holes, the crack finds the middle one"
    source = (
        "Geometry of Bittencourt, Wawrzynek, Ingraffea and Sousa (1996); the path by finite "
        "elements of degree 3, pieces of 0.1; lengths in inches there, here in units of one"
    )
    path = (
        *((4.0, 1.0), (4.0684, 1.2921), (4.1524, 1.58), (4.2518, 1.8631), (4.3646, 2.141)),
        *((4.4893, 2.4139), (4.625, 2.6814), (4.771, 2.9434), (4.9249, 3.201), (5.081, 3.4572)),
        *((5.2331, 3.7158), (5.3797, 3.9775), (5.523, 4.241), (5.6673, 4.504), (5.7201, 4.589)),
        (5.75, 4.63),
    )

    @property
    def tables(self) -> Sequence[str]:
        """Return the beam on two supports."""
        turn = 2 * np.pi * np.arange(48) / 48
        ring = 0.25 * np.stack([np.cos(turn), np.sin(turn)], axis=1)
        holes = [(ring + np.array([6.0, y])).tolist() for y in (2.75, 4.75, 6.75)]
        block = text.block("beam", "m", text.rectangle((0.0, 0.0), (20.0, 8.0)))
        foci = [[4.0, 1.0], [4.6, 2.6], [5.2, 3.7], [5.7, 4.6]]
        options = f"[formulation.cover.options]\nfocus = {foci}\nradius = 0.7\ngrowth = 0.2\n"
        return [
            f"{block}holes = {holes}\n",
            crack("c", [[4.0, 0.0], [4.0, 1.0]]),
            force("load", [10.0, 8.0], -1.0),
            text.fixed_point("left", [1.0, 0.0]),
            text.fixed_point("right", [19.0, 0.0], "y"),
            grown(0.2, 10.0),
            net(0.2, 11.0, "graded", options),
        ]

    def measure(self, run: "Run") -> Checks:
        place, _ = path(run, "c:end")
        off = away(place, self.path)
        last = run.stepper.discretisation.setup.geometry.cracks[0][-1] + run.origin
        end = float(np.hypot(*(last - np.array([6.0, 4.75]))))
        return {
            "distance from the path": limit(float(off.max()), 0.08, "the benchmark's, of 8"),
            "it ends on the middle hole": Check(end, 0.25, 0.01, "a circle of 48 corners"),
        }


class ShearedBeam(GrowingCrack):
    """A notched beam whose notched section carries shear alone: the crack starts in mode II."""

    name = "GR7"
    title = "Single edge notched beam in four point shear"
    source = (
        "Beam of Arrea and Ingraffea (1982) with self-equilibrated loads; the path by finite "
        "elements of degree 3, pieces of 6 mm"
    )
    path = (
        *((0.0, 82.0), (16.7, 88.6), (31.3, 99.0), (44.3, 111.5), (55.7, 125.4), (65.6, 140.4)),
        *((73.9, 156.4), (80.5, 173.1), (85.6, 190.4), (89.3, 208.0), (91.5, 225.8)),
        *((92.4, 243.8), (92.2, 261.8), (91.2, 279.8), (90.3, 297.8), (90.0, 306.0)),
    )

    @property
    def tables(self) -> Sequence[str]:
        """Return the beam, lengths in metres; three points hold it and carry nothing."""
        less = 61 / 458
        foci = [[0.02, 0.09], [0.06, 0.13], [0.085, 0.19], [0.092, 0.25], [0.09, 0.29]]
        options = f"[formulation.cover.options]\nfocus = {foci}\nradius = 0.04\ngrowth = 0.2\n"
        return [
            text.block("beam", "m", text.rectangle((-0.661, 0.0), (0.661, 0.306))),
            crack("c", [[0.0, 0.0], [0.0, 0.082]]),
            force("a", [0.061, 0.306], -1.0),
            force("b", [-0.458, 0.306], -less),
            force("d", [-0.061, 0.0], 1.0),
            force("e", [0.458, 0.0], less),
            text.fixed_point("left", [-0.661, 0.0]),
            text.fixed_point("right", [0.661, 0.0], "y"),
            grown(0.012, 10.0),
            net(0.012, 11.0, "graded", options),
        ]

    def measure(self, run: "Run") -> Checks:
        place = 1e3 * path(run, "c:end")[0]
        first = place[1] - place[0]
        kink = float(np.degrees(np.arctan2(first[0], first[1])))
        return {
            "distance from the path (mm)": limit(
                float(away(place, self.path).max()), 4.0, "the benchmark's"
            ),
            "first kink (degrees)": Check(kink, 73.4, 2.0, "the benchmark's", 1.0),
            "where it meets the top (mm)": Check(
                float(place[-1, 0]), 90.0, 4.0, "the benchmark's", 1.0
            ),
            **energy_kept(run),
        }


class LPanel(GrowingCrack):
    """An L-shaped panel that is lifted at its arm: the crack runs from the corner across."""

    name = "GR9"
    title = "L-shaped panel, path from a starter at the corner"
    source = "Panel of Winkler (2001); the path by finite elements of degree 3"
    path = (
        *((242.93, 257.07), (225.7, 267.2), (207.6, 275.6), (188.9, 282.7), (169.7, 288.4)),
        *((150.2, 292.9), (130.5, 296.1), (110.6, 298.1), (90.6, 299.3), (70.6, 299.8)),
        *((50.6, 300.0), (30.6, 300.0)),
    )
    poisson = 0.18

    def scene(self) -> str:
        """Return the panel in plane stress."""
        return super().scene().replace('plane = "strain"', 'plane = "stress"')

    @property
    def tables(self) -> Sequence[str]:
        """Return the panel, lengths in metres."""
        ring = [[0, 0], [0.25, 0], [0.25, 0.25], [0.5, 0.25], [0.5, 0.5], [0, 0.5]]
        foci = [[0.24, 0.26], [0.18, 0.285], [0.12, 0.297], [0.06, 0.3]]
        options = f"[formulation.cover.options]\nfocus = {foci}\nradius = 0.03\ngrowth = 0.2\n"
        return [
            text.block("panel", "m", np.array(ring, dtype=float).tolist()),
            crack("c", [[0.25, 0.25], [0.24293, 0.25707]]),
            force("lift", [0.47, 0.25], 1.0),
            text.fixed_edge("floor", [[0.0, 0.0], [0.25, 0.0]]),
            grown(0.01, 0.215),
            net(0.008, 11.0, "graded", options),
        ]

    def measure(self, run: "Run") -> Checks:
        place = 1e3 * path(run, "c:end")[0]
        return {
            "distance from the path (mm)": limit(
                float(away(place, self.path).max()), 4.0, "the benchmark's"
            ),
            **energy_kept(run),
        }


@dataclass(frozen=True)
class StressAlongCrack(GrowingCrack):
    """Ends of a crack that are kinked by 5 degrees: tension along it decides whether they leave."""

    name = "GR10"
    title = "Directional stability of a crack under tension along it"
    source = "Finite elements of degree 3 graded to the tips; pieces of 0.0125 to 0.05"
    along: float = 1.5
    # Crack that straightens, the one that runs on, and the one that leaves.
    parameters: ClassVar = {"along": (0.0, 1.0, 1.5)}
    label = "tension along it {0.along:g}"

    @property
    def tables(self) -> Sequence[str]:
        """Return a plate of ten by ten with the crack in its middle."""
        half, x, y = 5.0, 0.5498, 0.00436
        foci = [[sign * place, 0.0] for place in (0.4, 0.9, 1.3) for sign in (1, -1)]
        options = f"[formulation.cover.options]\nfocus = {foci}\nradius = 0.3\ngrowth = 0.2\n"
        sides = [
            text.pulled_edge("east", [[half, -half], [half, half]], [self.along, 0.0]),
            text.pulled_edge("west", [[-half, -half], [-half, half]], [-self.along, 0.0]),
        ]
        return [
            text.block("plate", "m", text.rectangle((-half, -half), (half, half))),
            crack("c", [[-x, -y], [-0.5, 0.0], [0.5, 0.0], [x, y]]),
            text.pulled_edge("up", [[-half, half], [half, half]], [0.0, 1.0]),
            text.pulled_edge("down", [[-half, -half], [half, -half]], [0.0, -1.0]),
            *(sides if self.along else []),
            text.fixed_point("left", [-half, -half]),
            text.fixed_point("right", [half, -half], "y"),
            grown(0.05, 0.8),
            net(0.1, 10.0, "graded", options),
        ]

    def measure(self, run: "Run") -> Checks:
        place, _ = path(run, "c:end")
        other, _ = path(run, "c:start")
        at = {x: float(np.interp(x, *place.T)) for x in (0.6, 1.0, 1.3)}
        symmetry = limit(float(np.abs(place + other).max()), 1e-3, "of the scene")
        if self.along == 1.5:
            found = {
                f"height at x = {x:g}": Check(at[x], expected, 0.05, "the benchmark's")
                for x, expected in ((1.0, 0.0188), (1.3, 0.0330))
            }
        elif self.along:
            found = {
                f"height at x = {x:g}": Check(at[x], expected, 0.003, "the benchmark's", 1.0)
                for x, expected in ((0.6, 0.0047), (1.0, 0.0078), (1.3, 0.0101))
            }
        else:
            found = {
                "largest height": limit(float(place[:, 1].max()), 0.005, "the benchmark's"),
                "it turns back": holds(at[1.3] < at[0.6], "tension across alone"),
            }
        return {**found, "point symmetry": symmetry, **energy_kept(run)}
