"""Arc length by dissipation: every step takes the same energy from the bonds (Gutierrez 2004).

Where all unloads to its origin the energy follows from loads and displacements (Verhoosel, Remmers
and Gutierrez 2009). Slip under pressure is not taken back by unloading; what bonds at their limit
lose as they open and slide further is known by jump whatever they do (`PathState.losing`). What
members lose that yield does not count. Before the first bond is at its limit nothing is lost, and
the load is what grows.
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar, Self

import numpy as np

from integration.arrays import Floats
from nmm.controls.base import Control, PathState
from nmm.controls.path_equation import PathEquation

if TYPE_CHECKING:
    from nmm.scene.tables.loading.control import ControlTable


@dataclass(frozen=True)
class Dissipation(Control):
    """Energy that steps take (J)."""

    from_limit: ClassVar[bool] = True
    of_energy: ClassVar[bool] = True

    @classmethod
    def of(cls, table: "ControlTable") -> Self:
        assert table.energy is not None
        return cls(table.energy, np.inf if table.end_energy is None else table.end_energy)

    def idle(self, events: int, softened: bool) -> bool:
        return not softened

    def row(self, at: PathState) -> Floats:
        return at.losing()

    def standstill(self, at: PathState) -> PathEquation:
        # The same holds here; what the load works on stands still instead.
        return PathEquation(at.load, at.load, 0.0, 0.0)

    def correction(self, at: PathState, step: Floats) -> PathEquation:
        # Jumps that lose energy stand still, whether they would open further or unload: to load
        # and unload on one secant loses nothing, but moves these.
        row = self.row(at)
        return PathEquation(at.load, row if row.any() else step, 0.0, 0.0)
