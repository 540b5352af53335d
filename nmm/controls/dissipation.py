"""Arc length by dissipation: every step takes the same energy from the structure.

With loads ``p = lambda f + g`` on a structure that unloads to its origin ``p.u / 2`` is stored, so
that a step dissipates ``(p.du - dlambda f.u) / 2`` (Gutierrez 2004; Verhoosel, Remmers and
Gutierrez 2009; there without forces ``g`` that stay, as of weight and of initial stress). Before
the first bond is at its limit nothing is dissipated, and the load is what grows.
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
    to_origin: ClassVar[bool] = True

    @classmethod
    def of(cls, table: "ControlTable") -> Self:
        assert table.energy is not None
        return cls(table.energy, np.inf if table.end_energy is None else table.end_energy)

    def idle(self, events: int, softened: bool) -> bool:
        return not softened

    def row(self, at: PathState) -> Floats:
        return np.asarray((at.state.load_factor * at.load + at.dead) / 2)

    def share(self, at: PathState) -> float:
        return -float(at.load @ at.way) / 2

    def standstill(self, at: PathState) -> PathEquation:
        # The same holds here; what the load works on stands still instead.
        return PathEquation(at.load, at.load, 0.0, 0.0)

    def correction(self, at: PathState, step: Floats) -> PathEquation:
        # Unloading to the origin dissipates nothing either, however far: a correction is normal to
        # its step instead (Ramm 1981).
        return PathEquation(at.load, step, 0.0, 0.0)
