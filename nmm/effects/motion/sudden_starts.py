"""Ground that sets out or stops at once, under bodies of another speed or that stand elsewhere."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Floats
from nmm.assembly.places import Place
from nmm.effects.base import Setup

if TYPE_CHECKING:
    from nmm.effects.motion.record import GroundMotion
    from nmm.scene.actions import SupportTable

SMALL = 0.05
"""A jump of speed below this share of the largest of a record is none to speak of."""

NEAR = 1e-3
"""So is one of place, which a single step makes up for, below this share of the largest way."""

FEW = 4
"""A change over fewer steps is a jump to supports: bodies swing by 0.13 of one over three steps."""


def sudden_start(setup: Setup, support: "SupportTable", place: Place) -> str:
    """Tell, in words, the jumps of the records of a support, at first and later; empty without any.

    Records of displacement have a corner at each sample: their speed does not count, but jumps of
    place do.

    Parameters
    ----------
    setup
        At the start of the run: its bodies have their initial velocities there.
    support, place
        The support, and its points.
    """
    from nmm.effects.motion.record import GroundMotion

    found = []
    for along, name in support.motion.items():
        motion, axis = GroundMotion.of(setup.scene.records[name]), "xy".index(along)
        way = motion.displacement_at(0.0)
        if abs(way) > NEAR * np.abs(motion.displacement).max():
            found.append(f"is {way:.3g} m away along {along} at time zero")
        speed = _jump_of_speed(setup, motion, axis, place)
        kept = setup.scene.records[name].quantity != "displacement"
        if kept and abs(speed) > SMALL * np.abs(motion.velocity).max():
            found.append(f"sets out at once with {speed:.3g} m/s along {along} beside them")
        values, unit = (motion.velocity, "m/s") if kept else (motion.displacement, "m")
        for time, jump in _later(setup, motion, values):
            found.append(f"jumps by {jump:.3g} {unit} along {along} at {time:.3g} s")
    if not found:
        return ""
    return (
        f'the ground of support "{support.name}" {" and ".join(found)}: `newmark` throws bodies to '
        "and fro by that for good, and what slides on them rubs on; `shi` and `generalized_alpha` "
        "lose as much energy as they give them; let the record begin at rest where they stand, and "
        "change over some steps, or give them its first speed by [[initial_velocities]]"
    )


def _jump_of_speed(setup: Setup, motion: "GroundMotion", axis: int, place: Place) -> float:
    """Return the speed of the ground as it sets out, less the mean one of its bodies (m/s)."""
    if motion.times[0] > 0:
        return float(motion.velocity[0])  # until then it holds them at rest
    speeds = _initial(setup)[np.unique(place.points.body), axis]
    return float(motion.velocity_at(0.0) - speeds.mean())


def _later(setup: Setup, motion: "GroundMotion", values: Floats) -> Iterator[tuple[float, float]]:
    """Yield the times of jumps of values (k,) at the samples within the run (s), and the jumps."""
    step, duration = setup.formulation.integrator.step, setup.scene.duration
    longest = np.inf if step == "auto" else FEW * step
    steps, change = np.diff(motion.times), np.diff(values)
    large = np.abs(change) > SMALL * np.abs(values).max()
    start, end = motion.times[:-1], np.inf if duration is None else duration
    within = (start >= 0) & (start < end) & (steps < longest)
    for number in np.flatnonzero(motion.jumps & large & within):
        yield float(start[number]), float(change[number])


def _initial(setup: Setup) -> Floats:
    """Initial velocities (B, 3) of bodies: of their centroids, and of rotation (m/s, rad/s)."""
    if not setup.scene.initial_velocities:
        return np.zeros((setup.model.manifold.n_bodies, 3))
    from nmm.effects.initial.initial_velocity import InitialVelocity

    return InitialVelocity.from_setup(setup).motion
