"""Blocks and ground shaken by records: one degree of freedom, and a block that slides."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar, Self

import numpy as np

from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase, limit
from nmm.verification.formulations import with_cover
from nmm.verification.problems.contact.incline import on_slope
from nmm.verification.reading import way

if TYPE_CHECKING:
    from nmm.formulation import Formulation
    from nmm.scene import Scene
    from nmm.stepping.run import Run

R1 = (0, 0.6, 1.8, -1.2, -3.0, 0.9, 3.4, 2.1, -0.8, -3.6, -1.5, 2.4, 1.1, -2.2, 0.4, 1.6, -0.9)
RECORD = (*R1, -0.5, 0.3, -0.1, 0)
"""A record of acceleration (m/s2), every 0.1 s, linear between."""
NEWMARK = '[formulation.integrator]\ntype = "newmark"\nstep = {step!r}\n'
SMALL = '[formulation.rotation]\nupdate = "small"\n'


def record(name: str, values: Sequence[float], step: float, more: str = "") -> str:
    """Table of a record of values at equal steps (s)."""
    return f"[records.{name}]\nvalues = {list(values)}\nstep = {step!r}\n{more}"


def support(name: str, place: str, fix: str, motion: str = "") -> str:
    """Table of a support of a block or a segment that holds "x" or "y", or follows a record."""
    moves = f'motion = {{ x = "{motion}" }}\n' if motion else ""
    return f'[[supports]]\nname = "{name}"\n{place}\nfix = {list(fix)}\n{moves}'


@dataclass(frozen=True)
class Swing(SceneCase):
    """A square of constant strain that can only shear: one mass on a spring, pulled suddenly.

    Its frequency is ``w^2 = 3 G / (rho h^2)``.
    """

    name = "VI4"
    title = "Free vibration under Rayleigh's and local damping"
    source = "logarithmic decrement of 5 %; local damping: sqrt((1 - a) / (1 + a)) a half cycle"
    formulations = ("dda", "bilinear quads")
    damping: str = "rayleigh"
    shear = 3e6
    omega = float(np.sqrt(3 * 3e6 / 1000.0))
    parameters: ClassVar = {"damping": ("rayleigh", "local 0.1", "local 0.7")}
    label = "{0.damping}"

    @property
    def period(self) -> float:
        """Of free vibration (s)."""
        return float(2 * np.pi / self.omega)

    def scene(self) -> str:
        """Return a square on rollers all round, its base held along x."""
        frequencies = [1 / self.period, 5 / self.period]
        damping = (
            f"ratios = [0.05, 0.05]\nfrequencies = {frequencies}\n"
            if self.damping == "rayleigh"
            else f"local = {self.damping.split()[1]}\n"
        )
        return text.scene(
            f'title = "Swing"\nplane = "strain"\nduration = {2.2 * self.period!r}\n[inertia]\n'
            f"[damping]\n{damping}{NEWMARK.format(step=self.period / 200)}{SMALL}",
            [
                text.material("soil", 2.5 * self.shear, 0.25, 1000.0),
                text.block("square", "soil", text.rectangle((0, 0), (1, 1))),
                support("base", "segment = [[0, 0], [1, 0]]", "x"),
                support("level", 'block = "square"', "y"),
                text.pulled_edge("pull", [[0, 1], [1, 1]], [1e3, 0]),
                text.monitor("top", (0.5, 1.0), "square"),
            ],
        )

    def formulation(self, scene: "Scene", name: str) -> "Formulation":
        """Return one cell where there are cells, and edges held exactly."""
        return _one_cell(super().formulation(scene, name))

    def measure(self, run: "Run") -> Checks:
        swing = way(run, "top")[:, 0] * self.shear / 1e3 - 1
        turning = (swing[1:-1] - swing[:-2]) * (swing[2:] - swing[1:-1]) < 0
        peaks = np.abs(swing[1:-1][turning])
        share = 0.0 if self.damping == "rayleigh" else float(self.damping.split()[1])
        expected = float(np.sqrt((1 - share) / (1 + share)))
        if not share:
            expected = float(np.exp(-np.pi * 0.05 / np.sqrt(1 - 0.05**2)))
        reason = "extremes between steps; signs of local damping are those of the start of a step"
        return {
            "ratio of amplitudes a half cycle": Check(peaks[1] / peaks[0], expected, 1e-2, reason),
            "energy that is missing": limit(
                abs(run.summary.energy_balance or 0.0), 1e-3, "its books"
            ),
        }


@dataclass(frozen=True)
class ShakenMass(SceneCase):
    """The same square on a base that follows a record: its top is 1.5 times the oscillator."""

    name = "BM1"
    title = "One mass on a spring under a record"
    source = "exact for piecewise linear records (Nigam and Jennings 1969)"
    formulations = ("dda", "bilinear quads")
    period: float = 0.5
    ratio: float = 0.05
    exact: ClassVar[dict[float, tuple[float, float, float]]] = {
        0.5: (0.08199225, 0.0756450992, 0.0482207489),
        0.3: (0.02778873, 0.0113379287, 0.0186646556),
    }
    label = "T {0.period}, {0.ratio}"

    @classmethod
    def variants(cls) -> Sequence[Self]:
        """Return a damped and an undamped oscillator."""
        return [cls(0.5, 0.05), cls(0.3, 0.0)]

    def scene(self) -> str:
        """Return the square with its base shaken."""
        omega = 2 * np.pi / self.period
        return text.scene(
            f'title = "Shaken mass"\nplane = "strain"\nduration = 2.0\n[inertia]\n[damping]\n'
            f"stiffness = {2 * self.ratio / omega!r}\n"
            f"{NEWMARK.format(step=self.period / 100)}{SMALL}",
            [
                text.material("soil", 2.5 * 1000 * omega**2 / 3, 0.25, 1000.0),
                text.block("square", "soil", text.rectangle((0, 0), (1, 1))),
                record("R1", RECORD, 0.1),
                support("base", "segment = [[0, 0], [1, 0]]", "x", "R1"),
                support("level", 'block = "square"', "y"),
                text.monitor("top", (0.5, 1.0), "square"),
                text.monitor("base", (0.5, 0.0), "square"),
            ],
        )

    def formulation(self, scene: "Scene", name: str) -> "Formulation":
        """Return one cell where there are cells, and edges held exactly."""
        return _one_cell(super().formulation(scene, name))

    def measure(self, run: "Run") -> Checks:
        moved = (way(run, "top") - way(run, "base"))[:, 0] / 1.5
        time, (largest, first, last) = run.history["time"], self.exact[self.period]
        # The trapezoidal rule makes the period longer by (w dt)^2 / 12, springs hold the base.
        late = (2 * np.pi / 100) ** 2 / 12 * 2 * np.pi / self.period
        reason = "second order at a hundred steps a period; swings are late by its period error"
        ends = {"u(1.0)": (1.0, first), "u(2.0)": (2.0, last)}
        return {
            "largest displacement (m)": Check(np.abs(moved).max(), largest, 4e-3, reason),
            **{
                f"{name} (m)": Check(
                    float(np.interp(at, time, moved)), value, 3e-3 + at * late, reason, largest
                )
                for name, (at, value) in ends.items()
            },
        }


@dataclass(frozen=True)
class ShakenSlope(SceneCase):
    """A block that a record makes slide down a slope, one way."""

    name = "BM5"
    title = "Block on a slope under a record"
    source = "equation of motion, events and steps of 2e-6 s (Newmark 1965)"
    formulations = ("dda",)
    slope: float = 20.0
    friction: float = 30.0
    scale: float = 2.0
    slides: float = 0.2291134009
    label = "{0.slope:g}, {0.friction:g}, {0.scale:g}"

    @classmethod
    def variants(cls) -> Sequence[Self]:
        """Return a strong shaking on a rough slope, and a weaker one on a smoother."""
        return [cls(), cls(15.0, 18.0, 1.0, 0.1633430180)]

    @property
    def slow(self) -> bool:
        """Whether it is the second one: 1100 steps with contact."""
        return self.scale == 1.0

    def scene(self) -> str:
        """Return a slope that follows the record, and a flat block on it."""
        return text.scene(
            'title = "Shaken slope"\nplane = "strain"\nduration = 2.2\n[inertia]\n[gravity]\n'
            "[contact]\n[formulation.integrator]\nstep = 0.002\n",
            [
                text.material("rock", 1e9),
                text.interface("slope", self.friction),
                text.block("slope", "rock", on_slope(self.slope, (0, -1), (4, 0))),
                text.block("stone", "rock", on_slope(self.slope, (2, 0), (3, 0.4))),
                record("R1", RECORD, 0.1, f"scale = {self.scale!r}\n"),
                '[[supports]]\nname = "ground"\nblock = "slope"\nfix = ["x", "y"]\n'
                'motion = { x = "R1" }\n',
                text.monitor("stone", on_slope(self.slope, (2.5, 0.2), (3, 0.4))[0], "stone"),
                text.monitor("slope", on_slope(self.slope, (2.5, -0.5), (3, 0))[0], "slope"),
            ],
        )

    def measure(self, run: "Run") -> Checks:
        along = np.array([-np.cos(np.radians(self.slope)), -np.sin(np.radians(self.slope))])
        slid = (way(run, "stone") - way(run, "slope"))[-1] @ along
        reason = "contact springs give way by their slip before friction is reached"
        return {"way down the slope (m)": Check(float(slid), self.slides, 0.005, reason)}


def _one_cell(formulation: "Formulation") -> "Formulation":
    """Return a formulation of one cell over the square, its edges held by multipliers."""
    if formulation.cover.size is None:
        return formulation
    supports = formulation.supports.model_copy(update={"method": "lagrange"})
    return with_cover(formulation, size=1.0).model_copy(update={"supports": supports})
