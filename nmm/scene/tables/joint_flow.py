"""Tables of flow in joints: viscosity, storage, and prescribed heads."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field, model_validator

from nmm.scene.actions import PlacedTable
from nmm.scene.fields import SMALLEST, Coordinate, Flag, ForceDensity, Frozen, Time, fault, quantity
from nmm.scene.tables.water import WATER

Viscosity = Annotated[float, quantity("Pa s", SMALLEST)]


class JointFlowTable(Frozen):
    """Water that flows in joints whose interface has an `aperture`, by the cubic law.

    Apertures open and close with the joints; its pressure acts on both faces. There is no suction:
    above the water table joints are without pressure. It is steady unless it is `transient`: then
    joints store what they open by and what water is compressed by, and it has a `duration` of its
    own in a scene without inertia, of which the load factor is the share that has passed.
    """

    viscosity: Viscosity = Field(
        default=1e-3, gt=0, description="a viscosity in Pa s, > 0", examples=["1 mPa s"]
    )
    unit_weight: ForceDensity = Field(
        default=WATER, gt=0, description="a weight of water in N/m3, > 0", examples=["9.81 kN/m^3"]
    )
    transient: Flag = Field(
        default=False, description="true or false: whether water is stored", examples=[True]
    )
    bulk_modulus: Annotated[float, quantity("Pa")] = Field(
        default=2.2e9, gt=0, description="a bulk modulus of water in Pa, > 0", examples=["2.2 GPa"]
    )
    initial: Coordinate | None = Field(
        default=None, description="a head in m at the start, where it is transient", examples=[10.0]
    )
    duration: Time | None = Field(
        default=None, gt=0, description="a duration in s, > 0, without inertia", examples=["2 h"]
    )

    @model_validator(mode="after")
    def _check(self) -> JointFlowTable:
        for key in ("initial", "duration"):
            if getattr(self, key) is not None and not self.transient:
                expected = "transient = true"
                raise fault(f"{key} of steady flow", expected, f"add it, or remove {key}")
        if self.transient and self.initial is None:
            raise fault("no initial head", "a head in m at the start", "give initial")
        return self


class JointHeadTable(PlacedTable):
    """A head that is prescribed at the ends of joints at a point, or along a segment.

    `history` multiplies it.
    """

    head: Coordinate = Field(description="a head in m: y of the level", examples=["28 m"])

    @model_validator(mode="after")
    def _check(self) -> JointHeadTable:
        places = [key for key in ("point", "segment") if getattr(self, key) is not None]
        if len(places) != 1 or self.block is not None:
            found = ", ".join(places + (["block"] if self.block else [])) or "no place"
            raise fault(found, "a point or a segment", "give point, or segment")
        return self
