"""A square that is spun fast enough to stretch: energy and momenta in flight."""

from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Floats
from nmm.assembly.moving.momenta import own_momenta
from nmm.verification import text
from nmm.verification.base import Checks, SceneCase, limit
from nmm.verification.reading import last_way

if TYPE_CHECKING:
    from nmm.stepping.run import Run

MODULUS, POISSON = 1000.0, 0.3
CORNERS = text.rectangle((-0.5, -0.5), (0.5, 0.5))


def pseudo_rigid(spin: float, duration: float) -> Floats:
    """Deformation gradient (2, 2) of a unit square of one strain and density 1 in flight.

    ``F'' / 12 = -P(F)`` in plane strain by St Venant and Kirchhoff's law, by a method of order 8.
    """
    from scipy.integrate import solve_ivp

    mu = MODULUS / (2 * (1 + POISSON))
    lame = 2 * mu * POISSON / (1 - 2 * POISSON)

    def rates(_: float, y: Floats) -> Floats:
        f = y[:4].reshape(2, 2)
        strain = (f.T @ f - np.eye(2)) / 2
        pull = f @ (lame * np.trace(strain) * np.eye(2) + 2 * mu * strain)
        return np.concatenate([y[4:], -12 * pull.ravel()])

    start = np.array([1, 0, 0, 1, 0, -spin, spin, 0], dtype=float)
    found = solve_ivp(rates, (0, duration), start, method="DOP853", rtol=1e-11, atol=1e-12)
    return np.asarray(found.y[:4, -1].reshape(2, 2))


class SpunSquare(SceneCase):
    """A square is spun from rest shape: it stretches by 3 % and swings, and keeps what it has."""

    name = "IN2"
    title = "Energy and angular momentum of a body that spins and swings"
    source = "E = rho a^4 omega^2 / 12, L = rho a^4 omega / 6; an ODE of order 8"
    formulations = ("dda", "manifold", "quads degree 2", "splines")
    spin = 20.0
    duration = 0.1

    def scene(self) -> str:
        """Return a free square and steps of a fiftieth of its swing."""
        return text.scene(
            f'title = "Spun square"\nplane = "strain"\nduration = {self.duration!r}\n[inertia]\n',
            [
                text.material("rubber", MODULUS, POISSON, 1.0),
                text.block("square", "rubber", CORNERS),
                f'[[initial_velocities]]\nblock = "square"\nangular_velocity = {self.spin!r}\n',
                *(
                    text.monitor(f"corner {number}", place, "square")
                    for number, place in enumerate(CORNERS)
                ),
                '[formulation.integrator]\ntype = "energy_momentum"\nstep = 0.001\n'
                '[formulation.rotation]\nupdate = "finite"\n',
            ],
        )

    def measure(self, run: "Run") -> Checks:
        model, history = run.stepper.model, run.history
        energy = history["kinetic_energy"] + history["strain_energy"]
        own = own_momenta(model, run.state, finite=True)[0]
        kept, start = "tolerance of the iterations, over a hundred steps", self.spin**2 / 12
        checks = {
            "change of energy": limit(float(np.abs(energy / start - 1).max()), 1e-11, kept),
            "change of angular momentum": limit(
                float(abs(own[2] / (self.spin / 6) - 1)), 1e-11, kept
            ),
            "momentum (N s)": limit(float(np.hypot(*own[:2])), 1e-11, "none at the start"),
        }
        if model.manifold.n_unknowns > 6:
            return checks
        places = CORNERS + [last_way(run, f"corner {number}") for number in range(4)]
        found = np.linalg.lstsq(CORNERS, places - places.mean(axis=0), rcond=None)[0].T
        exact = pseudo_rigid(self.spin, self.duration)
        off = float(np.abs(found - exact).max())
        checks["deformation gradient"] = limit(off, 2e-2, "of order 2: a fortieth at half the step")
        return checks


class LongFlight(SceneCase):
    """The square in flight for two thousand steps that do not resolve how it swings."""

    name = "IN3"
    title = "Energy and angular momentum over two thousand steps"
    source = "E = rho a^4 omega^2 / 12, L = rho a^4 omega / 6"
    steps = 2_000
    slow = True

    def scene(self) -> str:
        """Return the spun square with steps of half a swing."""
        step, duration = "step = 0.01", f"duration = {0.01 * self.steps!r}"
        text = SpunSquare().scene().replace("step = 0.001", step)
        return text.replace("duration = 0.1", f"{duration}")

    def measure(self, run: "Run") -> Checks:
        model, history, spin = run.stepper.model, run.history, SpunSquare.spin
        energy = history["kinetic_energy"] + history["strain_energy"]
        own = own_momenta(model, run.state, finite=True)[0]
        off = np.abs(energy / (spin**2 / 12) - 1)
        kept = "tolerance of the iterations, each of which may add up"
        return {
            "change of energy": limit(float(off.max()), 1e-9, kept),
            "change of angular momentum": limit(float(abs(own[2] / (spin / 6) - 1)), 1e-10, kept),
        }
