"""One mass on one spring: what the integrators damp, stretch, and how fast they converge."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Self

import numpy as np

from integration.arrays import Floats
from nmm.verification import text
from nmm.verification.base import Case, Check, Checks, SceneCase
from nmm.verification.reading import way

if TYPE_CHECKING:
    from nmm.stepping.run import Run

# Omega: spectral radius and period elongation of Shi's rule, printed digits.
SHI = {
    0.05: (0.99937559, 2.863e-4),
    0.1: (0.99750934, 1.1436e-3),
    0.5: (0.94280904, 2.734e-2),
    1.0: (0.81649658, 9.681e-2),
}
ROUNDING = "rounding of the fit of a recurrence to the displacements"


def recurrence(u: Floats, omega: float) -> tuple[float, float]:
    """Return spectral radius and period elongation of ``u[n+1] = a u[n] + b u[n-1]``.

    Parameters
    ----------
    u
        Displacements at equal steps.
    omega
        Angular frequency times step (rad).
    """
    a, b = np.linalg.lstsq(np.column_stack([u[1:-1], u[:-2]]), u[2:], rcond=None)[0]
    radius = float(np.sqrt(-b))
    return radius, float(omega / np.arccos(a / (2 * radius)) - 1)


def oscillator(integrator: str, step: float, duration: float, options: str = "") -> str:
    """Scene of a block of 1 kg on a spring of 1000 E = 1e6 N/m, thrown with 1 m/s."""
    return text.scene(
        f'title = "Oscillator"\nplane = "stress"\nduration = {duration!r}\n[inertia]\n'
        f'[formulation.integrator]\ntype = "{integrator}"\nstep = {step!r}\n{options}',
        [
            text.material("mass", modulus=1e3, density=1.0),
            text.block("block", "mass", text.rectangle((-0.5, -0.5), (0.5, 0.5))),
            text.fixed_point("spring", [0, 0], "x"),
            '[[initial_velocities]]\nblock = "block"\nvelocity = [1, 0]\n',
            text.monitor("middle", (0, 0), "block"),
        ],
    )


FREQUENCY = 1e3
"""Angular frequency of `oscillator` (rad/s)."""


@dataclass(frozen=True)
class SpringBlock(SceneCase):
    """A rigid block thrown against the spring of its support: Shi's exact numerical damping."""

    name = "B9 damping"
    title = "Numerical damping and period of one oscillator"
    source = "Eigenvalues of the step: rho = 1 / sqrt(1 + Omega^2 / 2) (Shi)"
    formulations = ("rigid",)
    omega: float = 0.1
    integrator: str = "shi"
    label = "{0.integrator}, Omega {0.omega}"

    @classmethod
    def variants(cls) -> Sequence[Self]:
        """Return the tabulated frequencies with Shi's rule, and Newmark's without damping."""
        return [*(cls(omega) for omega in SHI), cls(0.1, "newmark"), cls(1.0, "newmark")]

    def scene(self) -> str:
        """Return the oscillator for 40 steps."""
        step = self.omega / FREQUENCY
        return oscillator(self.integrator, step, 40 * step)

    def measure(self, run: "Run") -> Checks:
        """Fit the recurrence of an oscillator to the displacements."""
        radius, elongation = recurrence(way(run, "middle")[:, 0], self.omega)
        if self.integrator == "newmark":
            return {"spectral radius": Check(radius, 1.0, 1e-10, ROUNDING)}
        expected, longer = SHI[self.omega]
        exact = float(1 / np.sqrt(1 + self.omega**2 / 2))
        return {
            "spectral radius": Check(radius, exact, 1e-10, ROUNDING),
            "spectral radius, printed": Check(radius, expected, 1e-8, "printed digits"),
            "period elongation": Check(elongation, longer, 3e-4, "printed digits"),
        }


@dataclass(frozen=True)
class IntegratorOrder(Case):
    """Error of the oscillator at a fixed time over three halvings of the step."""

    name = "B9 order"
    title = "Order of the time integrators"
    source = "u = (v / omega) sin(omega t)"
    formulations = ("rigid",)
    integrator: str = "shi"
    options: str = ""
    order: float = 1.0

    @classmethod
    def variants(cls) -> Sequence[Self]:
        """Return every integrator."""
        return [
            cls("shi"),
            cls("newmark", "beta = 0.25, gamma = 0.5", 2.0),
            cls("generalized_alpha", "rho_inf = 0.8", 2.0),
            cls("generalized_alpha", "rho_inf = 0.0", 2.0),
        ]

    @property
    def variant(self) -> str:
        return f"{self.integrator} {self.options}".rstrip()

    def checks(self, formulation: str) -> Checks:
        steps = np.array([64, 128, 256, 512])
        slope = -np.polyfit(np.log(steps), np.log([self._error(int(n)) for n in steps]), 1)[0]
        reason = "terms of the next order, a step of 1.3/64 over the first"
        return {"order": Check(float(slope), self.order, 0.05, reason, scale=1.0)}

    def _error(self, steps: int) -> float:
        from nmm.scene import parse_scene
        from nmm.stepping.run import run
        from nmm.verification.formulations import chosen

        duration = 1.3 / FREQUENCY
        options = f"options = {{ {self.options} }}\n"
        scene = parse_scene(oscillator(self.integrator, duration / steps, duration, options))
        done = run(scene, chosen("rigid", scene.formulation))
        return float(abs(way(done, "middle")[-1, 0] * FREQUENCY - np.sin(1.3)))


# Omega: spectral radii of generalised alpha by its radius at infinity.
RADII = {
    0.1: {1.0: 1.0, 0.8: 0.99999993, 0.5: 0.99999816, 0.0: 0.99995192},
    1.0: {1.0: 1.0, 0.8: 0.99947461, 0.5: 0.98931279, 0.0: 0.90656333},
    np.pi: {1.0: 1.0, 0.8: 0.98595438, 0.5: 0.86823387, 0.0: 0.54575749},
    10.0: {1.0: 1.0, 0.8: 0.92979177, 0.5: 0.68252842, 0.0: 0.24253563},
    100.0: {1.0: 1.0, 0.8: 0.83463761, 0.5: 0.53717362, 0.0: 0.04783128},
}


@dataclass(frozen=True)
class DampedSpring(SceneCase):
    """A block thrown against a spring loses by generalised alpha what its options ask for."""

    name = "IN1"
    title = "Spectral radii of generalised alpha"
    source = "Eigenvalues of the step of Chung and Hulbert (1993)"
    formulations = ("rigid",)
    omega: float = 1.0
    rho_inf: float = 0.8
    label = "Omega {0.omega:.4g}, radius {0.rho_inf:g} at infinity"

    @classmethod
    def variants(cls) -> Sequence[Self]:
        """Return radii at infinity at steps from a sixtieth to sixteen periods."""
        return [cls(omega, rho) for omega, known in RADII.items() for rho in known]

    def scene(self) -> str:
        """Return the oscillator for 12 steps."""
        step, options = self.omega / FREQUENCY, f"options = {{ rho_inf = {self.rho_inf} }}\n"
        return oscillator("generalized_alpha", step, 12 * step, options)

    def measure(self, run: "Run") -> Checks:
        """Fit a recurrence of three terms: place, velocity and acceleration are carried."""
        u = way(run, "middle")[:, 0]
        terms = np.column_stack([u[2:-1], u[1:-2], u[:-3]])
        roots = np.roots([1.0, *-np.linalg.lstsq(terms, u[3:], rcond=None)[0]])
        radius = float(np.abs(roots).max())
        return {"spectral radius": Check(radius, RADII[self.omega][self.rho_inf], 1e-6, ROUNDING)}
