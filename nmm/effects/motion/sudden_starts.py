"""Ground that sets out or stops at once, under bodies of another speed or that stand elsewhere."""

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Floats
from nmm.assembly.places import Place
from nmm.effects.base import Instant, Setup
from nmm.effects.motion.given_ways import jumps_of_way
from nmm.effects.motion.record import GroundMotion

if TYPE_CHECKING:
    from nmm.scene.actions import SupportTable

SMALL = 0.05
"""A jump of speed below this share of the largest of a record is none to speak of."""

NEAR = 1e-3
"""So is one of place, which a single step makes up for, below this share of the largest way."""

FEW = 4
"""A change over fewer steps is a jump to supports: bodies swing by 0.13 of one over three steps."""


def sudden_start(
    setup: Setup, support: "SupportTable", place: Place, ground: Callable[[Instant], Floats]
) -> str:
    """Tell, in words, the jumps of the ground of a support, at first and later; empty without any.

    Records of displacement have a corner at each sample: theirs are those of `jumps_of_way`.

    Parameters
    ----------
    setup
        At the start of the run: its bodies have their initial velocities there.
    support, place
        The support, and its points.
    ground
        Its displacement (2,) or (m, 2) at an instant (m).
    """
    speeds = _initial(setup)[np.unique(place.points.body)].mean(axis=0)
    found = []
    for axis, along in enumerate("xy"):
        if along in support.motion:
            found += _away(setup, support.motion[along], along)
        if along in support.motion and _has_speed(setup, support.motion[along]):
            jumps = _of_record(setup, support.motion[along], speeds[axis])
        else:
            jumps = jumps_of_way(setup, support, ground, axis, speeds[axis])
        found += [_words(time, jump, along) for time, jump in jumps]
    if not found:
        return ""
    return (
        f'the ground of support "{support.name}" {" and ".join(found)}: `newmark` throws bodies to '
        "and fro by that for good, and what slides on them rubs on; `shi` and `generalized_alpha` "
        "lose as much energy as they give them; let the ground begin at rest where they stand, and "
        "change over some steps, or give them its first speed by [[initial_velocities]]"
    )


def _words(time: float, jump: float, along: str) -> str:
    if time == 0:
        return f"sets out at once with {jump:.3g} m/s along {along} beside them"
    return f"jumps by {jump:.3g} m/s along {along} at {time:.3g} s"


def _has_speed(setup: Setup, record: str) -> bool:
    return setup.scene.records[record].quantity != "displacement"


def _away(setup: Setup, record: str, along: str) -> list[str]:
    """Tell a record that does not begin where its bodies stand."""
    motion = GroundMotion.of(setup.scene.records[record])
    way = motion.displacement_at(0.0)
    away = abs(way) > NEAR * np.abs(motion.displacement).max()
    return [f"is {way:.3g} m away along {along} at time zero"] if away else []


def _of_record(setup: Setup, record: str, speed: float) -> list[tuple[float, float]]:
    """Return the times (s) and jumps of the speed of a record within the run (m/s).

    ``speed`` (m/s) is the mean one of its bodies at the start.
    """
    motion = GroundMotion.of(setup.scene.records[record])
    late = motion.times[0] > 0  # until then it holds them at rest
    first = motion.velocity[0] if late else motion.velocity_at(0.0) - speed
    small = SMALL * np.abs(motion.velocity).max()
    found = [(0.0, float(first))] if abs(first) > small else []
    step, duration = setup.formulation.integrator.step, setup.scene.duration
    longest = np.inf if step == "auto" else FEW * step
    change, start = np.diff(motion.velocity), motion.times[:-1]
    within = (start >= 0) & (start < (np.inf if duration is None else duration))
    told = motion.jumps & (np.abs(change) > small) & within & (np.diff(motion.times) < longest)
    return found + [(float(start[i]), float(change[i])) for i in np.flatnonzero(told)]


def _initial(setup: Setup) -> Floats:
    """Initial velocities (B, 3) of bodies: of their centroids, and of rotation (m/s, rad/s)."""
    if not setup.scene.initial_velocities:
        return np.zeros((setup.model.manifold.n_bodies, 3))
    from nmm.effects.initial.initial_velocity import InitialVelocity

    return InitialVelocity.from_setup(setup).motion
