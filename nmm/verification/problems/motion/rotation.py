"""Free bodies that turn: exact turning, the growth of the linear update, stress that turns."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar, Self

import numpy as np

from integration.arrays import Floats
from nmm.verification import text
from nmm.verification.base import MESHES, Check, Checks, SceneCase, limit
from nmm.verification.reading import current_areas, last_way, mean_stress, rates
from nmm.verification.text import G

if TYPE_CHECKING:
    from nmm.stepping.run import Run

TURN = 2 * np.pi
SQUARE = text.rectangle((-0.5, -0.5), (0.5, 0.5))
DENSITY, MODULUS, POISSON = 1000.0, 20e9, 0.3


def spinning(
    duration: float,
    step: float,
    velocity: str,
    more: Sequence[str] = (),
    shape: Floats = SQUARE,
) -> str:
    """Scene of a free body, a square of 1 m if nothing else is given, with a velocity."""
    return text.scene(
        f'title = "Free square"\nplane = "stress"\nduration = {duration!r}\n[inertia]\n'
        f"[formulation.integrator]\nstep = {step!r}\n",
        [
            text.material("rock", modulus=MODULUS, poisson=POISSON, density=DENSITY),
            text.block("square", "rock", shape),
            f'[[initial_velocities]]\nblock = "square"\n{velocity}\n',
            text.monitor("middle", (0, 0), "square"),
            *more,
        ],
    )


class Projectile(SceneCase):
    """A thrown, spinning square flies a parabola, turns evenly, and feels nothing."""

    name = "B13"
    title = "Projectile"
    source = "x = v t + g t^2 / 2, theta = omega t"
    formulations = ("dda", "rigid", "degree 2", "newmark", *MESHES)
    duration = 1.0

    def scene(self) -> str:
        """Return a square with v = (3, 4) m/s and omega = 2 rad/s under gravity."""
        velocity = "velocity = [3, 4]\nangular_velocity = 2"
        return spinning(self.duration, 0.01, velocity, ["[gravity]\n"])

    def measure(self, run: "Run") -> Checks:
        x, y = last_way(run, "middle")
        vx, vy, omega = rates(run)[0]
        strain = np.abs(run.stepper.model.mean_strain(run.state.deformation)).max()
        reason = "residual of a hundred solutions: the rule is exact for constant acceleration"
        turn = "a square stretched by 1e-8 turns slower by twice that"
        return {
            "x (m)": Check(x, 3.0, 1e-9, reason),
            "y (m)": Check(y, 4 - G / 2, 1e-9, reason),
            "vx (m/s)": Check(vx, 3.0, 1e-9, reason),
            "vy (m/s)": Check(vy, 4 - G, 1e-9, reason),
            "angle (rad)": Check(float(run.state.frames.angle[0]), 2.0, 1e-7, turn),
            "rate (rad/s)": Check(omega, 2.0, 1e-7, turn),
            "strain": limit(float(strain), 3e-8, "rho omega^2 a^2 / 8 / E = 2.5e-8 in the middle"),
        }


@dataclass(frozen=True)
class Spin(SceneCase):
    """A spun rectangle keeps its area and its rate; its stress is centrifugal and turns along."""

    name = "B14 spin"
    title = "Free rectangle spun by one turn or by a quarter"
    source = "Mean stress rho omega^2 a^2 / 12 along a side of length a"
    formulations = ("dda", "degree 2", *MESHES)
    steps: int = 1000
    turns: float = 1.0
    length: float = 1.0
    label = "{0.steps} steps, {0.turns:g} turns"

    @classmethod
    def variants(cls) -> Sequence[Self]:
        """Return a square through one turn and a 2 m x 1 m rectangle through a quarter."""
        return [cls(100), cls(1000), cls(1000, 0.25, 2.0)]

    def scene(self) -> str:
        """Return a body that turns by so much in 1 s."""
        shape = text.rectangle((-self.length / 2, -0.5), (self.length / 2, 0.5))
        velocity = f"angular_velocity = {self.turns * TURN!r}"
        return spinning(1.0, 1.0 / self.steps, velocity, shape=shape)

    def measure(self, run: "Run") -> Checks:
        omega = self.turns * TURN
        along, across = (DENSITY * omega**2 * a**2 / 12 for a in (self.length, 1.0))
        upright = self.turns == 0.25
        want_x, want_y = (across, along) if upright else (along, across)
        sxx, syy, sxy = mean_stress(run)
        drift = abs(rates(run)[0, 2] / omega - 1)
        kinetic = run.history["kinetic_energy"]
        strain = (along + across) * (1 - POISSON) / MODULUS
        reason = "a sawtooth of 4 / Omega^2 of the strain, which Shi's rule hardly damps"
        return {
            "area (m2)": Check(
                float(current_areas(run).sum()),
                self.length * (1 + strain),
                1e-8,
                "the benchmark's limit",
            ),
            "drift of omega": limit(drift, 1e-6, "the benchmark's limit"),
            "growth of kinetic energy": limit(
                kinetic[-1] / kinetic[0] - 1, 1e-12, "no secular growth"
            ),
            "sxx (Pa)": Check(sxx, want_x, 1e-3, reason),
            "syy (Pa)": Check(syy, want_y, 1e-3, reason),
            "sxy (Pa)": Check(sxy, 0.0, 1e-3, reason, scale=along),
        }


@dataclass(frozen=True)
class LinearSpin(SceneCase):
    """The classical update makes a turning square grow by ``1 + r0^2`` a step."""

    name = "B14 classical"
    title = "Growth of a square under the classical update"
    source = "(1 + (2 pi / n)^2)^n (MacLaughlin and Sitar 1996)"
    formulations = ("classical",)
    steps: int = 100
    parameters: ClassVar = {"steps": (100, 1000)}
    label = "{0.steps} steps"

    def scene(self) -> str:
        """Return a square turning once in 1 s."""
        return spinning(1.0, 1.0 / self.steps, f"angular_velocity = {TURN!r}")

    def measure(self, run: "Run") -> Checks:
        printed = {100: 1.48291085, 1000: 1.04026724}[self.steps]
        return {
            "area (m2)": Check(float(current_areas(run).sum()), printed, 1e-8, "printed digits")
        }


class TurnedStress(SceneCase):
    """A uniaxial initial stress turns with the material by 90 degrees.

    The block is rigid: an elastic one, free, would release the stress.
    """

    name = "B14 stress"
    title = "Uniaxial stress turned by 90 degrees"
    source = "R sigma R^T: sxx = 1 becomes syy = 1"
    formulations = ("rigid",)
    stress = 1e6

    def scene(self) -> str:
        """Return a square that carries an initial stress and turns by a quarter."""
        initial = f'[[initial_stresses]]\nblock = "square"\nstress = [{self.stress!r}, 0, 0]\n'
        return spinning(1.0, 0.01, f"angular_velocity = {TURN / 4!r}", [initial])

    def measure(self, run: "Run") -> Checks:
        sxx, syy, sxy = run.stress[0]
        reason = "the benchmark's tolerance"
        return {
            "sxx (Pa)": Check(sxx, 0.0, 1e-6, reason, scale=self.stress),
            "syy (Pa)": Check(syy, self.stress, 1e-6, reason),
            "sxy (Pa)": Check(sxy, 0.0, 1e-6, reason, scale=self.stress),
        }
