"""Tables of given water pressures on edges, in joints and in cracks."""

from __future__ import annotations

from itertools import pairwise

from pydantic import Field, field_validator, model_validator

from nmm.scene.actions import PlacedTable
from nmm.scene.fields import (
    Coordinate,
    ForceDensity,
    Line,
    Name,
    Stress,
    fault,
)

WATER = 9810.0
"""Unit weight of fresh water (N/m3)."""


class WaterPressureTable(PlacedTable):
    """Water that presses on edges, at right angles to them as the blocks turn.

    It acts on all edges of blocks along a segment, on both faces of a joint there, on one alone
    where a block is named; on both faces of a crack; or all around a block. Its pressure hangs from
    a level or a phreatic line, zero above it, is linear along the segment, or is one pressure
    everywhere, as of what is pumped into a crack.
    """

    crack: Name | None = Field(default=None, description="the name of a crack", examples=["notch"])
    level: Coordinate | None = Field(
        default=None, description="a water level, y in m", examples=["28 m"]
    )
    phreatic_line: Line | None = Field(
        default=None,
        description="two or more points [x, y] in m of the water table, x increasing",
        examples=[[[0, 10], [20, 4]]],
    )
    pressure: Stress | None = Field(
        default=None, description="one pressure in Pa everywhere", examples=["2 MPa"]
    )
    pressures: tuple[Stress, Stress] | None = Field(
        default=None,
        description="pressures in Pa at the two ends of the segment, linear between",
        examples=[["280 kPa", 0]],
    )
    unit_weight: ForceDensity = Field(
        default=WATER, gt=0, description="a weight of water in N/m3, > 0", examples=["9.81 kN/m^3"]
    )

    @field_validator("phreatic_line")
    @classmethod
    def _rightwards(cls, value: Line | None) -> Line | None:
        if value is not None and any(a[0] >= b[0] for a, b in pairwise(value)):
            raise fault(value, "points with x increasing", "sort them by x")
        return value

    @model_validator(mode="after")
    def _check(self) -> WaterPressureTable:
        given = [key for key in SOURCES if getattr(self, key) is not None]
        if len(given) != 1:
            found, wanted = ", ".join(given) or "no pressure", "one of " + ", ".join(SOURCES)
            raise fault(found, wanted, "give one of them")
        if self.point is not None:
            raise fault("a point", "a segment, a crack or a block", "give a segment")
        places = [key for key in ("segment", "crack") if getattr(self, key) is not None]
        if len(places) > 1 or not (places or self.block is not None):
            found = ", ".join(places) or "no place"
            raise fault(found, "a segment, a crack or a block", "give one place")
        if self.pressures is not None and self.segment is None:
            raise fault("pressures without segment", "the segment they are of", "give segment")
        return self


SOURCES = ("level", "phreatic_line", "pressure", "pressures")
