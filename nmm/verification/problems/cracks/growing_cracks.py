"""Cracks that grow at their toughness through nets that know nothing of them."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from nmm.verification import text
from nmm.verification.base import Check, Checks, limit
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


class CompactTension(GrowingCrack):
    """The standard specimen, pulled at two holes: intensities as its crack grows straight on."""

    name = "GR3"
    title = "Compact tension specimen, intensities of four lengths"
    source = (
        "K sqrt(W) / P from finite elements of degree 3; the polynomial of ASTM E399 is 1 % lower "
        "at the shortest, for it knows another load"
    )
    known = (5.675, 7.280, 9.621, 13.624)
    corners = 48

    @property
    def tables(self) -> Sequence[str]:
        """Return the specimen with the load even over the outer half of each hole."""
        turn = 2 * np.pi * np.arange(self.corners) / self.corners
        circle = 0.125 * np.stack([np.cos(turn), np.sin(turn)], axis=1)
        rings = [circle + np.array([0.0, 0.275]), circle - np.array([0.0, 0.275])]
        half = self.corners // 2
        side = float(np.hypot(*(circle[1] - circle[0])))
        even = 1 / (half * side)
        ends = [np.stack([ring, np.roll(ring, -1, axis=0)], axis=1).tolist() for ring in rings]
        loads = [text.pulled_edge(f"up{n}", ends[0][n], [0.0, even]) for n in range(half)]
        loads += [
            text.pulled_edge(f"down{n}", ends[1][half + n], [0.0, -even]) for n in range(half)
        ]
        block = text.block("specimen", "m", text.rectangle((-0.25, -0.6), (1.0, 0.6)))
        return [
            f"{block}holes = {[ring.tolist() for ring in rings]}\n",
            crack("c", [[-0.25, 0.0], [0.3, 0.0]]),
            *loads,
            text.fixed_point("lower", [1.0, -0.6]),
            text.fixed_point("upper", [1.0, 0.6], "x"),
            grown(0.1, 0.3, 'toughness = 1.0\ncriterion = "straight_ahead"'),
            net(0.05, 11.0),
        ]

    def measure(self, run: "Run") -> Checks:
        place, opening = path(run, "c:end")
        return {
            f"K sqrt(W) / P at a / W = {x:.1f}": Check(
                float(found), expected, 0.01, "the benchmark's"
            )
            for (x, _), found, expected in zip(place, opening, self.known, strict=True)
        } | energy_kept(run)


@dataclass(frozen=True)
class InclinedCrack(GrowingCrack):
    """A crack under 45 degrees in a wide plate: both ends kink and turn across the tension."""

    name = "GR4"
    title = "Inclined centre crack that grows from both tips"
    source = "Finite elements of degree 3 graded to the tip, pieces of 0.025"
    along = (0.6506, 0.8002, 0.9499, 1.2496, 1.3495)
    across = (0.3129, 0.3008, 0.2915, 0.2781, 0.2746)
    intensity = (1.5198, 1.6911, 1.8585, 2.1925, 2.3054)
    angle: float = 0.0
    parameters: ClassVar = {"angle": (0.0, 17.0, 45.0)}
    label = "net at {0.angle:g} degrees"

    @property
    def tables(self) -> Sequence[str]:
        """Return a plate of ten by ten with a crack of one."""
        half, end = 5.0, float(0.5 / np.sqrt(2.0))
        foci = [[sign * x, sign * 0.3] for x in (0.4, 0.9, 1.4) for sign in (1, -1)]
        options = f"[formulation.cover.options]\nfocus = {foci}\nradius = 0.3\ngrowth = 0.2\n"
        return [
            text.block("plate", "m", text.rectangle((-half, -half), (half, half))),
            crack("c", [[-end, -end], [end, end]]),
            text.pulled_edge("up", [[-half, half], [half, half]], [0.0, 1.0]),
            text.pulled_edge("down", [[-half, -half], [half, -half]], [0.0, -1.0]),
            text.fixed_point("left", [-half, -half]),
            text.fixed_point("right", [half, -half], "y"),
            grown(0.1, 1.0),
            net(0.1, self.angle, "graded", options),
        ]

    def measure(self, run: "Run") -> Checks:
        (place, opening), (other, _) = path(run, "c:end"), path(run, "c:start")
        beyond = place[:, 0] <= self.along[-1]
        off = place[:, 1] - np.interp(place[:, 0], self.along, self.across)
        far = beyond & (place[:, 0] >= self.along[0])
        expected = np.interp(place[:, 0], self.along, self.intensity)
        reason = "2 % of the half length; measured 1e-3"
        return {
            "largest distance from the path (m)": limit(
                float(np.abs(off[far]).max()), 0.01, reason
            ),
            "K_I on it, largest error": limit(
                float(np.abs(opening / expected - 1)[far].max()), 0.02, "measured 3e-3"
            ),
            "point symmetry (m)": limit(float(np.abs(place + other).max()), 1e-3, "of the scene"),
            **energy_kept(run),
        }


class DoubleCantilever(GrowingCrack):
    """Two arms pulled apart: the crack between them grows at the fracture energy.

    It is kept in its plane, as by side grooves: without them it is directionally unstable.
    """

    name = "GR2"
    title = "Double cantilever beam, load and opening of a growing crack"
    source = (
        "K = sqrt(12) P (a + 0.6725 h) / h^1.5 from finite elements of degree 3; P^2 D is constant"
    )
    modulus = 30e9
    poisson = 0.2
    arm = 0.1
    length = 2.4

    @property
    def tables(self) -> Sequence[str]:
        """Return both arms with the crack between them."""
        h, long = self.arm, self.length
        return [
            text.block("beam", "m", text.rectangle((0.0, -h), (long, h))),
            crack("c", [[0.0, 0.0], [0.5, 0.0]]),
            text.pulled_edge("up", [[0.0, 0.0], [0.0, h]], [0.0, 1 / h]),
            text.pulled_edge("down", [[0.0, -h], [0.0, 0.0]], [0.0, -1 / h]),
            text.fixed_point("lower", [long, -h]),
            text.fixed_point("upper", [long, h]),
            text.monitor("above", (0.0, h / 2), "beam"),
            text.monitor("below", (0.0, -h / 2), "beam"),
            grown(0.1, 0.7, 'energy = 100.0\ncriterion = "straight_ahead"'),
            net(0.025, 0.0),
        ]

    def measure(self, run: "Run") -> Checks:
        place, _ = path(run, "c:end")
        history, h = run.history, self.arm
        load = history["load_factor"]
        opening = history["monitor:above:uy"] - history["monitor:below:uy"]
        stiff = self.modulus / (1 - self.poisson**2)
        constant = 8 * (100 * stiff * h**3 / 12) ** 1.5 / (stiff * h**3)
        at_opening = np.sqrt(constant / opening)
        length = np.sqrt(100 * stiff * h**3 / 12) / at_opening - 0.6725 * h
        return {
            "load at the opening, largest error": limit(
                float(np.abs(load / at_opening - 1).max()), 0.015, "the benchmark's"
            ),
            "length at the opening, largest error": limit(
                float(np.abs(place[:, 0] / length - 1).max()), 0.01, "the benchmark's"
            ),
            **energy_kept(run),
        }
