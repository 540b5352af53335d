"""Ground motion of a record: integrated exactly, linear between its samples."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Literal, Self

import numpy as np

from integration.arrays import Bools, Floats

if TYPE_CHECKING:
    from nmm.scene.model import Scene
    from nmm.scene.tables.shaking.records import RecordTable

Axis = Literal["x", "y"]

JUMP = 100
"""Two samples are a jump if their neighbours are more than so many times as far away in time."""


@dataclass(frozen=True)
class GroundMotion:
    """Acceleration, velocity and displacement at any time, from the samples of one of them.

    Attributes
    ----------
    times
        (k,) times of the samples, increasing (s).
    acceleration
        (k, 2) limits from the right and from the left at the samples, linear between (m/s2).
    velocity, displacement
        (k,) at the samples (m/s, m).
    """

    times: Floats
    acceleration: Floats
    velocity: Floats
    displacement: Floats

    @classmethod
    def of(cls, table: "RecordTable") -> Self:
        """Return the motion of a record of the scene, with baseline correction."""
        times, values = (np.array(column) for column in table.times_and_values)
        if table.quantity == "acceleration":
            return cls.from_acceleration(times, corrected(times, values, table.baseline))
        steps = np.diff(times)
        slope = np.append(np.diff(values) / steps, 0.0)
        if table.quantity == "velocity":
            way = np.cumsum(np.append(0.0, steps * (values[1:] + values[:-1]) / 2))
            # A jump of the velocity at the first sample has its counterpart at the last.
            both = np.stack([slope, np.append(slope[:1], slope[:-1])], axis=1)
            return cls(times, both, values, way)
        none = np.zeros((len(times), 2))
        return cls(times, none, slope, values)

    @classmethod
    def from_acceleration(cls, times: Floats, values: Floats) -> Self:
        """Integrate accelerations (k,) (m/s2), linear between ``times`` (k,) (s), from rest."""
        steps = np.diff(times)
        velocity = np.cumsum(np.append(0.0, steps * (values[1:] + values[:-1]) / 2))
        more = velocity[:-1] * steps + steps**2 * (2 * values[:-1] + values[1:]) / 6
        way = np.cumsum(np.append(0.0, more))
        return cls(times, np.stack([values, values], axis=1), velocity, way)

    @cached_property
    def shortest_step(self) -> float:
        """Shortest interval between two samples (s), those of a jump excepted."""
        steps = np.diff(self.times)
        return float(steps.min() if len(steps) < 2 else steps[~self.jumps].min())

    @property
    def jumps(self) -> Bools:
        """Which intervals (k - 1,) between samples are jumps.

        The samples of a jump are `JUMP` times as near to each other as to their neighbours.
        """
        steps = np.diff(self.times)
        beside = np.pad(steps, 1, constant_values=np.inf)
        return np.asarray(JUMP * steps < np.minimum(beside[:-2], beside[2:]))

    def displacement_at(self, time: float) -> float:
        """Return the displacement at a time (m)."""
        number, after, slope = self._piece(time)
        if number < 0:
            return float(self.displacement[0])
        start = self.acceleration[number, 0] * (number < len(self.times) - 1)
        return float(
            self.displacement[number]
            + after * (self.velocity[number] + after * (start / 2 + after * slope / 6))
        )

    def velocity_at(self, time: float) -> float:
        """Return the velocity at a time (m/s)."""
        number, after, slope = self._piece(time)
        if number < 0:
            return 0.0
        start = self.acceleration[number, 0] * (number < len(self.times) - 1)
        return float(self.velocity[number] + after * (start + after * slope / 2))

    def _piece(self, time: float) -> tuple[int, float, float]:
        """Number of the last sample, time since (s), and slope of the acceleration (m/s3)."""
        number = int(np.searchsorted(self.times, time, side="right")) - 1
        if number < 0:
            return -1, 0.0, 0.0
        after = float(time - self.times[number])
        if number == len(self.times) - 1:
            return number, after, 0.0
        ends = self.acceleration[number + 1, 1] - self.acceleration[number, 0]
        return number, after, float(ends / (self.times[number + 1] - self.times[number]))


def motions_of(scene: "Scene", named: Mapping[Axis, str]) -> dict[int, GroundMotion]:
    """Return the motions along x (0) and y (1) of named records of a scene."""
    return {"xy".index(axis): GroundMotion.of(scene.records[name]) for axis, name in named.items()}


def velocity_of(motions: Mapping[int, GroundMotion], time: float) -> Floats:
    """Velocity (2,) of motions along x (0) and y (1); zero along an axis without one (m/s)."""
    found = np.zeros(2)
    for axis, motion in motions.items():
        found[axis] = motion.velocity_at(time)
    return found


def corrected(times: Floats, values: Floats, baseline: str) -> Floats:
    """Return accelerations (k,) after baseline correction, so that the motion ends at rest.

    A constant or linear part ``c0 + c1 (t - t0)`` is subtracted, which takes ``c0 T + c1 T^2 / 2``
    off the final velocity and ``c0 T^2 / 2 + c1 T^3 / 6`` off the final displacement.
    """
    if baseline == "none":
        return values
    whole = GroundMotion.from_acceleration(times, values)
    speed, way, since = whole.velocity[-1], whole.displacement[-1], times - times[0]
    span = since[-1]
    if baseline == "velocity":
        return np.asarray(values - speed / span)
    matrix = [[span, span**2 / 2], [span**2 / 2, span**3 / 6]]
    first, slope = np.linalg.solve(matrix, [speed, way])
    return np.asarray(values - first - slope * since)
