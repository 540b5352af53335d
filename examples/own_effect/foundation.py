"""An effect of one's own: a Winkler foundation, springs spread along an edge."""

from typing import Self

import numpy as np
from pydantic import Field
from scipy.sparse import csc_array, csr_array

from integration.arrays import Floats
from nmm.assembly.places import Place, on_segment
from nmm.assembly.state import State
from nmm.effects.base import Effect, Instant, Setup
from nmm.errors import GeometryError
from nmm.quantity import Quantity
from nmm.scene.fields import Frozen, Segment, SpringStiffness


class Winkler(Effect):
    """``p = k u`` along an edge: pressure over the way of its points, in ``direction``."""

    class Table(Frozen):
        """Keys of ``[effects.NAME]``."""

        segment: Segment = Field(description="two points on the edge in m")
        stiffness: SpringStiffness = Field(
            gt=0, description="a stiffness in Pa/m, > 0", examples=["10 MPa/m"]
        )
        direction: tuple[float, float] = Field(default=(0.0, 1.0), description="a unit vector")

    def __init__(self, place: Place, stiffness: Floats, direction: Floats, setup: Setup) -> None:
        self._place = place
        self._stiffness = stiffness  # (m,) N/m of each point
        self._direction = np.tile(direction, (len(place), 1))
        self._n = setup.model.manifold.n_unknowns
        self._thickness = setup.model.thickness
        self._body_count = setup.model.manifold.n_bodies

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build from the table."""
        table = setup.table
        place = on_segment(setup.model.manifold, np.array(table.segment))
        if not len(place):
            raise GeometryError(
                f"foundation: {table.segment}: expected the edge of a block: move the segment"
            )
        stiffness = table.stiffness * setup.model.thickness * place.weight
        return cls(place, stiffness, np.array(table.direction), setup)

    def matrix(self, state: State) -> csc_array:
        """Return ``k n n^T`` summed over the points."""
        rows = self._rows(state)
        return csc_array(rows.T @ rows.multiply(self._stiffness[:, None]))

    def force(self, state: State, end: Instant) -> Floats:
        """Return the springs' force at the start of the step; the matrix has its growth."""
        return -np.asarray(self._rows(state).T @ (self._stiffness * self._way(state)))

    def energy(self, state: State) -> float:
        """Return what the springs store (J)."""
        return float(self._stiffness @ self._way(state) ** 2) / 2

    def history(self, state: State) -> dict[str, float]:
        """Return the whole reaction (N) and the largest settlement (m)."""
        way = self._way(state)
        return {"reaction": -float(self._stiffness @ way), "settlement": -float(way.min())}

    def outputs(self, state: State) -> dict[str, Quantity]:
        """Return the mean pressure under each body (Pa); nan where it does not rest."""
        body, share = self._place.points.body, self._place.weight
        pressure = -self._stiffness / (share * self._thickness) * self._way(state)
        total, length = (
            np.bincount(body, values, minlength=self._body_count)
            for values in (pressure * share, share)
        )
        with np.errstate(invalid="ignore"):
            return {"pressure": Quantity("bodies", total / length, "Pa")}

    def _rows(self, state: State) -> csr_array:
        """(m, n) from the unknowns of a step to the motion of the points along the direction."""
        local = self._place.points.along(state.frames, self._direction)
        unknowns = self._place.points.rows.unknowns
        ends = np.arange(len(local) + 1) * local.shape[1]
        return csr_array((local.ravel(), unknowns.ravel(), ends), shape=(len(local), self._n))

    def _way(self, state: State) -> Floats:
        """How far the points have come along the direction (m)."""
        moved = self._place.points.moved(state.frames, state.deformation)
        return np.asarray(np.sum(moved * self._direction, axis=1))
