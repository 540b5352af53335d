"""Tables of absorbing boundaries: viscous boundaries and free fields."""

from __future__ import annotations

from typing import Literal

from pydantic import Field, model_validator

from nmm.scene.fields import (
    NAME,
    BlockName,
    Density,
    Flag,
    Frozen,
    Name,
    Segment,
    TableName,
    Velocity,
    fault,
)


class ViscousBoundaryTable(Frozen):
    """Dashpots of the ground beyond an edge, which take waves that meet it straight on.

    They push against the velocity with density times the speed of pressure waves along the normal,
    and of shear waves along the edge (Lysmer and Kuhlemeyer 1969): those of the material at the
    edge, or of other ground that is given. A wave from there is `incoming`, a record of the
    velocity that it would have where nothing reflects it.
    """

    name: Name = Field(description=NAME, examples=["base"])
    segment: Segment | None = Field(
        default=None, description="two points [[x, y], [x, y]] in m", examples=[[[0, 0], [1, 0]]]
    )
    block: BlockName | None = Field(
        default=None, description="the name of a block", examples=["ground"]
    )
    incoming: dict[Literal["x", "y"], TableName] = Field(
        default={},
        description="names of records of the incoming wave along x and y",
        examples=[{"x": "quake"}],
    )
    reactions: Flag = Field(
        default=False,
        description="true or false: whether what supports along it exert stays on it as a load "
        "when a stage takes them away, so that weight does not make it drift",
        examples=[True],
    )
    density: Density | None = Field(
        default=None,
        gt=0,
        description="a density of the ground beyond in kg/m3, > 0",
        examples=["2400 kg/m^3"],
    )
    p_velocity: Velocity | None = Field(
        default=None,
        gt=0,
        description="the speed of pressure waves there in m/s, > 0",
        examples=["2100 m/s"],
    )
    s_velocity: Velocity | None = Field(
        default=None,
        gt=0,
        description="the speed of shear waves there in m/s, > 0",
        examples=["1200 m/s"],
    )

    @model_validator(mode="after")
    def _check(self) -> ViscousBoundaryTable:
        if self.segment is None and self.block is None:
            raise fault("no place", "a segment or a block", "give a segment of the boundary")
        ground = (self.density, self.p_velocity, self.s_velocity)
        if any(one is None for one in ground) and any(one is not None for one in ground):
            expected = "density, p_velocity and s_velocity, or none of them"
            raise fault("a part of the ground beyond", expected, "add what is missing")
        if self.density is not None and self.p_velocity is not None:
            assert self.s_velocity is not None
            if self.p_velocity <= self.s_velocity:
                expected = "p_velocity above s_velocity"
                raise fault(f"{self.p_velocity:g} m/s", expected, "correct the speeds")
        return self


class FreeFieldTable(Frozen):
    """Ground beside a vertical edge that moves as if the edge were not there.

    A column of the materials at the edge is shaken from below as the model is, by the boundary or
    the support that `base` names. Its motion and stress drive the edge through dashpots, so that
    waves going up pass along it undisturbed and waves from within leave.
    """

    name: Name = Field(description=NAME, examples=["left"])
    segment: Segment = Field(
        description="two points [[x, y], [x, y]] in m, one above the other",
        examples=[[[0, 0], [0, 30]]],
    )
    base: Name = Field(
        description="the name of a viscous boundary or of a support with a motion",
        examples=["base"],
    )
    block: BlockName | None = Field(
        default=None, description="the name of a block", examples=["ground"]
    )

    @model_validator(mode="after")
    def _check(self) -> FreeFieldTable:
        (x, low), (other, high) = self.segment
        if abs(x - other) > 1e-9 * abs(high - low):
            raise fault(self.segment, "a vertical segment", "give points of one x")
        return self
