"""Forces on the matter at places: what the integrals about the tip of a crack must know of them."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Self

import numpy as np

from integration.arrays import Bools, Floats, Ints
from nmm.assembly.model import Model
from nmm.assembly.motion import State
from nmm.assembly.places import Place

Density = Callable[[Ints, Floats], Floats]


@dataclass(frozen=True)
class Pushes:
    """Forces within bodies and on faces of cracks; not those on the rest of the boundary.

    Attributes
    ----------
    element
        (m,) the elements that they act on.
    start, end
        (m, 2) of the part of a face over which each is spread evenly, where it was drawn (m); the
        same place twice where it acts at a point.
    force
        (m, 2) in global axes (N).
    densities
        Of forces on the volume: (m, 2) at points (m, 2) of elements (m,), in global axes (N/m3).
    """

    element: Ints
    start: Floats
    end: Floats
    force: Floats
    densities: tuple[Density, ...] = ()

    @classmethod
    def at(cls, element: Ints, position: Floats, force: Floats) -> Self:
        """Return forces (m, 2) at points (m, 2) within elements (m,)."""
        return cls(element, position, position, force)

    @classmethod
    def through(cls, *densities: Density) -> Self:
        """Return forces on the volume."""
        none = np.zeros((0, 2))
        return cls(np.zeros(0, dtype=np.int64), none, none, none, densities)

    @classmethod
    def on(cls, model: Model, place: Place, force: Floats) -> Self:
        """Return forces (m, 2) at the points of a place; of edges those on faces of cracks."""
        if place.edge is None or place.part is None:
            return cls.at(place.elements, place.position, force)
        kept = model.cut.boundary.crack[place.edge] >= 0
        start, end = np.moveaxis(place.part[kept], 1, 0)
        return cls(place.elements[kept], start, end, force[kept])

    def __len__(self) -> int:
        return len(self.element)

    def take(self, index: Ints | Bools) -> "Pushes":
        """Return some of those at places."""
        return Pushes(self.element[index], self.start[index], self.end[index], self.force[index])


def joined(parts: Iterable[Pushes]) -> Pushes:
    """Return all of several."""
    some = [Pushes.through(), *parts]
    element, start, end, force = (
        np.concatenate([getattr(one, name) for one in some])
        for name in ("element", "start", "end", "force")
    )
    densities = tuple(density for one in some for density in one.densities)
    return Pushes(element, start, end, force, densities)


PushesIn = Callable[[State], Pushes]
"""The forces in a state."""
