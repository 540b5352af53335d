"""Tables of supports, gravity, loading, initial state, monitors and references."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Annotated, Literal

from pydantic import BeforeValidator, Field, field_validator, model_validator

from nmm.errors import shown
from nmm.scene.fields import (
    NAME,
    Acceleration,
    AngularVelocity,
    AnyQuantity,
    BlockName,
    Coordinate,
    ForceDensity,
    Frozen,
    History,
    Length,
    Name,
    Number,
    Point,
    Prose,
    Segment,
    Stress,
    TableName,
    Text,
    Time,
    Velocity,
    fault,
)
from nmm.scene.tables.loading.control import ControlTable
from nmm.scene.tables.loading.expressions import FieldOf

_HISTORY = "pairs [t, factor] with t increasing"


class PlacedTable(Frozen):
    """Base of tables that act at a place: a point, a segment, a block, or a part of a block."""

    name: Name = Field(description=NAME, examples=["left"])
    point: Point | None = Field(default=None, description="a point [x, y] in m", examples=[[0, 0]])
    segment: Segment | None = Field(
        default=None, description="two points [[x, y], [x, y]] in m", examples=[[[0, 0], [1, 0]]]
    )
    block: BlockName | None = Field(
        default=None, description="the name of a block", examples=["base"]
    )
    history: History | None = Field(default=None, description=_HISTORY, examples=[[[0, 0], [1, 1]]])

    @field_validator("history")
    @classmethod
    def _increasing(cls, value: History | None) -> History | None:
        if value is not None and (not value or any(a[0] >= b[0] for a, b in pairwise(value))):
            remedy = "sort the pairs and remove equal times"
            raise fault(value, _HISTORY, remedy)
        return value


class SupportTable(PlacedTable):
    """Displacement components that are prescribed at a place."""

    fix: Annotated[tuple[Literal["x", "y"], ...], Field(min_length=1)] = Field(
        description='a list of "x" and "y"', examples=[["x", "y"]]
    )
    displacement: tuple[Length, Length] = Field(
        default=(0.0, 0.0), description="a displacement [ux, uy] in m", examples=[[0, 0]]
    )
    field: FieldOf | None = Field(
        default=None,
        description="displacements [ux, uy] in m as expressions of x, y, t, or a name of [fields]",
        examples=[["1e-4*x", "-2e-5*y"]],
    )
    motion: dict[Literal["x", "y"], TableName] = Field(
        default={},
        description="names of records that the ground follows along x and y; needs inertia",
        examples=[{"x": "quake"}],
    )

    @model_validator(mode="after")
    def _check(self) -> SupportTable:
        places = given(self, "point", "segment", "block")
        if not places or {"point", "segment"} <= set(places):
            remedy = "give point, segment or block; block may also narrow point or segment"
            raise fault(", ".join(places) or "no place", "one place", remedy)
        for axis, value in zip("xy", self.displacement, strict=True):
            if value != 0 and axis not in self.fix:
                remedy = f'add "{axis}" to fix'
                raise fault(f"displacement in {axis}", f"{axis} in fix", remedy)
        if self.field is not None and any(self.displacement):
            raise fault("displacement and field", "one of the two", "remove one of them")
        for axis in self.motion:
            if axis not in self.fix:
                raise fault(f"motion along {axis}", f"{axis} in fix", f'add "{axis}" to fix')
        return self


def given(item: Frozen, *keys: str) -> list[str]:
    """Return which of the keys of a table are given."""
    return [key for key in keys if getattr(item, key) is not None]


class GravityTable(Frozen):
    """Weight; needs densities."""

    acceleration: tuple[Acceleration, Acceleration] = Field(
        default=(0.0, -9.81), description="an acceleration [ax, ay] in m/s2", examples=[[0, -9.81]]
    )


class InertiaTable(Frozen):
    """Mass; makes the run dynamic, needs densities and a duration."""


class ContactTable(Frozen):
    """Bodies touch; needs an interface."""


def _scaled(value: object) -> object:
    if value == "all" or isinstance(value, list | tuple):
        return value
    raise fault(shown(value), '"all" or a list of loads', 'write for example scaled = ["jack"]')


def _until(value: object) -> object:
    if value == "failure":
        return value
    if isinstance(value, int | float) and not isinstance(value, bool) and 0 < value < math.inf:
        return value
    raise fault(shown(value), '"failure" or a load factor > 0', 'write until = "failure"')


class Loading(Frozen):
    """How the loads of a static run grow."""

    scaled: Annotated[tuple[str, ...] | Literal["all"], BeforeValidator(_scaled)] = Field(
        default="all",
        description='"all" or a list of names of loads and of supports with a displacement',
        examples=["all"],
    )
    until: Annotated[float | Literal["failure"], BeforeValidator(_until)] = Field(
        default=1.0, description='"failure" or a load factor > 0', examples=["failure"]
    )
    maximum_factor: Number | None = Field(
        default=None, gt=0, description="a load factor > 0 at which to stop", examples=[10.0]
    )
    motion_after_failure: Time | None = Field(
        default=None,
        gt=0,
        description="a duration in s: the failed blocks move with inertia, to show the mode",
        examples=["5 ms"],
    )
    control: ControlTable | None = Field(
        default=None, description="a table [loading.control]: what grows in place of the load"
    )

    @model_validator(mode="after")
    def _check(self) -> Loading:
        if self.control is not None and (self.until != "failure" or self.motion_after_failure):
            remedy = 'write until = "failure" without motion_after_failure, or remove control'
            raise fault("control", 'until = "failure"', remedy)
        if self.until != "failure" and self.maximum_factor is not None:
            remedy = 'write until = "failure", or leave maximum_factor out'
            raise fault(f"until = {self.until} and maximum_factor", 'until = "failure"', remedy)
        if self.until != "failure" and self.motion_after_failure is not None:
            remedy = 'write until = "failure", or leave motion_after_failure out'
            raise fault(
                f"until = {self.until} and motion_after_failure", 'until = "failure"', remedy
            )
        return self


class InitialVelocityTable(Frozen):
    """Velocity of blocks at the start.

    A block spins about its own centroid, with all pieces into which cracks part it; pieces of a
    tessellation, or of a block that joints cut, are blocks.
    """

    block: BlockName = Field(description='the name of a block, or "all"', examples=["all"])
    velocity: tuple[Velocity, Velocity] = Field(
        default=(0.0, 0.0), description="a velocity [vx, vy] in m/s", examples=[[3, 4]]
    )
    angular_velocity: AngularVelocity = Field(
        default=0.0, description="an angular velocity in rad/s", examples=[2.0]
    )


class InitialStressTable(Frozen):
    """Stress in blocks at the start: one `stress`, or one that grows with depth.

    Depth is that below `surface`. The vertical stress there is a pressure of `unit_weight` times
    it, and of the `surcharge`; the horizontal one is `ratio` times the vertical one.
    """

    block: BlockName = Field(description='the name of a block, or "all"', examples=["all"])
    stress: tuple[Stress, Stress, Stress] | None = Field(
        default=None, description="stresses [sxx, syy, sxy] in Pa", examples=[[0, "-1 MPa", 0]]
    )
    across: Stress | None = Field(
        default=None,
        description="a stress out of the plane in Pa, of matter that flows; elastic if not given",
        examples=["-1 MPa"],
    )
    surface: Coordinate | None = Field(
        default=None, description="y of the ground's surface in m", examples=["30 m"]
    )
    unit_weight: ForceDensity | None = Field(
        default=None,
        gt=0,
        description="a weight of the ground in N/m3, > 0",
        examples=["25 kN/m^3"],
    )
    surcharge: Stress = Field(
        default=0.0, ge=0, description="a pressure on the surface in Pa, >= 0", examples=["50 kPa"]
    )
    ratio: Number | None = Field(
        default=None, description="of horizontal to vertical stress", examples=[0.5]
    )
    ratio_across: Number | None = Field(
        default=None,
        description="of the stress out of the plane to the vertical one; elastic if not given",
        examples=[0.5],
    )

    @model_validator(mode="after")
    def _one_way(self) -> InitialStressTable:
        needed = ("surface", "unit_weight", "ratio")
        depth = [key for key in (*needed, "ratio_across") if getattr(self, key) is not None]
        depth += ["surcharge"] if self.surcharge else []
        even = given(self, "stress", "across")
        if even and depth:
            remedy = f"remove {' and '.join(depth)}, or stress and across"
            raise fault(f"{even[0]} and {depth[0]}", "one stress, or one by depth", remedy)
        if not depth and self.stress is None:
            raise fault(even[0] if even else "no stress", "stress, or surface", "add stress")
        if depth and (missing := [key for key in needed if key not in depth]):
            said, expected = f"no {' and no '.join(missing)}", ", ".join(needed)
            raise fault(said, f"{expected} together", f"add {' and '.join(missing)}")
        return self


class MonitorTable(Frozen):
    """A point of a block whose displacement is recorded."""

    name: Name = Field(description=NAME, examples=["midspan"])
    point: Point = Field(description="a point [x, y] in m", examples=[[0, 0]])
    block: BlockName | None = Field(
        default=None, description="the name of a block", examples=["beam"]
    )


class ReferenceTable(Frozen):
    """An answer from elsewhere that a result is compared with."""

    quantity: Text = Field(
        description="a number of summary.json or a column of history.csv", examples=["failure_load"]
    )
    value: AnyQuantity = Field(description="a number in SI", examples=[9124.0])
    tolerance: Number = Field(ge=0, description="a relative tolerance, >= 0", examples=[0.02])
    source: Prose = Field(description="where the value comes from", examples=["linear programme"])
