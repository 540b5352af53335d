"""The effect: forces that travel along edges."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Self

import numpy as np

from integration.arrays import Bools, Floats, Ints
from nmm.assembly.material_points import MaterialPoints, material_points
from nmm.assembly.model import Model
from nmm.assembly.places import on_segment
from nmm.assembly.state import State
from nmm.effects.base import Effect, Instant, Setup
from nmm.effects.loading.load_factor import load_factor

if TYPE_CHECKING:
    from nmm.scene.tables.loading.loads import LoadTable

# Degree of the quadrature of a spread force, beyond that of the displacement.
BEYOND_DISPLACEMENTS = 4


@dataclass(frozen=True)
class MovingLoad:
    """A force that travels from the first to the second point of a segment.

    Attributes
    ----------
    segment
        (2, 2) the two points (m).
    ends, elements
        (k, 2) begin and end of the boundary edges along the segment, in order (m from its first
        point), and their elements (k,).
    force, factor
        (2,) force (N), and the load factor.
    start, speed, spread
        Start of its front (s), its speed (m/s), and the length behind the front over which the
        force is spread (m); 0 for a point force.
    regions
        (N,) input regions that it acts on; None for all.
    """

    segment: Floats
    ends: Floats
    elements: Ints
    force: Floats
    factor: Callable[[Instant], float]
    start: float
    speed: float
    spread: float
    regions: Bools | None

    def acting(self, model: Model, end: Instant) -> tuple[MaterialPoints, Floats] | None:
        """Return its points and the forces (m, 2) on them (N); None off its way."""
        length = float(np.hypot(*(self.segment[1] - self.segment[0])))
        front = self.speed * (end.time - self.start)
        force = self.factor(end) * self.force
        if not self.spread:
            if not 0 <= front <= length:
                return None
            piece = int(np.clip(np.searchsorted(self.ends[:, 1], front), 0, len(self.ends) - 1))
            point = self._at([front / length])
            return material_points(model.manifold, self.elements[[piece]], point), force[None, :]
        low, high = max(front - self.spread, 0.0), min(front, length)
        if high <= low:
            return None
        part = self._at([low / length, high / length])
        place = on_segment(
            model.manifold, part, self.regions, model.manifold.degree + BEYOND_DISPLACEMENTS
        )
        return place.points, place.weight[:, None] / self.spread * force

    def _at(self, shares: list[float]) -> Floats:
        """Points (k, 2) at shares (k,) of the segment."""
        first, last = self.segment
        return np.asarray(first + np.array(shares)[:, None] * (last - first))


class MovingLoads(Effect):
    """All travelling forces of a scene."""

    name = "moving loads"

    def __init__(self, model: Model, loads: list[MovingLoad]) -> None:
        self._model, self.loads = model, loads
        self._known: list[tuple[Instant, list[tuple[MaterialPoints, Floats]]]] = []

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build from the ``[[loads]]`` of kind "moving"."""
        found = [_load(setup, one) for one in setup.scene.loads if one.kind == "moving"]
        return cls(setup.model, found)

    @property
    def dead(self) -> bool:
        return True

    @property
    def steady(self) -> bool:
        return False

    def force(self, state: State, end: Instant) -> Floats:
        """Return the load vector (n,) at the end of the step, in the axes of the bodies."""
        total = np.zeros(len(state.deformation))
        for points, forces in self._acting(end):
            total += points.push(state, forces)
        return total

    def work(self, before: State, after: State) -> float:
        """Work (J) of half of the forces at each end, on the points where they act then."""
        total = 0.0
        for one in (before, after):
            for points, forces in self._acting(Instant.of(one)):
                total += points.work(before, after, forces) / 2
        return total

    def forget(self) -> None:
        self._known = []

    def _acting(self, end: Instant) -> list[tuple[MaterialPoints, Floats]]:
        """Points and forces of all loads; those at both ends of a step are cached."""
        for known, found in self._known:
            if known == end:
                return found
        all_of_them = (load.acting(self._model, end) for load in self.loads)
        found = [one for one in all_of_them if one is not None]
        self._known = [*self._known[-1:], (end, found)]
        return found


def _load(setup: Setup, load: "LoadTable") -> MovingLoad:
    assert load.segment is not None
    assert load.force is not None
    assert load.speed is not None
    segment, force = np.array(load.segment), np.array(load.force)
    factor, regions = load_factor(setup, load), setup.regions(load.block)
    # One point an edge, with the length of the edge as its weight.
    pieces = on_segment(setup.model.manifold, segment, regions, 1)
    way = segment[1] - segment[0]
    middle = (pieces.position - segment[0]) @ way / np.hypot(*way)
    order = np.argsort(middle)
    half = pieces.weight[order] / 2
    ends = np.stack([middle[order] - half, middle[order] + half], axis=1)
    elements = pieces.elements[order]
    given = (force, factor, load.start, load.speed, load.spread, regions)
    return MovingLoad(segment, ends, elements, *given)
