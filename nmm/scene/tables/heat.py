"""Tables of heat: prescribed temperatures, fluxes, sources, convection, duration."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field, model_validator

from nmm.scene.actions import PlacedTable
from nmm.scene.fields import Flag, Frozen, Point, Time, fault, quantity

Temperature = Annotated[float, quantity("K")]
TemperatureSlope = Annotated[float, quantity("K/m")]
HeatFlux = Annotated[float, quantity("W/m^2")]
HeatSource = Annotated[float, quantity("W/m^3")]
HeatExchange = Annotated[float, quantity("W/m^2/K")]


class HeatTable(Frozen):
    """Temperature; conducted in the blocks, it strains them by their `thermal_expansion`.

    It is steady at every instant of `history` unless it is transient. Faces without a condition,
    cracks and joints insulate unless their `conductance` is given. In a scene without inertia
    transient heat has a `duration` of its own: the load factor, from 0 to 1, is its share that has
    passed.
    """

    reference: Temperature = Field(
        default=0.0,
        description="a temperature in K at which blocks are free of thermal strain",
        examples=["20 degC"],
    )
    transient: Flag = Field(
        default=False, description="true or false: whether heat is stored", examples=[True]
    )
    initial: Temperature | None = Field(
        default=None,
        description="a temperature in K at the start, the reference if not given",
        examples=["20 degC"],
    )
    duration: Time | None = Field(
        default=None, gt=0, description="a duration in s, > 0, without inertia", examples=["2 h"]
    )

    @model_validator(mode="after")
    def _check(self) -> HeatTable:
        for key in ("initial", "duration"):
            if getattr(self, key) is not None and not self.transient:
                raise fault(f"{key} of steady heat", "transient = true", f"add it, or remove {key}")
        return self


class PlacedFlux(PlacedTable):
    """Base of tables that act on a part of the boundary or in the volume of blocks."""

    @model_validator(mode="after")
    def _at_a_place(self) -> PlacedFlux:
        if self.point is not None:
            raise fault("a point", "a segment or a block", "give a segment of the boundary")
        return self


def on_segment(item: PlacedTable) -> None:
    """Refuse a table without a segment."""
    if item.segment is None:
        raise fault("no segment", "a segment of the boundary", "give segment")


class TemperatureTable(PlacedFlux):
    """A temperature that is prescribed along a segment of the boundary, or given in whole blocks.

    `history` multiplies what it is above the reference.
    """

    temperature: Temperature = Field(description="a temperature in K", examples=["80 degC"])
    gradient: tuple[TemperatureSlope, TemperatureSlope] = Field(
        default=(0.0, 0.0),
        description="slopes [gx, gy] in K/m: the temperature is that at `about`, and grows from it",
        examples=[[10.0, 0.0]],
    )
    about: Point = Field(default=(0.0, 0.0), description="a point [x, y] in m")

    @model_validator(mode="after")
    def _check(self) -> TemperatureTable:
        if self.segment is None and self.block is None:
            raise fault("no place", "a segment or a block", "give segment, or block")
        return self


class HeatFluxTable(PlacedFlux):
    """A flux of heat into blocks through a segment of their boundary."""

    flux: HeatFlux = Field(description="a flux in W/m2, into the block", examples=["200 W/m^2"])

    @model_validator(mode="after")
    def _check(self) -> HeatFluxTable:
        on_segment(self)
        return self


class HeatSourceTable(PlacedFlux):
    """Heat that is set free in the volume of blocks; without block in all."""

    power: HeatSource = Field(description="a power in W/m3", examples=["500 W/m^3"])

    @model_validator(mode="after")
    def _check(self) -> HeatSourceTable:
        if self.segment is not None:
            raise fault("a segment", "a block or no place", "use [[heat_fluxes]], or give a block")
        return self


class ConvectionTable(PlacedFlux):
    """Surroundings that exchange heat with a segment of the boundary.

    `history` multiplies what their temperature is above the reference.
    """

    coefficient: HeatExchange = Field(
        gt=0, description="a coefficient in W/(m2 K), > 0", examples=["10 W/m^2/K"]
    )
    temperature: Temperature = Field(description="a temperature in K", examples=["20 degC"])

    @model_validator(mode="after")
    def _check(self) -> ConvectionTable:
        on_segment(self)
        return self
