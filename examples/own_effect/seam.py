"""An effect that changes what is solved: a crack that is there from a time on."""

from dataclasses import replace
from typing import TYPE_CHECKING, Self

import numpy as np
from pydantic import Field

from nmm.effects.base import Effect, Setup
from nmm.effects.event import Event
from nmm.scene.fields import Frozen, Point, Time

if TYPE_CHECKING:
    from nmm.effects.change import Change
    from nmm.effects.view import View


class Seam(Effect):
    """A polyline along which the material parts; what it cuts off is a body the next instant."""

    external = False

    class Table(Frozen):
        """Keys of ``[effects.NAME]``."""

        at: Time = Field(ge=0, description="a time in s", examples=["10 ms"])
        points: tuple[Point, ...] = Field(min_length=2, description="a polyline, points in m")

    def __init__(self, setup: Setup, opened: bool) -> None:
        self._table, self._geometry, self._opened = setup.table, setup.geometry, opened

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build from the table."""
        return cls(setup, opened=False)

    def event(self, view: "View") -> Event | None:
        """Ask for the crack in the first state at or after its time."""
        if self._opened or view.state.time < self._table.at:
            return None
        cracks = (*self._geometry.cracks, np.array(self._table.points))
        return Event(replace(self._geometry, cracks=cracks), "a seam opened")

    def follow(self, change: "Change") -> "Seam":
        """Return the effect on the new geometry, which has the crack if this one asked for it."""
        grown = len(change.setup.geometry.cracks) > len(self._geometry.cracks)
        return Seam(change.setup, self._opened or grown)

    def carried(self) -> bool:
        """Whether the crack is there."""
        return self._opened

    def carry(self, carried: bool) -> None:
        """See `Effect.carry`."""
        self._opened = carried
