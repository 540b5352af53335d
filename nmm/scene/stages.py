"""Stages: the blocks, loads, supports and members of successive stages."""

from __future__ import annotations

from pydantic import Field, model_validator

from nmm.scene.fields import BlockName, Flag, Frozen, Name, Options, TableName, Time, example, fault

KINDS = {
    "loads": ("loads",),
    "supports": ("supports",),
    "heat": ("temperatures", "heat_fluxes", "heat_sources", "convections"),
    "water": ("water_pressures", "heads", "inflows", "joint_heads"),
}
"""Keys of a stage that list names, and the tables of the scene with these names."""


class StageTable(Frozen):
    """What is there from the stage's beginning to its end.

    A stage without duration is solved to rest. What is not given stays as in the stage before; at
    first every block, load, support and member is there, with all that heats and wets. What names a
    block is there with it; a member that is new is put in as all stands then.
    """

    name: Name = Field(description="a name of its own", examples=["excavation"])
    blocks: tuple[BlockName, ...] | None = Field(
        default=None, description="names of all blocks that are there", examples=[["base"]]
    )
    remove: tuple[BlockName, ...] = Field(
        default=(), description="names of blocks that leave", examples=[["fill"]]
    )
    add: tuple[BlockName, ...] = Field(
        default=(),
        description="names of blocks that arrive, free of stress, at the place they are drawn at",
        examples=[["lift"]],
    )
    materials: dict[BlockName, TableName] = Field(
        default={},
        description="blocks that are of another material from this stage on, and which; they keep "
        "their stress",
        examples=[{"slope": "weathered"}],
    )
    loads: tuple[Name, ...] | None = Field(
        default=None, description="names of all loads that act", examples=[["pressure"]]
    )
    supports: tuple[Name, ...] | None = Field(
        default=None, description="names of all supports that act", examples=[["left"]]
    )
    members: tuple[Name, ...] | None = Field(
        default=None,
        description="names of all springs, dashpots, bars, foundations and masses that are there",
        examples=[["bolt"]],
    )
    heat: tuple[Name, ...] | None = Field(
        default=None,
        description="names of all temperatures, heat fluxes, heat sources and convections that act",
        examples=[["summer"]],
    )
    water: tuple[Name, ...] | None = Field(
        default=None,
        description="names of all water pressures, heads, inflows and joint heads that act",
        examples=[["full reservoir"]],
    )
    duration: Time | None = Field(
        default=None,
        gt=0,
        description="a duration in s, > 0; solved to rest when not given; without inertia time "
        "passes in equilibrium, and matter creeps",
        examples=example("s"),
    )
    release: float | None = Field(
        default=None,
        ge=0,
        le=1,
        description="share of what removed blocks exerted that is gone at the end of the stage, "
        "of these and of those before; what is gone stays gone; all of it at once when never given",
        examples=[0.5],
    )
    reset_displacements: Flag = Field(
        default=False,
        description="true or false: whether displacements, of monitors and of frames, count from "
        "its start",
        examples=[True],
    )
    cover: Options | None = Field(
        default=None,
        description="keys of the formulation's [cover] that are other from this stage on",
        examples=[{"degree": 2}],
    )

    def lists(self, key: str) -> tuple[str, ...] | None:
        """Return the names listed under a key of `KINDS`; None where the list does not change."""
        found: tuple[str, ...] | None = getattr(self, key)
        return found

    @model_validator(mode="after")
    def _one_way(self) -> StageTable:
        """Refuse a list of all blocks beside lists of removed and added ones."""
        if self.blocks is not None and (self.remove or self.add):
            remedy = "keep blocks, or remove and add"
            raise fault("blocks beside remove or add", "one way to say which are there", remedy)
        return self
