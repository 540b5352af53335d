"""Tables of bars: the bar, its bond, and its resistance across joints."""

from __future__ import annotations

import math
from typing import Annotated, Literal

from pydantic import BeforeValidator, Field, model_validator

from nmm.scene.fields import (
    Force,
    Frozen,
    Length,
    Number,
    PartName,
    SpringStiffness,
    Stress,
    fault,
    quantity,
)
from nmm.scene.tables.members import TwoEndedTable

Area = Annotated[float, quantity("m^2")]
BendingStiffness = Annotated[float, quantity("N m^2")]


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
    bending_stiffness: BendingStiffness | None = Field(
        default=None,
        gt=0,
        description="E I of a bar in N m2, > 0; that of a round bar of the diameter if not given",
        examples=["3.8 kN m^2"],
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

    With a bond it is tied to what it lies in all along, and crosses joints; without one it is
    anchored at its ends alone. It has no bending stiffness and no mass.
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
        if self.bond is None and "free" in self.anchorage:
            raise fault(
                "a free end, no bond", "a bar that is anchored", "add a bond, or fix the end"
            )
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
    def anchorage(self) -> tuple[End, End]:
        """Anchorage of the two ends."""
        if self.ends is not None:
            return self.ends
        return ("fixed", "fixed") if self.bond is None else ("free", "free")
