"""Blocks on blocks: the weight between them, a column's own weight, and how far a pile reaches."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar, Self

import numpy as np

from nmm.verification import text
from nmm.verification.base import EXACT, MESHES, Check, Checks, SceneCase, holds
from nmm.verification.reading import converged, joint_force, last_way
from nmm.verification.text import G

if TYPE_CHECKING:
    from nmm.stepping.run import Run

UP = np.array([0.0, 1.0])
DENSITY = 2600.0


def _head(title: str, more: str = "") -> str:
    return f'title = "{title}"\nplane = "stress"\n[gravity]\n[contact]\n{more}'


@dataclass(frozen=True)
class Stack(SceneCase):
    """Every interface of a stack carries the weight above it."""

    name = "B12 stack"
    title = "Stack of five blocks"
    source = "Balance of weights"
    formulations = ("dda", "rigid", "degree 2", *EXACT, *MESHES)
    shape: str = "tapered"
    heights: tuple[float, ...] = (1.0, 0.5, 2.0, 0.25, 1.0)
    widths: tuple[float, ...] = (2.0, 1.5, 1.0, 0.75, 0.5)
    label = "{0.shape}"

    @classmethod
    def variants(cls) -> Sequence[Self]:
        """Return blocks that grow narrower upwards, and equal ones, corner on corner."""
        return [cls(), cls("equal", (1.0,) * 5, (1.0,) * 5)]

    def scene(self) -> str:
        """Return a floor with the blocks on it, all on one axis."""
        low = 0.0
        tables = [
            text.material("rock", density=DENSITY),
            text.interface("contact", 30.0),
            text.block("floor", "rock", text.rectangle((-2, -1), (2, 0))),
            text.fixed_block("floor"),
        ]
        for number, (height, width) in enumerate(zip(self.heights, self.widths, strict=True)):
            corners = text.rectangle((-width / 2, low), (width / 2, low + height))
            tables.append(text.block(f"block {number}", "rock", corners))
            low += height
        return text.scene(_head("Stack"), tables)

    def measure(self, run: "Run") -> Checks:
        weight = DENSITY * G * np.array(self.heights) * np.array(self.widths)
        level = np.concatenate([[0.0], np.cumsum(self.heights)])
        checks = {"all in equilibrium": holds(converged(run), "statics ends at load factor 1")}
        for number in range(len(weight)):
            carried = float(weight[number:].sum())
            normal, shear = joint_force(run, UP * level[number], UP)
            reason = "residual 1e-8 of the solution, relative to the forces of all unknowns"
            checks[f"normal force {number} (N)"] = Check(-normal, carried, 1e-5, reason)
            checks[f"shear force {number} (N)"] = Check(shear, 0.0, 1e-5, reason, scale=carried)
        return checks


class Column(SceneCase):
    """A column under its own weight: exact where the approximation is quadratic."""

    name = "B12 column"
    title = "Column of one block under its own weight"
    source = "u(y) = -rho g (H y - y^2 / 2) / E for nu = 0"
    formulations = ("dda", "degree 2", "degree 3", "manifold")
    height = 10.0
    modulus = 1e8

    def checks(self, formulation: str) -> Checks:
        """Run and measure; a linear approximation has the top alone exact."""
        found = self.measure(self.run(formulation))
        if formulation == "dda":
            del found["settlement of the middle (m)"]
        return found

    def scene(self) -> str:
        """Return a column of 1 m x 10 m held at its foot."""
        return text.scene(
            'title = "Column"\nplane = "stress"\n[gravity]\n',
            [
                text.material("rock", modulus=self.modulus, poisson=0.0, density=DENSITY),
                text.block("column", "rock", text.rectangle((0, 0), (1, self.height))),
                text.fixed_edge("foot", [[0, 0], [1, 0]]),
                *(text.monitor(f"y{y}", (0.5, y), "column") for y in (0, 5, 10)),
            ],
        )

    def measure(self, run: "Run") -> Checks:
        base, middle, top = (last_way(run, f"y{y}")[1] for y in (0, 5, 10))
        unit = DENSITY * G * self.height**2 / self.modulus
        weight = DENSITY * G * self.height
        reason = "rounding: the solution is in the space of the functions"
        return {
            "settlement of the top (m)": Check(top - base, -unit / 2, 1e-9, reason),
            "settlement of the middle (m)": Check(middle - base, -unit * 3 / 8, 1e-9, reason),
            "reaction (N)": Check(run.history["reaction:foot:y"][-1], weight, 1e-9, reason),
        }


@dataclass(frozen=True)
class Overhang(SceneCase):
    """A pile of ``n`` blocks reaches over a table by half the harmonic sum, and no further."""

    name = "B12 overhang"
    title = "Harmonic overhang of piled blocks"
    source = "Centre of gravity over the edge below: 1/2 (1 + 1/2 + ... + 1/n)"
    number: int = 1
    share: float = 0.99
    height = 0.25
    # One to four blocks, 1 % below and above the limit.
    parameters: ClassVar = {"number": (1, 2, 3, 4), "share": (0.99, 1.01)}
    label = "{0.number} blocks, {0.share}"

    def scene(self) -> str:
        """Return a table that ends at x = 0 and the pile on it."""
        tables = [
            text.material("rock", density=DENSITY),
            text.interface("contact", 35.0),
            text.block("table", "rock", text.rectangle((-3, -1), (0, 0))),
            text.fixed_block("table"),
        ]
        # From the table up the overhangs are 1/(2n), ..., 1/4, 1/2.
        steps = self.share / (2 * np.arange(self.number, 0, -1))
        for level, right in enumerate(np.cumsum(steps)):
            low, high = level * self.height, (level + 1) * self.height
            corners = text.rectangle((right - 1, low), (right, high))
            tables.append(text.block(f"block {level}", "rock", corners))
        return text.scene(_head("Overhang"), tables)

    def measure(self, run: "Run") -> Checks:
        """Say whether the pile stands, by statics."""
        stands = self.share < 1
        reason = "1 % of the length is 1e5 times what contacts give way"
        return {"stands" if stands else "topples": holds(converged(run) == stands, reason)}
