"""Cracks that begin in bodies without any, by the mean stress along a line."""

from abc import abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar, Self

import numpy as np

from integration.arrays import Floats
from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase
from nmm.verification.problems.cracks.crack_scenes import net

if TYPE_CHECKING:
    from nmm.stepping.run import Run

Box = tuple[text.Corner, text.Corner]
_R, _T = "(x*x+y*y)", "atan2(y,x)"
KIRSCH = (
    f"1-(1.5*cos(2*{_T})+cos(4*{_T}))/{_R}+1.5*cos(4*{_T})/{_R}**2",
    f"-(0.5*cos(2*{_T})-cos(4*{_T}))/{_R}-1.5*cos(4*{_T})/{_R}**2",
    f"-(0.5*sin(2*{_T})+sin(4*{_T}))/{_R}+1.5*sin(4*{_T})/{_R}**2",
)
"""Stress [xx, yy, xy] about a hole of radius 1 under a unit tension along x (Kirsch 1898)."""


def led(box: Box, stress: Sequence[str]) -> list[str]:
    """Tables of the tractions of a stress [xx, yy, xy] of x and y around a box, and its pins."""
    (x0, y0), (x1, y1) = box
    xx, yy, xy = stress
    sides = [
        ("right", [[x1, y0], [x1, y1]], (xx, xy)),
        ("left", [[x0, y1], [x0, y0]], (f"-({xx})", f"-({xy})")),
        ("up", [[x1, y1], [x0, y1]], (xy, yy)),
        ("down", [[x0, y0], [x1, y0]], (f"-({xy})", f"-({yy})")),
    ]
    loads = [
        f'[[loads]]\nname = "{name}"\nkind = "edge"\nsegment = {at}\nfield = ["{x}", "{y}"]\n'
        for name, at, (x, y) in sides
    ]
    return [*loads, text.fixed_point("one", [x0, y0]), text.fixed_point("other", [x1, y0], "y")]


def ring(corners: int) -> Floats:
    """Corners (n, 2) of a circle of radius 1."""
    turn = np.arange(corners) * 2 * np.pi / corners
    return np.stack([np.cos(turn), np.sin(turn)], axis=1)


class BegunCrack(SceneCase):
    """A plate of strength 1 in which one crack begins, and grows no further."""

    length: float
    size: ClassVar[float]
    angle: float

    @property
    @abstractmethod
    def tables(self) -> Sequence[str]:
        """The plate and what acts on it."""

    def scene(self) -> str:
        """Return the plate in plane strain."""
        rule = 'toughness = 1.0\nincrement = 0.1\nmax_growth = 1e-3\ncontrol = "toughness"\n'
        begins = f"tensile_strength = 1.0\nlength = {self.length}\nnumber = 1\n"
        tables = [
            text.material("m", 1.0, 0.3, None),
            *self.tables,
            f"[fracture]\n{rule}[fracture.nucleation]\n{begins}",
            net(self.size, self.angle),
        ]
        return text.scene('plane = "strain"', tables)


def laid(run: "Run") -> Floats:
    """Return the way (2,) from the start of the crack to its end (m)."""
    start, end = (
        [run.history[f"fracture:nucleus 1:{end}:{axis}"][1] for axis in "xy"]
        for end in ("start", "end")
    )
    return np.subtract(end, start)


@dataclass(frozen=True)
class CrackAtHole(BegunCrack):
    """A plate with a hole of radius 1 under tension: a crack begins at its flank."""

    name = "GR13"
    title = "Crack that begins at a hole"
    source = (
        "2 (1 - x) / (2 - x^2 - x^4), x = R / (R + d): mean of Kirsch's stress over d at the "
        "strength (Whitney and Nuismer 1974); tractions of the infinite plate at three radii"
    )
    size = 0.15
    length: float = 0.5
    angle: float = 0.0
    label = "d = {0.length:g} R, net at {0.angle:g} degrees"

    @classmethod
    def variants(cls) -> Sequence[Self]:
        """Return three lengths, one of them on three nets."""
        return [*(cls(length) for length in (0.25, 0.5, 1.0)), cls(0.5, 17.0), cls(0.5, 41.0)]

    @property
    def tables(self) -> Sequence[str]:
        """Return the plate with the tractions of the infinite one."""
        box = ((-3.0, -3.0), (3.0, 3.0))
        plate = text.block("plate", "m", text.rectangle(*box))
        return [f"{plate}holes = [{ring(128).tolist()}]\n", *led(box, KIRSCH)]

    def measure(self, run: "Run") -> Checks:
        x = 1 / (1 + self.length)
        history, way = run.history, laid(run)
        along = abs(float(history["fracture:nucleation:x"][0]))
        return {
            "stress over strength": Check(
                float(history["load_factor"][0]),
                2 * (1 - x) / (2 - x**2 - x**4),
                0.01,
                "cells of 0.15 R; measured up to 4e-3",
            ),
            "distance from the flank (R)": Check(
                along, 0.0, 0.1, "the mean of d = R / 2 is 1 % lower there", 1.0
            ),
            "turn from across the tension (rad)": Check(
                float(np.arctan2(abs(way[0]), abs(way[1]))), 0.0, 0.1, "as its place", 1.0
            ),
        }


@dataclass(frozen=True)
class CrackInPlate(BegunCrack):
    """A plate without a hole under even stress, or in bending."""

    name = "GR14"
    title = "Crack that begins at an even edge"
    source = (
        "Stress that is linear along the line: at the strength where it is even, at "
        "1 / (1 - d / h) of it in bending of a depth h"
    )
    size = 0.11
    length: float = 0.2
    angle: float = 17.0
    pulled: float = 0.0
    bends: bool = False

    @classmethod
    def variants(cls) -> Sequence[Self]:
        """Return tension at four angles with half as much pressure across it, and bending."""
        even = [cls(pulled=degrees) for degrees in (0.0, 25.0, 60.0, 110.0)]
        return [*even, cls(bends=True), cls(0.1, 41.0, bends=True)]

    @property
    def variant(self) -> str:
        if self.bends:
            return f"bending, d = {self.length:g} h, net at {self.angle:g} degrees"
        return f"tension at {self.pulled:g} degrees"

    @property
    def tables(self) -> Sequence[str]:
        """Return a plate of depth 1 under its stress."""
        turn = 2 * np.radians(self.pulled)
        along, across, shear = 0.75 * np.cos(turn), -0.75 * np.cos(turn), 0.75 * np.sin(turn)
        even = [repr(float(part)) for part in (0.25 + along, 0.25 + across, shear)]
        box = ((0.0, 0.0), (1.5, 1.0))
        plate = text.block("plate", "m", text.rectangle(*box))
        return [plate, *led(box, ["1-2*y", "0", "0"] if self.bends else even)]

    def measure(self, run: "Run") -> Checks:
        expected = 1 / (1 - self.length) if self.bends else 1.0
        turn, way = np.radians(self.pulled), laid(run)
        off = way @ np.array([np.cos(turn), np.sin(turn)]) / np.hypot(*way)
        return {
            "stress over strength": Check(
                float(run.history["load_factor"][0]), expected, 1e-8, "covers hold both exactly"
            ),
            "turn from across the tension (rad)": Check(
                abs(float(off)), 0.0, 5e-3, "a cut moves what it lays by 1e-3 of a cell", 1.0
            ),
        }
