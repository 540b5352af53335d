"""The effect: viscous boundaries with incoming waves (Lysmer and Kuhlemeyer 1969).

The reactions of supports that a stage removes from an edge may stay on it as loads, so that the
model does not drift under its weight.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Self

import numpy as np
import shapely
from shapely import LineString

from integration.arrays import Bools, Floats
from nmm.assembly.model import Model
from nmm.assembly.places import NEAR
from nmm.assembly.state import State
from nmm.effects.acting_place import edge_place
from nmm.effects.base import Instant, Setup
from nmm.effects.members.ends import elements_at
from nmm.effects.motion.driven_edges import DrivenEdges
from nmm.effects.motion.edge_dashpots import EdgeDashpots, ground_of
from nmm.effects.motion.reactions import Reactions
from nmm.effects.motion.record import GroundMotion, motions_of, velocity_of

if TYPE_CHECKING:
    from nmm.effects.change import Change
    from nmm.scene.tables.shaking.boundaries import ViscousBoundaryTable


@dataclass(frozen=True)
class ViscousBoundary:
    """One viscous boundary.

    Attributes
    ----------
    name
        Name in the scene.
    dashpots
        Dashpots on its edges.
    incoming
        Incoming waves along x (0) and y (1).
    segment
        (2, 2) its segment (m); None for the whole boundary of its block.
    takes_over
        Whether reactions of supports that are removed stay as loads.
    """

    name: str
    dashpots: EdgeDashpots
    incoming: Mapping[int, GroundMotion]
    segment: Floats | None = None
    takes_over: bool = False

    def holds(self, reactions: Reactions) -> Bools:
        """Return which of the reactions (k,) act on it."""
        if not self.takes_over:
            return np.zeros(len(reactions), dtype=bool)
        if self.segment is None:
            return np.isin(reactions.elements, self.dashpots.place.elements)
        line, points = LineString(self.segment), shapely.points(reactions.position)
        return np.asarray(shapely.dwithin(line, points, NEAR * line.length))

    @property
    def driven(self) -> bool:
        """Whether a wave comes in."""
        return bool(self.incoming)

    def traction(self, time: float) -> Floats:
        """Tractions (m, 2) of the incoming wave: twice those of its velocity (Pa)."""
        return 2 * self.dashpots.tractions(velocity_of(self.incoming, time))


class ViscousBoundaries(DrivenEdges):
    """All viscous boundaries of a scene.

    An edge held by nothing else drifts under a constant load with the velocity of load over
    impedance, unless it took over the reactions of the supports before it.
    """

    name = "viscous boundaries"

    def __init__(self, boundaries: list[ViscousBoundary], model: Model) -> None:
        super().__init__(boundaries, model.manifold.n_unknowns)
        self.boundaries, self._model = boundaries, model
        self._stand(Reactions.none(self._n))

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build from the ``[[viscous_boundaries]]``."""
        found = [_boundary(setup, one) for one in setup.scene.viscous_boundaries]  # a handful
        return cls(found, setup.model)

    def take_over(self, left: Sequence[Reactions]) -> None:
        """See `Effect.take_over`: reactions along boundaries that ask for them stay as loads."""
        parts = [one.at(self._held(one)) for one in left]
        self._stand(Reactions.sum([self._standing, *parts], self._n))

    def follow(self, change: "Change") -> "ViscousBoundaries":
        """Return the boundaries on the new model, with the reactions that act on them."""
        new, known = type(self).from_setup(change.setup), self._standing
        elements = elements_at(change.setup, known.position)
        same = np.array_equal(elements, known.elements) and len(known.beside) == new._n
        beside = known.beside if same else np.zeros(new._n)
        moved = Reactions(elements, known.position, known.force, beside)
        new._stand(moved.at(new._held(moved) & (elements >= 0)))
        return new

    def carried(self) -> Reactions:
        """See `Effect.carried`: the reactions taken over."""
        return self._standing

    def carry(self, carried: Reactions) -> None:
        self._stand(carried)

    def force(self, state: State, end: Instant) -> Floats:
        """Return the force (n,) of incoming waves and of reactions taken over."""
        return super().force(state, end) + self._standing.push(self._points, state)

    def work(self, before: State, after: State) -> float:
        """Work (J) of incoming waves and of reactions taken over."""
        stays = self._standing.work(self._points, before, after)
        return super().work(before, after) + stays

    def _stand(self, reactions: Reactions) -> None:
        self._standing, self._points = reactions, reactions.points(self._model)

    def _held(self, reactions: Reactions) -> Bools:
        found = np.zeros(len(reactions), dtype=bool)
        for one in self.boundaries:  # a handful
            found |= one.holds(reactions)
        return found

    @property
    def about(self) -> str:
        return f"dashpots at {sum(len(one.dashpots.place) for one in self.boundaries)} points"

    @property
    def resolves(self) -> float | None:
        waves = [motion for one in self.boundaries for motion in one.incoming.values()]
        return min((motion.shortest_step for motion in waves), default=None)

    def history(self, state: State) -> Mapping[str, float]:
        """Return the mean displacement of each boundary (m)."""
        found: dict[str, float] = {}
        for one in self.boundaries:
            points, weight = one.dashpots.place.points, one.dashpots.area
            way = points.moved(state.frames, state.deformation)
            mean = weight @ way / weight.sum()
            found |= {f"{one.name}:ux": float(mean[0]), f"{one.name}:uy": float(mean[1])}
        return found


def _boundary(setup: Setup, table: "ViscousBoundaryTable") -> ViscousBoundary:
    model = setup.model
    # Exact for products of two displacements.
    order = 2 * max(model.manifold.degree, 1)
    place = edge_place(setup, "viscous_boundaries", table, order)
    dashpots = EdgeDashpots.of(model, place, ground_of(table))
    incoming = motions_of(setup.scene, table.incoming)
    segment = None if table.segment is None else np.array(table.segment)
    return ViscousBoundary(table.name, dashpots, incoming, segment, table.reactions)
