"""Tables of seepage: prescribed heads, inflows, free surface, duration."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field, model_validator

from nmm.scene.fields import (
    Coordinate,
    Flag,
    ForceDensity,
    Frozen,
    Number,
    Point,
    Time,
    fault,
    quantity,
)
from nmm.scene.tables.heat import PlacedFlux, on_segment
from nmm.scene.tables.water import WATER

Seeping = Annotated[float, quantity("m/s")]


class SeepageTable(Frozen):
    """Water that seeps through the blocks by Darcy's law; its pressure acts in effective stress.

    Water fills all pores, above the water table under suction; with a `free_surface` pores above it
    are empty, and edges with a head are open to the air above the water: it leaves there, and none
    comes in; transient, it fills and drains the `drainable_porosity` of materials. Head is the
    height to which water would rise, in the scene's y. It is steady at every instant of `history`
    unless it is transient; then it has a `duration` of its own in a scene without inertia, of which
    the load factor is the share that has passed. Faces without a condition, cracks and joints are
    tight unless their `leakage` is given. Strain squeezes water out where it is `coupled`.
    """

    unit_weight: ForceDensity = Field(
        default=WATER, gt=0, description="a weight of water in N/m3, > 0", examples=["9.81 kN/m^3"]
    )
    free_surface: Flag = Field(
        default=False,
        description="true or false: whether pores above the water table are empty",
        examples=[True],
    )
    transient: Flag = Field(
        default=False, description="true or false: whether water is stored", examples=[True]
    )
    coupled: Flag = Field(
        default=False,
        description="true or false: whether strain makes room for water, where it is transient",
        examples=[True],
    )
    initial: Coordinate | None = Field(
        default=None, description="a head in m at the start, where it is transient", examples=[10.0]
    )
    duration: Time | None = Field(
        default=None, gt=0, description="a duration in s, > 0, without inertia", examples=["2 h"]
    )

    @model_validator(mode="after")
    def _check(self) -> SeepageTable:
        for key in ("initial", "duration"):
            if getattr(self, key) is not None and not self.transient:
                expected = "transient = true"
                raise fault(f"{key} of steady seepage", expected, f"add it, or remove {key}")
        if self.coupled and not self.transient:
            raise fault("coupled steady seepage", "transient = true", "add it, or remove coupled")
        if self.coupled and self.free_surface:
            expected = "water that fills all pores"
            raise fault("coupled seepage with a free_surface", expected, "remove one of them")
        if self.transient and self.initial is None:
            raise fault("no initial head", "a head in m at the start", "give initial")
        return self


class HeadTable(PlacedFlux):
    """A head that is prescribed along a segment of the boundary, or given in whole blocks."""

    head: Coordinate = Field(description="a head in m: y of the level", examples=["28 m"])
    gradient: tuple[Number, Number] = Field(
        default=(0.0, 0.0),
        description="slopes [gx, gy] in m/m: the head is that at `about`, and grows from it; "
        "[0, 1] is a pressure that is even",
        examples=[[0.0, 1.0]],
    )
    about: Point = Field(default=(0.0, 0.0), description="a point [x, y] in m")

    @model_validator(mode="after")
    def _check(self) -> HeadTable:
        if self.segment is None and self.block is None:
            raise fault("no place", "a segment or a block", "give segment, or block")
        return self


class InflowTable(PlacedFlux):
    """Water that flows into blocks through a segment of their boundary, such as rain."""

    velocity: Seeping = Field(
        description="a volume in m3 for each m2 and s, into the block", examples=["1e-8 m/s"]
    )

    @model_validator(mode="after")
    def _check(self) -> InflowTable:
        on_segment(self)
        return self
