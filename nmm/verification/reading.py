"""What benchmarks read off runs."""

from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Floats
from nmm.assembly.moving.momenta import whole_momentum
from nmm.assembly.moving.motion import rigid_rates

if TYPE_CHECKING:
    from nmm.stepping.run import Run


def way(run: "Run", monitor: str) -> Floats:
    """Displacement (steps, 2) of a monitor (m)."""
    columns = [run.history[f"monitor:{monitor}:u{axis}"] for axis in "xy"]
    return np.stack(columns, axis=1)


def last_way(run: "Run", monitor: str) -> Floats:
    """Displacement (2,) of a monitor at the end (m)."""
    return np.asarray(way(run, monitor)[-1])


def rates(run: "Run") -> Floats:
    """Velocity of the centroid and rate of rotation (B, 3) of the bodies at the end, in space."""
    return rigid_rates(run.stepper.model, run.state)


def momentum(run: "Run") -> Floats:
    """Momentum x, y (N s) and angular momentum about the origin (N m s) of all bodies (3,)."""
    stepper = run.stepper
    return whole_momentum(stepper.model, run.state, np.zeros(2), stepper.kinematics.finite)


def energy_gain(run: "Run") -> float:
    """Largest energy, with the losses of friction and less the work of loads, over the start's (J).

    Nothing but an error can make it positive.
    """
    h = run.history
    stored = h["strain_energy"] + h["contact_energy"] + h["support_energy"] + h["kinetic_energy"]
    return float((stored + h["friction_loss"] - h["external_work"]).max())


def masses(run: "Run") -> Floats:
    """Mass (B,) of the bodies (kg), one element each."""
    model = run.stepper.model
    return np.asarray(model.manifold.elements.areas * model.density * model.thickness)


def joint_force(run: "Run", point: Floats, normal: Floats) -> Floats:
    """Resultant normal and shear force (2,) of the contacts on a line, at the end (N).

    The line goes through ``point`` with the unit ``normal``; contacts count that lie on it within
    1e-3 of the domain and face along it. Tension and anticlockwise shear are positive.
    """
    frame = run.frames[-1]
    near = np.abs((frame.contact_position - point) @ normal) < 1e-3 * run.stepper.size
    along = np.abs(frame.contact_normal @ normal) > 0.99
    return np.asarray(frame.contact_force[near & along].sum(axis=0))


def current_areas(run: "Run") -> Floats:
    """Area (E,) of the elements at the end (m2)."""
    return run.manifold.elements.with_points(run.stepper.place(run.state)).areas


def mean_stress(run: "Run") -> Floats:
    """Stress (3,) at the end, averaged over all elements (Pa)."""
    return np.asarray(np.average(run.stress, axis=0, weights=run.manifold.elements.areas))


def converged(run: "Run") -> bool:
    """Whether the run came to its end."""
    return run.summary.status == "converged"
