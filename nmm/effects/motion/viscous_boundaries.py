"""Viscous boundaries, and the waves that come in through them (Lysmer and Kuhlemeyer 1969)."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Self

import numpy as np
from scipy.sparse import csc_array

from integration.arrays import Floats
from nmm.assembly.motion import State
from nmm.effects.acting_place import edge_place
from nmm.effects.base import Effect, Instant, Setup
from nmm.effects.motion.edge_dashpots import EdgeDashpots, ground_of
from nmm.effects.motion.record import GroundMotion, motions_of

if TYPE_CHECKING:
    from nmm.scene.tables.shaking.boundaries import ViscousBoundaryTable


@dataclass(frozen=True)
class ViscousBoundary:
    """One boundary: its dashpots, and the wave that comes in along x (0) and y (1)."""

    name: str
    dashpots: EdgeDashpots
    incoming: Mapping[int, GroundMotion]

    def wave(self, time: float) -> Floats:
        """Velocity (2,) of the incoming wave (m/s)."""
        found = np.zeros(2)
        for axis, motion in self.incoming.items():
            found[axis] = motion.velocity_at(time)
        return found

    def traction(self, time: float) -> Floats:
        """Tractions (m, 2) that send the wave in: twice those of its velocity (Pa)."""
        return 2 * self.dashpots.tractions(self.wave(time))


class ViscousBoundaries(Effect):
    """Dashpots on edges, against the velocity, and incoming waves.

    What the dashpots took is booked as lost, what the waves brought as work. An edge held by
    nothing else drifts under a force that stays: with its share of force over impedance.
    """

    name = "viscous boundaries"

    def __init__(self, boundaries: list[ViscousBoundary], n_unknowns: int) -> None:
        self.boundaries, self._n = boundaries, n_unknowns
        none = csc_array((n_unknowns, n_unknowns))
        self._matrix = sum((one.dashpots.matrix(n_unknowns) for one in boundaries), start=none)

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build from the ``[[viscous_boundaries]]``."""
        found = [_boundary(setup, one) for one in setup.scene.viscous_boundaries]  # a handful
        return cls(found, setup.model.manifold.n_unknowns)

    @property
    def about(self) -> str:
        """See `Effect.about`."""
        return f"dashpots at {sum(len(one.dashpots.place) for one in self.boundaries)} points"

    @property
    def steady(self) -> bool:
        """See `Effect.steady`."""
        return not any(one.incoming for one in self.boundaries)

    @property
    def resolves(self) -> float | None:
        """See `Effect.resolves`."""
        waves = [motion for one in self.boundaries for motion in one.incoming.values()]
        return min((motion.shortest_step for motion in waves), default=None)

    def damping(self, state: State) -> csc_array:
        """See `Effect.damping`; always the same object."""
        return self._matrix

    def force(self, state: State, end: Instant) -> Floats:
        """Return the forces that send the waves in."""
        total = np.zeros(self._n)
        for one in self.boundaries:
            if one.incoming:
                total += one.dashpots.push(state, one.traction(end.time))
        return total

    def work(self, before: State, after: State) -> float:
        """Mean force of the waves times the motion of the edges."""
        waves = [one for one in self.boundaries if one.incoming]
        return sum(
            one.dashpots.work(
                before, after, (one.traction(before.time) + one.traction(after.time)) / 2
            )
            for one in waves
        )

    def history(self, state: State) -> Mapping[str, float]:
        """Return how far each boundary has drifted in the mean (m)."""
        found: dict[str, float] = {}
        for one in self.boundaries:
            points, weight = one.dashpots.place.points, one.dashpots.area
            way = points.moved(state.frames, state.deformation)
            mean = weight @ way / weight.sum()
            found |= {f"{one.name}:ux": float(mean[0]), f"{one.name}:uy": float(mean[1])}
        return found


def _boundary(setup: Setup, table: "ViscousBoundaryTable") -> ViscousBoundary:
    model = setup.model
    # Products of two displacements.
    order = 2 * max(model.manifold.degree, 1)
    place = edge_place(setup, "viscous_boundaries", table, order)
    dashpots = EdgeDashpots.of(model, place, ground_of(table))
    return ViscousBoundary(table.name, dashpots, motions_of(setup.scene, table.incoming))
