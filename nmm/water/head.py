"""Given water pressures: hydrostatic below a water table, linear along a segment, or uniform."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Floats

if TYPE_CHECKING:
    from nmm.scene.tables.water import WaterPressureTable


@dataclass(frozen=True)
class WaterTable:
    """Hydrostatic pressure below a water table, none above.

    Attributes
    ----------
    line
        (k, 2) points of the table with increasing x (m); it is level beyond its ends.
    weight
        Unit weight of water (N/m3).
    """

    line: Floats
    weight: float

    def pressure(self, points: Floats) -> Floats:
        """Pressure (m,) at points (m, 2), Pa."""
        return np.asarray(self.weight * np.maximum(self.depth(points), 0.0))

    def depth(self, points: Floats) -> Floats:
        """How deep points (m, 2) lie below the table (m); negative above it."""
        return np.asarray(np.interp(points[:, 0], *self.line.T) - points[:, 1])

    def crossings(self, start: Floats, end: Floats) -> Floats:
        """Shares of the way from start to end (2,) at which the pressure has a kink."""
        way = end - start
        kinks = [0.0, 1.0]
        if way[0]:
            kinks += ((self.line[:, 0] - start[0]) / way[0]).tolist()
        shares = np.unique(np.clip(kinks, 0.0, 1.0))
        depth = self.depth(start + shares[:, None] * way)
        low, high = depth[:-1], depth[1:]
        through = low * high < 0
        met = shares[:-1] + (low / np.where(through, low - high, 1.0)) * np.diff(shares)
        return np.union1d(shares, met[through])


@dataclass(frozen=True)
class LinearPressure:
    """A pressure (2,) in Pa at the ends of a segment (2, 2), linear along it."""

    segment: Floats
    pressures: Floats

    def pressure(self, points: Floats) -> Floats:
        """Pressure (m,) at points (m, 2), Pa."""
        way = self.segment[1] - self.segment[0]
        share = (points - self.segment[0]) @ way / (way @ way)
        return np.asarray(self.pressures[0] + share * (self.pressures[1] - self.pressures[0]))

    def crossings(self, start: Floats, end: Floats) -> Floats:
        """Return the ends: it has no kink."""
        return np.array([0.0, 1.0])


@dataclass(frozen=True)
class EvenPressure:
    """One pressure everywhere (Pa)."""

    value: float

    def pressure(self, points: Floats) -> Floats:
        """Pressure (m,) at points (m, 2), Pa."""
        return np.full(len(points), self.value)

    def crossings(self, start: Floats, end: Floats) -> Floats:
        """Return the ends: it has no kink."""
        return np.array([0.0, 1.0])


Pressure = WaterTable | LinearPressure | EvenPressure


def pressure_of(item: "WaterPressureTable", origin: Floats) -> Pressure:
    """Return the pressure that a table says, in the axes of the model.

    Points are in these axes already, levels are those of the scene.
    """
    if item.pressure is not None:
        return EvenPressure(item.pressure)
    if item.pressures is not None:
        return LinearPressure(np.array(item.segment), np.array(item.pressures))
    if item.level is not None:
        return WaterTable(np.array([[0.0, item.level - origin[1]]]), item.unit_weight)
    return WaterTable(np.array(item.phreatic_line), item.unit_weight)
