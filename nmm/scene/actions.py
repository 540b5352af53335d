"""Tables of what acts on blocks at a place, supports, gravity, inertia and contact."""

from __future__ import annotations

from itertools import pairwise
from typing import Annotated, Literal

from pydantic import Field, field_validator, model_validator

from nmm.scene.fields import (
    NAME,
    Acceleration,
    BlockName,
    Frozen,
    History,
    Length,
    Name,
    Point,
    Segment,
    TableName,
    fault,
)
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
