"""Tables of members: what all have, springs, dashpots, foundations, masses."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, model_validator

from nmm.scene.fields import (
    NAME,
    BlockName,
    Force,
    Frozen,
    Name,
    Point,
    Segment,
    SpringStiffness,
    example,
    fault,
    quantity,
)

Stiffness = Annotated[float, quantity("N/m")]
Viscosity = Annotated[float, quantity("N s/m")]
Mass = Annotated[float, quantity("kg")]

MEMBERS = ("springs", "dashpots", "bars", "foundations", "masses")
"""Keys of a scene whose tables stages may name as ``members``; names are unique among them."""

DOWEL = " dowel"
"""What the names of bars end in where their dowels are meant."""

GROUND = "ground"
"""Name of the ground where blocks are named."""

_BLOCKS = (
    'names of the blocks that the ends are on, or "ground"; without it the blocks that lie there'
)


class TwoEndedTable(Frozen):
    """Base of tables of members between two points."""

    name: Name = Field(description=NAME, examples=["anchor"])
    points: Segment = Field(
        description="two points [[x, y], [x, y]] in m", examples=[[[0, 0], [0, 3]]]
    )
    blocks: tuple[BlockName, BlockName] | None = Field(
        default=None, description=_BLOCKS, examples=[["roof", "ground"]]
    )

    @model_validator(mode="after")
    def _apart(self) -> TwoEndedTable:
        first, second = self.points
        if first == second:
            raise fault(f"{list(first)} twice", "two points apart", "move one of them")
        if self.blocks == (GROUND, GROUND):
            raise fault("ground twice", "one end on a block at least", "name a block")
        return self


class SpringTable(TwoEndedTable):
    """A spring that pulls its two ends together as it is stretched, and turns with them."""

    stiffness: Stiffness = Field(
        gt=0, description="force over elongation in N/m, > 0", examples=example("N/m")
    )
    force: Force = Field(
        default=0.0, description="a force as drawn in N, tension positive", examples=["20 kN"]
    )
    carries: Literal["both", "tension", "compression"] = Field(
        default="both", description='"both", "tension" or "compression"', examples=["tension"]
    )
    yield_force: Force | None = Field(
        default=None,
        gt=0,
        description="a force in N that it yields at, > 0",
        examples=["1 MN"],
    )


class DashpotTable(TwoEndedTable):
    """A damper: its force is a constant times the rate at which it grows longer."""

    viscosity: Viscosity = Field(
        gt=0, description="force over velocity in N s/m, > 0", examples=example("N s/m")
    )


class MassTable(Frozen):
    """A mass at a point of a block, with its weight and inertia."""

    name: Name = Field(description=NAME, examples=["machine"])
    point: Point = Field(description="a point [x, y] in m", examples=[[0, 0]])
    block: BlockName | None = Field(
        default=None, description="the name of a block", examples=["base"]
    )
    mass: Mass = Field(gt=0, description="a mass in kg, > 0", examples=example("kg"))


class FoundationTable(Frozen):
    """Springs spread along an edge, between a block and the ground."""

    name: Name = Field(description=NAME, examples=["subsoil"])
    segment: Segment = Field(
        description="two points [[x, y], [x, y]] in m", examples=[[[0, 0], [4, 0]]]
    )
    block: BlockName | None = Field(
        default=None, description="the name of a block", examples=["raft"]
    )
    normal_stiffness: SpringStiffness = Field(
        gt=0, description="pressure over settlement in Pa/m, > 0", examples=["20 MPa/m"]
    )
    shear_stiffness: SpringStiffness = Field(
        default=0.0, ge=0, description="shear stress over displacement in Pa/m, >= 0"
    )
    carries: Literal["both", "compression"] = Field(
        default="both",
        description='"both" or "compression": whether it holds a block that lifts off',
        examples=["compression"],
    )
