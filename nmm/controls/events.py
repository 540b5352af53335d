"""Event by event: every step ends where the next bond is at its limit, up or down the load."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar, Self

import numpy as np

from integration.arrays import Floats
from nmm.controls.base import Control, PathState

if TYPE_CHECKING:
    from nmm.scene.tables.loading.control import ControlTable


@dataclass(frozen=True)
class NextEvent(Control):
    """The load factor, at which the next bond breaks."""

    by_load: ClassVar[bool] = True
    from_limit: ClassVar[bool] = True

    @classmethod
    def of(cls, table: "ControlTable") -> Self:
        return cls(1.0)

    def row(self, at: PathState) -> Floats:
        return np.zeros_like(at.load)

    def share(self, at: PathState) -> float:
        return 1.0
