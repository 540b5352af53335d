"""A block on a slope: rest, slip, sliding, and two blocks in train."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar, Self

import numpy as np

from integration.arrays import Floats
from nmm.verification import text
from nmm.verification.base import EXACT, Check, Checks, SceneCase, holds, limit
from nmm.verification.reading import converged, joint_force, last_way, masses, rates, way
from nmm.verification.text import G

if TYPE_CHECKING:
    from nmm.stepping.run import Run

DENSITY = 2600.0


def acceleration(slope: float, friction: float) -> float:
    """Acceleration down a slope against Coulomb friction; both angles in degrees."""
    a, phi = np.radians([slope, friction])
    return float(G * (np.sin(a) - np.cos(a) * np.tan(phi)))


def down(slope: float) -> Floats:
    """Unit vector down the slope."""
    a = np.radians(slope)
    return np.array([-np.cos(a), -np.sin(a)])


def on_slope(slope: float, low: tuple[float, float], high: tuple[float, float]) -> Floats:
    """Rectangle given by coordinates up the slope and away from it."""
    return text.turned(text.rectangle(low, high), float(np.radians(slope)))


def _head(title: str, duration: float | None, step: float) -> str:
    time = "" if duration is None else f"duration = {duration!r}\n"
    return (
        f'title = "{title}"\nplane = "strain"\n{time}[gravity]\n[contact]\n'
        f"[formulation.integrator]\nstep = {step!r}\n"
    )


@dataclass(frozen=True)
class FrictionThreshold(SceneCase):
    """A square block rests when friction exceeds the slope, and slides when it does not."""

    name = "B1 friction"
    title = "Block on a slope of 30 degrees: rest or slip"
    source = "Coulomb: rest iff tan phi >= tan alpha, else a = g (sin a - cos a tan)"
    friction: float = 30.5
    duration: float = 1.0
    slope = 30.0
    parameters: ClassVar = {"friction": (30.5, 29.5)}
    label = "phi {0.friction}"

    def scene(self) -> str:
        """Return a held base and a block of 1 m on it."""
        return text.scene(
            _head("Block on a slope", self.duration, 0.01) + "[inertia]\n",
            [
                text.material("rock", density=DENSITY),
                text.interface("slope", self.friction),
                text.block("base", "rock", on_slope(self.slope, (0, -1), (4, 0))),
                text.block("block", "rock", on_slope(self.slope, (2, 0), (3, 1))),
                text.fixed_block("base"),
                text.monitor("toe", on_slope(self.slope, (2, 0), (3, 1))[0], "block"),
            ],
        )

    def measure(self, run: "Run") -> Checks:
        slid = way(run, "toe") @ down(self.slope)
        if self.friction >= self.slope:
            half = slid[len(slid) // 2]
            return {
                "creep (m)": limit(abs(slid[-1]), 1e-4, "the benchmark's limit over 10 s"),
                "creep of the second half (m)": limit(
                    slid[-1] - half, 1e-9, "a tenth of the penetration of the contacts"
                ),
            }
        expected = acceleration(self.slope, self.friction) * self.duration**2 / 2
        reason = "the benchmark's 0.2 %; shear springs of 2e12 N/m stretch by 1e-8 m before"
        return {"way (m)": Check(slid[-1], expected, 0.002, reason)}


@dataclass(frozen=True)
class CohesiveThreshold(SceneCase):
    """A bonded slab holds iff ``c A + W cos a tan phi >= W sin a``; the bond is lost for good.

    The slab is flat, so that its weight presses both ends of the joint alike and the brittle bond
    fails as one.
    """

    name = "B1 cohesion"
    title = "Slab bonded to a slope of 30 degrees"
    source = "Balance of forces along the slope"
    factor: float = 1.02
    slope = 30.0
    friction = 20.0
    height = 0.01
    parameters: ClassVar = {"factor": (1.02, 0.98)}  # cohesions 2 % above and 2 % below the limit
    label = "c {0.factor}"

    @property
    def cohesion(self) -> float:
        """Cohesion (Pa) on the slab's 1 m2."""
        pull = DENSITY * self.height * acceleration(self.slope, self.friction)
        return self.factor * pull

    def scene(self) -> str:
        """Return a held base and the slab."""
        strength = {"cohesion": self.cohesion, "tensile_strength": 1e6, "bonded": True}
        return text.scene(
            _head("Bonded slab on a slope", 0.5, 0.01) + "[inertia]\n",
            [
                text.material("rock", density=DENSITY),
                text.interface("bond", self.friction, more=strength),
                text.block("base", "rock", on_slope(self.slope, (0, -1), (4, 0))),
                text.block("slab", "rock", on_slope(self.slope, (2, 0), (3, self.height))),
                text.fixed_block("base"),
                text.monitor("toe", on_slope(self.slope, (2, 0), (3, 1))[0], "slab"),
            ],
        )

    def measure(self, run: "Run") -> Checks:
        slid = float(last_way(run, "toe") @ down(self.slope))
        if self.factor >= 1:
            return {
                "way (m)": limit(slid, 1e-8, "the bond's own spring stretches by 6.4e-9 m"),
                "broken bonds": Check(run.history["broken"][-1], 0.0, 0.0, "it holds"),
            }
        expected = acceleration(self.slope, self.friction) * 0.5**2 / 2
        reason = "the benchmark's 0.2 % for sliding; all cohesion is lost in the first step"
        return {"way (m)": Check(slid, expected, 0.002, reason)}


@dataclass(frozen=True)
class Sliding(SceneCase):
    """Way, velocity and energy of a sliding block."""

    name = "B2"
    title = "Block sliding down a slope"
    source = "s = a t^2 / 2 with a = g (sin alpha - cos alpha tan phi)"
    formulations = ("dda", "degree 2", "newmark", "finite elements", *EXACT)
    slope: float = 30.0
    friction: float = 20.0
    step: float = 0.01
    label = "{0.slope:g} and {0.friction:g} degrees"

    @classmethod
    def variants(cls) -> Sequence[Self]:
        """Return both pairs of angles."""
        return [cls(30.0, 20.0), cls(45.0, 30.0)]

    def scene(self) -> str:
        """Return a held base and a block of 1 m that slides on it for 1 s."""
        block = on_slope(self.slope, (4, 0), (5, 1))
        return text.scene(
            _head("Sliding block", 1.0, self.step) + "[inertia]\n",
            [
                text.material("rock", density=DENSITY),
                text.interface("slope", self.friction),
                text.block("base", "rock", on_slope(self.slope, (0, -1), (6, 0))),
                text.block("block", "rock", block),
                text.fixed_block("base"),
                text.monitor("toe", block[0], "block"),
            ],
        )

    def measure(self, run: "Run") -> Checks:
        a = acceleration(self.slope, self.friction)
        slid = float(last_way(run, "toe") @ down(self.slope))
        velocity = float(rates(run)[1, :2] @ down(self.slope))
        last = {name: float(values[-1]) for name, values in run.history.items()}
        rest = last["external_work"] - last["kinetic_energy"] - last["friction_loss"]
        benchmark = "the benchmark's tolerance for steps of 1 ms; Shi's steps are exact here"
        return {
            "way (m)": Check(slid, a / 2, 0.002, benchmark),
            "velocity (m/s)": Check(velocity, a, 0.005, benchmark),
            "work - kinetic energy - friction work (J)": Check(
                rest, 0.0, 0.002, benchmark, scale=last["external_work"]
            ),
        }


@dataclass(frozen=True)
class Train(SceneCase):
    """Two blocks on a slope: the smooth upper one pushes the rough lower one, or they part."""

    name = "B4"
    title = "Two blocks in train on a slope of 30 degrees"
    source = "Balance of forces along the slope of both blocks together"
    lower: float = 35.0
    upper: float = 15.0
    slope = 30.0
    label = "lower {0.lower:g}, upper {0.upper:g}"

    @classmethod
    def variants(cls) -> Sequence[Self]:
        """Return the pushing pair and the same with the friction angles swapped."""
        return [cls(35.0, 15.0), cls(15.0, 35.0)]

    def scene(self) -> str:
        """Return a lower block of 1000 kg and an upper one of 2000 kg."""
        lower, upper = (
            on_slope(self.slope, (x, 0), (x + length, 1)) for x, length in ((3, 1), (4, 2))
        )
        return text.scene(
            _head("Two blocks in train", 1.0, 0.01) + "[inertia]\n",
            [
                *(text.material(name, density=1000.0) for name in ("base", "low", "up")),
                text.interface("under_low", self.lower, ("base", "low")),
                text.interface("under_up", self.upper, ("base", "up")),
                text.interface("between", 0.0, ("low", "up")),
                text.block("base", "base", on_slope(self.slope, (0, -1), (8, 0))),
                text.block("lower", "low", lower),
                text.block("upper", "up", upper),
                text.fixed_block("base"),
                text.monitor("lower", lower[0], "lower"),
                text.monitor("upper", upper[0], "upper"),
            ],
        )

    def measure(self, run: "Run") -> Checks:
        low, up = (float(last_way(run, name) @ down(self.slope)) for name in ("lower", "upper"))
        reason = "the benchmark's 0.2 % of B2"
        masses_of = masses(run)[1:]
        a_low, a_up = acceleration(self.slope, self.lower), acceleration(self.slope, self.upper)
        if self.lower < self.slope:
            return {
                "way of the lower block (m)": Check(low, a_low / 2, 0.002, reason),
                "way of the upper block (m)": limit(abs(up), 1e-4, "it rests"),
            }
        together = (a_low * masses_of[0] + a_up * masses_of[1]) / masses_of.sum()
        place = run.stepper.place(run.state)[8]  # lower corner of the upper block's front
        force = -joint_force(run, place, down(self.slope))[0]
        return {
            "way of the lower block (m)": Check(low, together / 2, 0.002, reason),
            "way of the upper block (m)": Check(up, together / 2, 0.002, reason),
            "force between them (N)": Check(force, 2448.227, 0.002, reason),
            "acceleration (m/s2)": Check(together, 1.40446784, 1e-8, "printed digits"),
            "all steps converged": holds(converged(run), "no step may be given up"),
        }
