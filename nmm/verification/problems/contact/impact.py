"""Bodies that meet: a drop on a springy floor, and blocks that exchange their velocities."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase, holds, limit
from nmm.verification.reading import momentum, rates, way
from nmm.verification.text import G

if TYPE_CHECKING:
    from nmm.stepping.run import Run

INTEGRATORS = ("shi", "newmark", "generalized_alpha")

STIFFNESS = 1e8
"""Spring between floor and falling block, both of its corners together (N/m)."""


def _drop(gap: float, duration: float, step: float, integrator: str, velocity: float) -> str:
    """Scene of a block of 1000 kg above a floor that nothing moves.

    The penalty is a multiple of the floor's modulus, 5e-5 of 1e12 Pa at each of two corners; the
    floor's own supports are 1e7 times as stiff.
    """
    return text.scene(
        f'title = "Drop"\nplane = "strain"\nduration = {duration!r}\n[gravity]\n[inertia]\n'
        f"[contact]\n[formulation.contact]\nnormal_penalty = {STIFFNESS / 2 / 1e12!r}\n"
        f'[formulation.integrator]\ntype = "{integrator}"\nstep = {step!r}\n',
        [
            text.material("floor", modulus=1e12, density=1000.0),
            text.material("block", modulus=1e10, density=1000.0),
            text.interface("contact", 0.0),
            text.block("floor", "floor", text.rectangle((-1, -1), (2, 0))),
            text.block("block", "block", text.rectangle((0, gap), (1, 1 + gap))),
            text.fixed_block("floor"),
            f'[[initial_velocities]]\nblock = "block"\nvelocity = [0, {velocity!r}]\n',
            text.monitor("corner", (0, gap), "block"),
        ],
    )


class Drop(SceneCase):
    """A block that fell 1 m meets the floor: penetration, duration, height of rebound.

    The scene begins 1 mm above the floor with the velocity of the fall so far.
    """

    name = "B7 rebound"
    title = "Block dropped by 1 m on a floor of springs"
    source = "m x'' = m g - k x with x' = sqrt(2 g h) at touch"
    formulations = ("rigid",)
    step = 2e-5
    gap = 1e-3
    duration = 0.0125

    def scene(self) -> str:
        """Return the last millimetre of the fall and the impact, undamped."""
        velocity = -float(np.sqrt(2 * G * (1 - self.gap)))
        return _drop(self.gap, self.duration, self.step, "newmark", velocity)

    def measure(self, run: "Run") -> Checks:
        time, height = run.history["time"], way(run, "corner")[:, 1] + self.gap
        below = np.flatnonzero(height < 0)
        ends = [below[0] - 1, below[-1]]
        touch, leave = (
            time[i] - height[i] * (time[i + 1] - time[i]) / (height[i + 1] - height[i])
            for i in ends
        )
        left = rates(run)[1, 1] + G * (time[-1] - leave)
        reason = "1/500 of the contact's duration is a step: its square, 4e-6, times ten"
        return {
            "penetration (m)": Check(-float(height.min()), 1.41055846e-2, 1e-4, reason),
            "contact (s)": Check(leave - touch, 9.97888e-3, 1e-3, "half a step"),
            "flight (s)": Check(2 * left / G, 0.90304728, 1e-3, "work of half a step's force"),
        }


@dataclass(frozen=True)
class NoGain(SceneCase):
    """Dropped with coarse steps, the block never has more energy than at the start."""

    name = "B7 energy"
    title = "Block dropped by 1 m with 10 steps in contact"
    source = "Conservation of energy: a gain is a failure"
    formulations = ("rigid",)
    step: float = 1e-3
    integrator: str = "shi"
    parameters: ClassVar = {"integrator": INTEGRATORS, "step": (1e-3, 5e-3)}
    label = "{0.integrator}, step {0.step:g} s"

    def scene(self) -> str:
        """Return the fall and the rebound."""
        return _drop(1.0, 1.5, self.step, self.integrator, 0.0)

    def measure(self, run: "Run") -> Checks:
        height, history = way(run, "corner")[:, 1], run.history
        deepest = int(height.argmin())
        energy = history["kinetic_energy"] + history["contact_energy"] - history["external_work"]
        first = 1000.0 * G * 1.0
        reason = "rounding of the sum of the work"
        return {
            "height of the rebound over that of the drop": limit(
                1 + float(height[deepest:].max()), 1.0, "no gain"
            ),
            "gain of energy": limit(float(energy.max()) / first, 1e-9, reason),
        }


@dataclass(frozen=True)
class Exchange(SceneCase):
    """Two equal blocks meet centrally: 1 and 0 m/s become 0 and 1, momentum stays."""

    name = "B8"
    title = "Central impact of two equal blocks"
    source = "Conservation of momentum and energy"
    formulations = ("rigid", "dda", "degree 2")
    integrator: str = "newmark"
    parameters: ClassVar = {"integrator": INTEGRATORS}
    label = "{0.integrator}"

    def scene(self) -> str:
        """Return two free squares, one of them moving."""
        return text.scene(
            'title = "Central impact"\nplane = "strain"\nduration = 0.1\n[inertia]\n[contact]\n'
            "[formulation.contact]\nnormal_penalty = 0.005\n"
            f'[formulation.integrator]\ntype = "{self.integrator}"\nstep = 2e-4\n',
            [
                text.material("rock", modulus=1e10, density=1000.0),
                text.interface("contact", 0.0),
                text.block("left", "rock", text.rectangle((0, 0), (1, 1))),
                text.block("right", "rock", text.rectangle((1.01, 0), (2.01, 1))),
                '[[initial_velocities]]\nblock = "left"\nvelocity = [1, 0]\n',
            ],
        )

    def measure(self, run: "Run") -> Checks:
        left, right = rates(run)[:, 0]
        px, py, spin = momentum(run)
        exact = "the benchmark's tolerance, of a momentum of 1000 N s"
        # Angular momentum of the left block about the origin: -0.5 m x 1000 N s.
        checks = {
            "momentum x (N s)": Check(px, 1000.0, 1e-10, exact),
            "momentum y (N s)": Check(py, 0.0, 1e-10, exact, scale=1000.0),
            "angular momentum (N m s)": Check(spin, -500.0, 1e-10, exact),
        }
        h = run.history
        energy = h["kinetic_energy"] + h["strain_energy"] + h["contact_energy"]
        gain = float(energy.max() / energy[0]) - 1
        checks["gain of energy"] = limit(gain, 1e-9, "rounding of the sum of energies")
        if self.integrator != "shi":
            reason = "a closing and an opening step, 1/70 of the contact's duration each"
            checks["velocity left (m/s)"] = Check(left, 0.0, 0.02, reason, scale=1.0)
            checks["velocity right (m/s)"] = Check(right, 1.0, 0.02, reason)
        return checks


@dataclass(frozen=True)
class Oblique(SceneCase):
    """Spinning blocks meet at a corner with friction: momentum stays whatever the damping."""

    name = "B8 oblique"
    title = "Oblique impact of two spinning blocks with friction"
    source = "Conservation of momentum and angular momentum"
    formulations = ("rigid", "dda", "degree 2", "newmark", "manifold")
    step: float = 1e-3
    # A step longer than the impact and one that resolves it.
    parameters: ClassVar = {"step": (1e-3, 1e-4)}
    label = "step {0.step:g} s"

    def scene(self) -> str:
        """Return a square flying with spin at another, which is free."""
        return text.scene(
            'title = "Oblique impact"\nplane = "strain"\nduration = 0.06\n[inertia]\n[contact]\n'
            f"[formulation.integrator]\nstep = {self.step!r}\n",
            [
                text.material("rock", modulus=1e9, density=1000.0),
                text.interface("contact", 30.0),
                text.block("left", "rock", text.turned(text.rectangle((0, 0), (1, 1)), 0.3)),
                text.block("right", "rock", text.rectangle((1.0, 0), (2.5, 2))),
                '[[initial_velocities]]\nblock = "left"\nvelocity = [2, 1]\n'
                "angular_velocity = 1.5\n",
            ],
        )

    def measure(self, run: "Run") -> Checks:
        mass = 1000.0
        centre = text.turned(np.array([[0.5, 0.5]]), 0.3)[0]
        spin = mass * (1.5 / 6 + centre[0] * 1.0 - centre[1] * 2.0)
        px, py, found = momentum(run)
        h, exact = run.history, "the benchmark's tolerance, of the largest momentum"
        energy = h["kinetic_energy"] + h["strain_energy"] + h["contact_energy"]
        return {
            "momentum x (N s)": Check(px, 2 * mass, 1e-10, exact),
            "momentum y (N s)": Check(py, mass, 1e-10, exact, scale=2 * mass),
            "angular momentum (N m s)": Check(found, float(spin), 1e-10, exact, scale=2 * mass),
            "gain of energy": limit(
                float(energy.max() / energy[0]) - 1,
                1e-6,
                "strain by the pull outwards, (rho omega^2 a^2 / 12)^2 / 2 E of rho v^2 / 2",
            ),
            "they meet": holds(float(h["penetration"].max()) > 0, "by the choice of the velocity"),
        }
