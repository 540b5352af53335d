"""Ground that sets out at once, under bodies that have another speed or stand elsewhere."""

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


def sudden_start(setup: Setup, support: "SupportTable", place: Place) -> str:
    """Tell, in words, the jumps with which the records of a support begin; empty without any.

    Records of displacement have a corner at each sample: their speed does not count.

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
    if not found:
        return ""
    return (
        f'the ground of support "{support.name}" {" and ".join(found)}: `newmark` throws bodies to '
        "and fro by that for good, `shi` and `generalized_alpha` lose as much energy as they give "
        "them; let the record begin at rest where they stand, and rise over some steps, or give "
        "them its speed by [[initial_velocities]]"
    )


def _jump_of_speed(setup: Setup, motion: "GroundMotion", axis: int, place: Place) -> float:
    """Return the speed of the ground as it sets out, less the mean one of its bodies (m/s)."""
    if motion.times[0] > 0:
        return float(motion.velocity[0])  # until then it holds them at rest
    speeds = _initial(setup)[np.unique(place.points.body), axis]
    return float(motion.velocity_at(0.0) - speeds.mean())


def _initial(setup: Setup) -> Floats:
    """Initial velocities (B, 3) of bodies: of their centroids, and of rotation (m/s, rad/s)."""
    if not setup.scene.initial_velocities:
        return np.zeros((setup.model.manifold.n_bodies, 3))
    from nmm.effects.initial.initial_velocity import InitialVelocity

    return InitialVelocity.from_setup(setup).motion
