"""The table ``[loading.control]``: path control of a static run."""

from __future__ import annotations

from pydantic import Field, model_validator

from nmm.scene.fields import Energy, Frozen, Length, Name, Number, PartName, fault

# Keys that each built-in control needs, and its number of monitors.
NEEDS: dict[str, tuple[tuple[str, ...], int]] = {
    "displacement": (("increment",), 1),
    "opening": (("increment",), 2),
    "dissipation": (("energy",), 0),
    "events": ((), 0),
}


class ControlTable(Frozen):
    """What grows step by step; the load factor is found with the displacements, up or down."""

    type: PartName = Field(
        description='"displacement" of a monitor, "opening" between two, "dissipation", "events", '
        'or "module:Name" of your own',
        examples=["opening"],
    )
    monitors: tuple[Name, ...] = Field(
        default=(),
        description="names of monitors: the point, or the two points of an opening",
        examples=[["right lip", "left lip"]],
    )
    direction: tuple[Number, Number] = Field(
        default=(1.0, 0.0),
        description="a direction [x, y], not zero, along which displacement or opening counts",
        examples=[[0, -1]],
    )
    increment: Length | None = Field(
        default=None,
        gt=0,
        description="a largest step in m, > 0; a displacement or opening needs one",
        examples=["2 um"],
    )
    end: Length | None = Field(
        default=None, gt=0, description="a displacement or opening in m at which to stop, > 0"
    )
    energy: Energy | None = Field(
        default=None,
        gt=0,
        description="an energy in J, > 0, that a step dissipates at most; a dissipation needs one",
        examples=["1 mJ"],
    )
    end_energy: Energy | None = Field(
        default=None, gt=0, description="a dissipated energy in J, > 0, at which to stop"
    )
    fall: Number = Field(
        default=0.0,
        ge=0,
        lt=1,
        description="a share of the largest load in [0, 1): the run ends where the load has fallen "
        "to it",
        examples=[0.2],
    )

    @model_validator(mode="after")
    def _check(self) -> ControlTable:
        keys, count = NEEDS.get(self.type, ((), len(self.monitors)))
        for key in keys:
            if getattr(self, key) is None:
                raise fault(f'type = "{self.type}" without {key}', key, f"add {key}")
        if len(self.monitors) != count:
            value = f'type = "{self.type}" with {len(self.monitors)} monitors'
            remedy = "correct their number in monitors"
            raise fault(value, f"names of monitors, {count} of them", remedy)
        if len(set(self.monitors)) < len(self.monitors):
            remedy = "name another, across what opens"
            raise fault(f'"{self.monitors[0]}" twice', "monitors of two points", remedy)
        if not any(self.direction):
            raise fault("direction [0, 0]", "a direction that is not zero", "correct it")
        return self
