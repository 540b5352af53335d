"""Viscous boundaries, and the waves that come in through them (Lysmer and Kuhlemeyer 1969)."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Self

from integration.arrays import Floats
from nmm.assembly.motion import State
from nmm.effects.acting_place import edge_place
from nmm.effects.base import Setup
from nmm.effects.motion.driven_edges import DrivenEdges
from nmm.effects.motion.edge_dashpots import EdgeDashpots, ground_of
from nmm.effects.motion.record import GroundMotion, motions_of, velocity_of

if TYPE_CHECKING:
    from nmm.scene.tables.shaking.boundaries import ViscousBoundaryTable


@dataclass(frozen=True)
class ViscousBoundary:
    """One boundary: its dashpots, and the wave that comes in along x (0) and y (1)."""

    name: str
    dashpots: EdgeDashpots
    incoming: Mapping[int, GroundMotion]

    @property
    def driven(self) -> bool:
        """Whether a wave comes in."""
        return bool(self.incoming)

    def traction(self, time: float) -> Floats:
        """Tractions (m, 2) that send the wave in: twice those of its velocity (Pa)."""
        return 2 * self.dashpots.tractions(velocity_of(self.incoming, time))


class ViscousBoundaries(DrivenEdges):
    """Dashpots on edges, against the velocity, and incoming waves.

    What the dashpots took is booked as lost, what the waves brought as work. An edge held by
    nothing else drifts under a force that stays: with its share of force over impedance.
    """

    name = "viscous boundaries"

    def __init__(self, boundaries: list[ViscousBoundary], n_unknowns: int) -> None:
        super().__init__(boundaries, n_unknowns)
        self.boundaries = boundaries

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
    def resolves(self) -> float | None:
        """See `Effect.resolves`."""
        waves = [motion for one in self.boundaries for motion in one.incoming.values()]
        return min((motion.shortest_step for motion in waves), default=None)

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
