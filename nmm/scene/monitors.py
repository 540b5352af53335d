"""Tables of what is watched in a run: monitors, and answers from elsewhere."""

from __future__ import annotations

from pydantic import Field

from nmm.scene.fields import NAME, AnyQuantity, BlockName, Frozen, Name, Number, Point, Prose, Text


class MonitorTable(Frozen):
    """A point of a block whose displacement is recorded."""

    name: Name = Field(description=NAME, examples=["midspan"])
    point: Point = Field(description="a point [x, y] in m", examples=[[0, 0]])
    block: BlockName | None = Field(
        default=None, description="the name of a block", examples=["beam"]
    )


class ReferenceTable(Frozen):
    """An answer from elsewhere that a result is compared with."""

    quantity: Text = Field(
        description="a number of summary.json or a column of history.csv, max: or min: of one, or "
        '"energy", the elastic energy at the end',
        examples=["failure_load"],
    )
    value: AnyQuantity = Field(description="a number in SI", examples=[9124.0])
    tolerance: Number = Field(ge=0, description="a relative tolerance, >= 0", examples=[0.02])
    source: Prose = Field(description="where the value comes from", examples=["linear programme"])
