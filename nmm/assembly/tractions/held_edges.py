"""Edges that average tractions hold: what a stress that is added there does, and its work.

With the average ``T s`` of the tractions that the unknowns ``s`` of a stress give, the area ``A``
of the points and the jump ``B d``, Nitsche's terms exert ``B^T A T s`` on the unknowns ``d``.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats, Ints
from integration.sparse import csr_array, diags_array
from nmm.assembly.state import Frames
from nmm.assembly.stress_points import StressAt
from nmm.assembly.tractions.donors import Flux, added_traction

StressRows = Callable[[Ints, Floats], tuple[Floats, csr_array]]
"""From elements (m,) and points to the stress (m, 3) of a unit, and rows (m, k) of units there."""

JumpRows = Callable[[], tuple[csr_array, csr_array]]
"""To rows (m, n) of a jump along x and along y."""


@dataclass(frozen=True)
class HeldEdge:
    """Points of an edge, the tractions that hold it, and its jump.

    Attributes
    ----------
    fluxes
        Tractions on the first side that either side gives, times its weight.
    frames
        Place of the bodies.
    area
        (m,) that each point stands for (m2).
    jump
        (m, 2) of the first side less the second, in global axes (m).
    rows
        Of the jump, made when they are asked for.
    at
        Which points of the fluxes they are; None is all of them.
    """

    fluxes: Sequence[Flux]
    frames: Frames
    area: Floats
    jump: Floats
    rows: JumpRows
    at: Ints | None = None

    @property
    def key(self) -> bytes:
        """What tells the rows of this edge from those of another state."""
        bodies = np.unique(np.concatenate([one.body[self._some] for one in self.fluxes]))
        found: bytes = self.frames.angle[bodies].tobytes()
        return found if self.at is None else found + self.at.tobytes()

    @property
    def _some(self) -> Ints | slice:
        return slice(None) if self.at is None else self.at

    def tractions(self, stress: StressRows) -> tuple[csr_array, csr_array]:
        """Return rows (m, k) of the average traction times area, along x and along y (N)."""
        parts = [self._of_side(one, stress) for one in self.fluxes]  # at most two
        x, y = zip(*parts, strict=True)
        return csr_array(sum(x[1:], start=x[0])), csr_array(sum(y[1:], start=y[0]))

    def _of_side(self, side: Flux, stress: StressRows) -> tuple[csr_array, csr_array]:
        some = self._some
        unit, rows = stress(side.elements, side.points)
        pull = self.frames.to_global(side.body, side.of_stress(unit))[some]
        x, y = (self.area[:, None] * pull).T
        return csr_array(diags_array(x) @ rows[some]), csr_array(diags_array(y) @ rows[some])

    def coupling(self, stress: StressRows) -> csr_array:
        """Return the force (n, k) of units of the stress on the unknowns (N)."""
        along_x, along_y = self.rows()
        x, y = self.tractions(stress)
        return csr_array(along_x.T @ x + along_y.T @ y)

    def work(self, stress: StressRows) -> Floats:
        """Return the work (k,) of units of the stress on the jump (J)."""
        x, y = self.tractions(stress)
        return np.asarray(x.T @ self.jump[:, 0] + y.T @ self.jump[:, 1])

    def felt(self, stresses: Sequence[StressAt], time: float) -> float:
        """Return the tractions of stresses, as they are at a time, times the jump (J)."""
        pull = added_traction(self.fluxes, self.frames, stresses, time, self._some)
        return float(np.sum(self.area[:, None] * self.jump * pull))
