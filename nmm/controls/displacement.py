"""Control by the displacement of a point, or by how far two points move apart."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Self

import numpy as np

from integration.arrays import Floats
from nmm.controls.base import Control, PathState

if TYPE_CHECKING:
    from nmm.scene.tables.loading.control import ControlTable


@dataclass(frozen=True)
class Displacement(Control):
    """Displacement of a monitor along a direction (m).

    Attributes
    ----------
    monitors
        Names: the point; of an opening the second point is counted less.
    direction
        A unit vector.
    """

    monitors: tuple[str, ...] = ()
    direction: tuple[float, float] = (1.0, 0.0)

    @classmethod
    def of(cls, table: "ControlTable") -> Self:
        size = float(np.hypot(*table.direction))
        way = (table.direction[0] / size, table.direction[1] / size)
        end = np.inf if table.end is None else table.end
        assert table.increment is not None
        return cls(table.increment, end, tuple(table.monitors), way)

    def row(self, at: PathState) -> Floats:
        total = np.zeros_like(at.load)
        for sign, name in zip((1.0, -1.0), self.monitors, strict=False):
            points = at.monitors[name]
            along = points.along(at.state.frames, sign * np.array([self.direction]))
            total += np.bincount(points.rows.unknowns.ravel(), along.ravel(), len(total))
        return total


class Opening(Displacement):
    """By how far a first monitor moves along a direction from a second: a crack's mouth (m)."""

    def idle(self, events: int, softened: bool) -> bool:
        """See `Control.idle`: faces that a bond holds do not part before it gives way."""
        return events == 0
