"""The table ``[fracture]``: criterion, toughness, length of segments, control."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, model_validator

from nmm.scene.fields import (
    SMALLEST,
    Angle,
    Flag,
    Frozen,
    Length,
    Number,
    PartName,
    SurfaceEnergy,
    fault,
    quantity,
)
from nmm.scene.tables.fracture.nucleation import NucleationTable

Intensity = Annotated[float, quantity("Pa m^0.5", SMALLEST)]


class FractureTable(Frozen):
    """Cracks grow where their tips reach the toughness of the material.

    A new piece is straight, in the direction of the criterion. One that would meet the boundary, a
    hole or another crack, or end less than a quarter of its length short of it, ends there.
    """

    criterion: PartName = Field(
        default="hoop_stress",
        description='"hoop_stress", "strain_energy_density", "energy_release", "straight_ahead" or '
        '"module:Name"',
        examples=["energy_release"],
    )
    toughness: Intensity | None = Field(
        default=None, gt=0, description="K_Ic in Pa m^0.5, > 0", examples=["1.2 MPa m^0.5"]
    )
    energy: SurfaceEnergy | None = Field(
        default=None, gt=0, description="G_c in J/m2, > 0", examples=["100 J/m^2"]
    )
    increment: Length = Field(
        gt=0, description="the length of a new piece in m, > 0", examples=["10 mm"]
    )
    parallel_stress: Flag = Field(
        default=False,
        description="true or false: whether the stress along a crack, where it presses, "
        "counts in the direction of a piece, which then ends without shear",
        examples=[True],
    )
    max_growth: Length | None = Field(
        default=None,
        gt=0,
        description="a growth in m, > 0, at which a front stops",
        examples=["200 mm"],
    )
    control: Literal["loads", "toughness"] = Field(
        default="loads",
        description='"loads" or "toughness": loads grow as [loading] says, and cracks under them, '
        "or the load factor is that at which the most critical tip is at its toughness, piece by "
        "piece",
        examples=["toughness"],
    )
    speed: Literal["freund", "rayleigh"] | None = Field(
        default=None,
        description='"freund" or "rayleigh", in motion: c_R (1 - G_c / G), the default, or c_R, '
        "the speed of Rayleigh's wave, as soon as a tip is critical",
        examples=["rayleigh"],
    )
    branching: Angle | None = Field(
        default=None,
        gt=0,
        le=1.0472,
        description="an angle in rad, > 0, in motion: branches leave by it to either side where "
        "a tip divides in two; that is where G reaches twice the fracture energy",
        examples=["25 deg"],
    )
    branching_length: Length | None = Field(
        default=None,
        gt=0,
        description="a length in m, > 0, that a tip must have run since it divided last, with "
        "twice the fracture energy coming in all along, before it divides; none if not given, so "
        "that the number of branches hangs on the length of pieces",
        examples=["10 mm"],
    )
    together: Number = Field(
        default=0.02,
        ge=0,
        lt=1,
        description="a part of the toughness, from 0 to below 1: tips that fall short by less grow "
        "with a critical one",
        examples=[0.0],
    )
    radius: Length | None = Field(
        default=None,
        gt=0,
        description="a radius in m, > 0, of the domain of the interaction integral; four cells "
        "of the cover by default",
        examples=["30 mm"],
    )
    nucleation: NucleationTable | None = Field(
        default=None, description="a table [fracture.nucleation]"
    )

    @model_validator(mode="after")
    def _check(self) -> FractureTable:
        given = [name for name in ("toughness", "energy") if getattr(self, name) is not None]
        if len(given) != 1:
            remedy = "one follows from the other: give one of them"
            raise fault(" and ".join(given) or "neither", "toughness or energy", remedy)
        return self
