"""Water that flows in joints: its viscosity, and the heads that are held at their ends."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field, model_validator

from nmm.scene.actions import Placed
from nmm.scene.fields import SMALLEST, Coordinate, ForceDensity, Frozen, fault, quantity
from nmm.scene.tables.water import WATER

Viscosity = Annotated[float, quantity("Pa s", SMALLEST)]


class JointFlowTable(Frozen):
    """Water that flows steadily in joints whose interface has an `aperture`, by the cubic law.

    Apertures open and close with the joints; its pressure acts on both faces. There is no suction:
    above the water table joints are without pressure.
    """

    viscosity: Viscosity = Field(
        default=1e-3, gt=0, description="a viscosity in Pa s, > 0", examples=["1 mPa s"]
    )
    unit_weight: ForceDensity = Field(
        default=WATER, gt=0, description="a weight of water in N/m3, > 0", examples=["9.81 kN/m^3"]
    )


class JointHeadTable(Placed):
    """A head that is held at the ends of joints at a point, or along a segment.

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
