"""Tables of members: springs, dashpots, bars, foundations, masses."""

from __future__ import annotations

import math
from typing import Annotated, Literal

from pydantic import BeforeValidator, Field, model_validator

from nmm.scene.fields import (
    NAME,
    BlockName,
    Force,
    Frozen,
    Length,
    Name,
    Number,
    PartName,
    Point,
    Segment,
    SpringStiffness,
    Stress,
    example,
    fault,
    quantity,
)

Stiffness = Annotated[float, quantity("N/m")]
Viscosity = Annotated[float, quantity("N s/m")]
Mass = Annotated[float, quantity("kg")]
Area = Annotated[float, quantity("m^2")]

MEMBERS = ("springs", "dashpots", "bars", "foundations", "masses")
"""Keys of a scene whose tables stages may name as ``members``; names are unique among them."""

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


class BondTable(Frozen):
    """The bond between a bar and what it lies in: shear stress on its surface over slip."""

    law: PartName = Field(
        default="linear",
        description='"linear", "plastic", "bilinear", "model_code", or "module:Name" of your own',
        examples=["bilinear"],
    )
    stiffness: SpringStiffness | None = Field(
        default=None,
        gt=0,
        description="shear stress over slip in Pa/m, > 0, of linear and plastic",
        examples=["10 GPa/m"],
    )
    strength: Stress | None = Field(
        default=None, gt=0, description="a largest shear stress in Pa, > 0", examples=["8 MPa"]
    )
    slips: tuple[Length, ...] = Field(
        default=(),
        description="slips in m at which the curve changes: two of bilinear, three of model_code",
        examples=[["0.1 mm", "1 mm"]],
    )
    residual_strength: Stress = Field(
        default=0.0, ge=0, description="a shear stress in Pa that is left, >= 0"
    )
    exponent: Number | None = Field(
        default=None, gt=0, le=1, description="of model_code, in (0, 1]", examples=[0.4]
    )


class DowelTable(Frozen):
    """The resistance of a bar to a way across it, at joints that it crosses."""

    bedding_stiffness: Stress = Field(
        gt=0,
        description="force over length of the bar over its deflection in Pa, > 0, of what it is "
        "bedded in",
        examples=["50 MPa"],
    )
    bending_stiffness: Number | None = Field(
        default=None,
        gt=0,
        description="E I of a bar in N m2, > 0; that of a round bar of the diameter if not given",
        examples=[3800.0],
    )
    yield_force: Force | None = Field(
        default=None,
        gt=0,
        description="a shear force in N that a bar yields at, > 0",
        examples=["60 kN"],
    )


def _ends(value: object) -> object:
    """Return two ends, which may be given as one word."""
    return (value, value) if isinstance(value, str) else value


End = Literal["free", "fixed", "ground"]


class BarTable(TwoEndedTable):
    """A straight bar: a rock bolt, a cable, an anchor, reinforcement of concrete.

    With a bond it is held all along what it lies in, and crosses joints; without one it is held at
    its ends alone. It has no bending stiffness and no mass.
    """

    diameter: Length | None = Field(
        default=None, gt=0, description="a diameter in m, > 0", examples=["25 mm"]
    )
    area: Area | None = Field(
        default=None, gt=0, description="a cross section in m2, > 0", examples=["490 mm^2"]
    )
    perimeter: Length | None = Field(
        default=None, gt=0, description="of the bond in m, > 0; that of the diameter if not given"
    )
    number: Number = Field(
        default=1.0, gt=0, description="bars in the thickness of the scene, > 0", examples=[0.5]
    )
    young_modulus: Stress = Field(gt=0, description="in Pa, > 0", examples=["200 GPa"])
    yield_stress: Stress | None = Field(
        default=None, gt=0, description="in Pa, > 0; elastic if not given", examples=["500 MPa"]
    )
    hardening_modulus: Stress = Field(
        default=0.0, ge=0, description="stress over plastic strain in Pa, >= 0", examples=["1 GPa"]
    )
    carries: Literal["both", "tension"] = Field(
        default="both", description='"both", or "tension" of a cable', examples=["tension"]
    )
    pretension: Force = Field(
        default=0.0, ge=0, description="a force in each bar as drawn in N, >= 0", examples=["20 kN"]
    )
    ends: Annotated[tuple[End, End], BeforeValidator(_ends)] | None = Field(
        default=None,
        description='"free", "fixed" (a plate or an anchor at the block) or "ground", of both ends '
        "or of each; fixed without a bond, free with one",
        examples=[["fixed", "free"]],
    )
    bond: BondTable | None = Field(default=None, description="a table [bars.bond]")
    dowel: DowelTable | None = Field(
        default=None,
        description="a table [bars.dowel]: that joints which slide across the bar are resisted",
    )

    @model_validator(mode="after")
    def _sound(self) -> BarTable:
        if (self.diameter is None) == (self.area is None):
            given = "both" if self.diameter else "neither"
            raise fault(given, "diameter or area", "give one of them")
        if self.bond is not None and self.diameter is None and self.perimeter is None:
            raise fault("area and bond, no perimeter", "a perimeter", "add perimeter or diameter")
        stiff = self.dowel is None or self.dowel.bending_stiffness is not None
        if self.diameter is None and not stiff:
            raise fault("area and dowel", "a bending_stiffness", "add it to [bars.dowel]")
        if self.bond is None and "free" in self.held:
            raise fault("a free end, no bond", "a bar that is held", "add a bond, or fix the end")
        if self.yield_stress is None and self.hardening_modulus:
            remedy = "add yield_stress, or leave hardening_modulus out"
            raise fault("hardening_modulus, no yield_stress", "a stress that it begins at", remedy)
        if self.yield_stress is not None and self.pretension > self.yield_stress * self.section:
            expected = (
                f"at most the force that it yields at, {self.yield_stress * self.section:.6g} N"
            )
            raise fault(f"pretension = {self.pretension:.6g} N", expected, "lower it")
        return self

    @property
    def section(self) -> float:
        """Cross section: the area, or that of a round bar of the diameter (m2)."""
        return self.area or math.pi * (self.diameter or 0.0) ** 2 / 4

    @property
    def thickness(self) -> float:
        """The diameter, or that of a round bar of the area (m)."""
        return self.diameter or float((4 * (self.area or 0.0) / math.pi) ** 0.5)

    @property
    def bending_stiffness(self) -> float:
        """``E I`` of one bar (N m2), with ``I = pi d^4 / 64`` of a round bar by default."""
        given = None if self.dowel is None else self.dowel.bending_stiffness
        return given or self.young_modulus * math.pi * self.thickness**4 / 64

    @property
    def held(self) -> tuple[End, End]:
        """Anchorage of the two ends."""
        if self.ends is not None:
            return self.ends
        return ("fixed", "fixed") if self.bond is None else ("free", "free")
