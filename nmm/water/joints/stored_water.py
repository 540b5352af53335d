"""The water in joints at a time, and what the water found last was found from."""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from integration.arrays import Floats
from nmm.water.joints.balance import OpenJoints


@dataclass(frozen=True)
class WaterStored:
    """The water at a time.

    Attributes
    ----------
    time
        s.
    head, volume
        (n,) heads of the nodes (m), and volumes of the joints at them (m3).
    taken
        Volume that came in since the start (m3), by the name of the prescribed head.
    stored
        Volume by which the water in the joints has grown since the start (m3).
    """

    time: float
    head: Floats
    volume: Floats
    taken: Mapping[str, float] = field(default_factory=dict)
    stored: float = 0.0


@dataclass(frozen=True)
class SolvedWater:
    """The water found last, and what it was found from."""

    joints: OpenJoints
    began: WaterStored
    water: WaterStored

    def serves(self, joints: OpenJoints, began: WaterStored, volume: Floats, time: float) -> bool:
        """Whether it is the water of such a step: joints that move no further keep theirs."""
        same = self.joints is joints and self.began is began and self.water.time == time
        return same and np.array_equal(self.water.volume, volume)
