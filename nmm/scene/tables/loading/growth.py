"""The table ``[loading]``: how the loads of a static run grow."""

from __future__ import annotations

import math
from typing import Annotated, Literal

from pydantic import BeforeValidator, Field, model_validator

from nmm.errors import shown
from nmm.scene.fields import Frozen, Number, Time, fault
from nmm.scene.tables.loading.control import ControlTable


def _scaled(value: object) -> object:
    if value == "all" or isinstance(value, list | tuple):
        return value
    raise fault(shown(value), '"all" or a list of loads', 'write for example scaled = ["jack"]')


def _until(value: object) -> object:
    if value == "failure":
        return value
    if isinstance(value, int | float) and not isinstance(value, bool) and 0 < value < math.inf:
        return value
    raise fault(shown(value), '"failure" or a load factor > 0', 'write until = "failure"')


class Loading(Frozen):
    """How the loads of a static run grow."""

    scaled: Annotated[tuple[str, ...] | Literal["all"], BeforeValidator(_scaled)] = Field(
        default="all",
        description='"all" or a list of names of loads and of supports with a displacement',
        examples=["all"],
    )
    until: Annotated[float | Literal["failure"], BeforeValidator(_until)] = Field(
        default=1.0, description='"failure" or a load factor > 0', examples=["failure"]
    )
    maximum_factor: Number | None = Field(
        default=None, gt=0, description="a load factor > 0 at which to stop", examples=[10.0]
    )
    motion_after_failure: Time | None = Field(
        default=None,
        gt=0,
        description="a duration in s: the failed blocks move with inertia, to show the mode",
        examples=["5 ms"],
    )
    control: ControlTable | None = Field(
        default=None, description="a table [loading.control]: what grows in place of the load"
    )

    @model_validator(mode="after")
    def _check(self) -> Loading:
        if self.control is not None and (self.until != "failure" or self.motion_after_failure):
            remedy = 'write until = "failure" without motion_after_failure, or remove control'
            raise fault("control", 'until = "failure"', remedy)
        if self.until != "failure" and self.maximum_factor is not None:
            remedy = 'write until = "failure", or leave maximum_factor out'
            raise fault(f"until = {self.until} and maximum_factor", 'until = "failure"', remedy)
        if self.until != "failure" and self.motion_after_failure is not None:
            remedy = 'write until = "failure", or leave motion_after_failure out'
            raise fault(
                f"until = {self.until} and motion_after_failure", 'until = "failure"', remedy
            )
        return self
