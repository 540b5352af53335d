"""The table ``[output]``: states stored as frames, their quantities, and checkpoints."""

from __future__ import annotations

from typing import Literal

from pydantic import Field, model_validator

from nmm.scene.fields import Count, Flag, Frozen, PartName, Time, fault

Event = Literal["first_contact", "first_slip", "bond_breaks", "state_changes", "shape_changes"]


class CheckpointTable(Frozen):
    """How often a run stores all that it needs to go on from there.

    A run that asks for it drops, wherever it stores that, what it keeps for speed alone, so that it
    and one that was stopped and goes on give the same bytes; its results differ from those of a run
    without checkpoints within the tolerance of the solution.
    """

    every_time: Time | None = Field(
        default=None,
        gt=0,
        description="a time in s, > 0; of runs with inertia",
        examples=["0.5 s"],
    )
    every_steps: Count | None = Field(
        default=None, gt=0, description="a number of steps, > 0", examples=[50]
    )

    @model_validator(mode="after")
    def _asks(self) -> CheckpointTable:
        if self.every_time is None and self.every_steps is None:
            remedy = "write for example { every_steps = 50 }"
            raise fault("neither every_time nor every_steps", "one of them", remedy)
        return self


class OutputTable(Frozen):
    """Which states are stored as frames, each by what is named; the first and the last always are.

    Where nothing is named these are 60 in a dynamic run, 30 in the motion after failure and each
    step of growing loads. Steps are not cut to meet a time, so results do not depend on what is
    stored; the history has a line for each step whatever stands here.
    """

    every_time: Time | None = Field(
        default=None,
        gt=0,
        description="a time in s, > 0: the first step that reaches each multiple of it is stored; "
        "of runs with inertia and of the motion after failure",
        examples=["10 ms"],
    )
    every_steps: Count | None = Field(
        default=None, gt=0, description="a number of steps, > 0", examples=[5]
    )
    events: tuple[Event, ...] = Field(
        default=(),
        description='a list of "first_contact", "first_slip", "bond_breaks", "state_changes" and '
        '"shape_changes": the step after which it is so is stored; states are how many contact '
        "points stick, slide, hold and are broken, shapes change where blocks divide",
        examples=[["first_contact", "bond_breaks"]],
    )
    quantities: tuple[PartName, ...] = Field(
        default=(),
        description='a list of "von_mises", "principal_stress", "mean_stress", "crack_opening" and '
        '"module:Class" of outputs of one\'s own: what frames hold beside displacement and stress',
        examples=[["von_mises", "crack_opening"]],
    )
    pictures: Flag = Field(
        default=False,
        description="true or false: whether `nmm run` draws pictures of the run into its folder; "
        "`nmm plot` draws them of any run",
        examples=[True],
    )
    paraview: Flag = Field(
        default=False,
        description="true or false: whether `nmm run` writes ParaView files of the run into its "
        "folder; `nmm export` writes them of any run",
        examples=[True],
    )
    checkpoint: CheckpointTable | None = Field(
        default=None,
        description="[output.checkpoint]: how often all is stored that a run goes on from",
    )

    @property
    def chooses(self) -> bool:
        """Whether it selects the states that are stored."""
        return bool(self.every_time or self.every_steps or self.events)
