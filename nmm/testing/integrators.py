"""What every time integrator is held to, on one mass with one spring."""

from dataclasses import dataclass, replace

import numpy as np

from integration.arrays import Floats
from nmm.integrators.base import Integrator
from nmm.testing.claims import claim, close, finite

# Of motions without curvature; a step of 1e-2 leaves six digits of 1e-16 for its square.
EXACT = 1e-10
# Angular frequency times step, from resolved to stiff, for the gain of amplitude in a step.
STEPS = np.geomspace(1e-3, 1e4, 36)
# An eigenvalue of multiplicity two moves by the root of rounding.
GAIN = 1e-7
# Observed orders of a halved step are within this of the asymptotic ones at the steps used.
NEAR = 0.15


@dataclass(frozen=True)
class Oscillator:
    """A mass on a spring under a constant force, as the step loop puts it to an integrator."""

    integrator: Integrator
    stiffness: float
    force: float = 0.0
    mass: float = 1.0

    def begun(self, place: float, speed: float) -> Floats:
        """Return place, velocity and the acceleration that fits them."""
        return np.array([place, speed, (self.force - self.stiffness * place) / self.mass])

    def after(self, state: Floats, step: float, push: float = 0.0) -> Floats:
        """Return place, velocity and acceleration after a step with a mean contact force."""
        rule, (place, speed, rate) = self.integrator, state
        weight, factor = rule.end_weight, rule.mass_factor(step)
        speeds, rates = np.array([rule.kinetic_factor * speed]), np.array([rate])
        momentum = self.mass * rule.momentum(speeds, rates, step)[0]
        left = factor * self.mass + weight * self.stiffness
        right = self.force - self.stiffness * place + momentum + rule.contact_factor * push
        increment = right / left
        velocity, acceleration = rule.rates(np.array([increment]), speeds, rates, step)
        kick, jolt = rule.contact_kick
        gained = push / self.mass
        end = place + increment, velocity[0] + kick * step * gained, acceleration[0] + jolt * gained
        return np.array(end)

    def run(self, state: Floats, duration: float, steps: int) -> Floats:
        """Return the state at the end of so many steps."""
        for _ in range(steps):
            state = self.after(state, duration / steps)
        return state


def check_integrator(integrator: Integrator, order: float | None = None) -> None:
    """Hold a time integrator to what every one promises, without damping by ``kinetic_factor``.

    A free body keeps its velocity, and a constant force changes its momentum by its impulse, as
    does a contact: momentum and rigid motion are exact. Under it a body falls by ``f t^2 / 2 m``,
    to one step's worth where the order is one. A vibration never grows, however stiff, or up to the
    `Integrator.limit`; its phase converges with the ``order`` that is claimed, at least with one.
    With ``kinetic_factor = 0`` nothing is carried from step to step. Shares are within the range
    that contact asks for.

    Raises
    ------
    AssertionError
        Naming the property that is not kept, by how much, and what was tolerated.
    """
    name, rule = type(integrator).__name__, replace(integrator, kinetic_factor=1.0)
    _shares(rule, name)
    _rigid(rule, name, order)
    _stable(rule, name)
    _order(rule, name, order)
    _static(replace(integrator, kinetic_factor=0.0), name)


def _shares(rule: Integrator, name: str) -> None:
    weight, contact = rule.end_weight, rule.contact_weight
    claim(0 <= weight <= 1, f"{name}: end_weight {weight}: expected a share in [0, 1]")
    claim(weight > 0 or rule.limit < np.inf, f"{name}: explicit without limit: give one")
    claim(0.5 <= contact <= 1, f"{name}: contact_weight {contact}: expected from 1/2 to 1")
    claim(rule.contact_factor > 0, f"{name}: contact_factor {rule.contact_factor}: expected > 0")
    for step in (1e-6, 1.0, 1e3):
        factor = rule.mass_factor(step) * step**2
        claim(factor > 0, f"{name}: mass_factor times step^2 is {factor:.3g}, expected > 0")


def _rigid(rule: Integrator, name: str, order: float | None) -> None:
    step, speed, force, mass = 1e-2, 3.0, 5.0, 2.0
    free = Oscillator(rule, 0.0, 0.0, mass)
    found = free.run(free.begun(0.0, speed), 10 * step, 10)
    close(f"{name}: place of a free body", found[0], 10 * step * speed, EXACT)
    close(f"{name}: velocity of a free body", found[1], speed, EXACT)
    falls = Oscillator(rule, 0.0, force, mass)
    found, time = falls.run(falls.begun(0.0, speed), 10 * step, 10), 10 * step
    way = speed * time + force / mass * time**2 / 2
    allowed = EXACT if order is not None and order >= 2 else force / mass * time * step
    close(f"{name}: place of a falling body", found[0], way, allowed)
    close(
        f"{name}: momentum of a falling body", mass * found[1], mass * speed + force * time, EXACT
    )
    hit = free.after(free.begun(0.0, speed), step, push=force)
    gained = mass * (hit[1] - speed)
    close(f"{name}: momentum gained from a contact's impulse", gained, step * force, EXACT)
    way = step * speed + step**2 / 2 * force / mass
    close(f"{name}: way under a contact's force", hit[0], way, EXACT)


def _stable(rule: Integrator, name: str) -> None:
    for omega in STEPS[rule.limit > STEPS]:
        one = Oscillator(rule, omega**2)
        columns = [one.after(axis, 1.0) for axis in np.eye(3)]
        finite(f"{name}: step of omega dt = {omega:.3g}", columns)
        radius = float(np.abs(np.linalg.eigvals(np.stack(columns, axis=1))).max())
        claim(
            radius <= 1 + GAIN,
            f"{name}: a vibration with omega dt = {omega:.3g} grows {radius:.6g} times a step: "
            f"expected at most 1 + {GAIN:g}",
        )


def _order(rule: Integrator, name: str, order: float | None) -> None:
    one, duration = Oscillator(rule, 1.0), 2.0
    exact = np.array([np.cos(duration), -np.sin(duration)])
    errors = [
        float(np.linalg.norm(one.run(one.begun(1.0, 0.0), duration, steps)[:2] - exact))
        for steps in (200, 400)
    ]
    found = float(np.log2(errors[0] / errors[1])) if errors[1] > 0 else np.inf
    least = 1.0 if order is None else order
    sentence = f"{name}: order {found:.2f} at a halved step (error {errors[1]:.3g} of 1)"
    claim(found > least - NEAR, f"{sentence}: expected at least {least:g}")
    if order is not None:
        claim(found < order + NEAR + 0.5, f"{sentence}: claimed {order:g}")


def _static(rule: Integrator, name: str) -> None:
    """A spring under a load is left at rest of itself: the velocity of a step does not enter."""
    one = Oscillator(rule, 1.0, 1.0)
    calm, fast = (one.after(np.array([0.2, speed, 0.0]), 0.5)[0] for speed in (0.0, 7.0))
    close(
        f"{name}: with kinetic_factor 0, place after a fast start and a calm one", fast, calm, EXACT
    )
