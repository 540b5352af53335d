"""Forces that effects apply to the material, as the integrals about crack tips need them."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Self

import numpy as np

from integration.arrays import Bools, Floats, Ints
from nmm.assembly.model import Model
from nmm.assembly.places import Place
from nmm.assembly.state import State
from nmm.frozen import with_parts

Density = Callable[[Ints, Floats], Floats]


@dataclass(frozen=True)
class AppliedForces:
    """Forces within bodies and on crack faces; not those on the rest of the boundary.

    Attributes
    ----------
    element
        (m,) elements on which they act.
    start, end
        (m, 2) ends of the part of a face over which each is spread evenly, in the reference
        configuration (m); the same place twice for a point force.
    force
        (m, 2) forces in global axes (N).
    densities
        Body forces: functions of elements (m,) and points (m, 2) that return densities (m, 2) in
        global axes (N/m3).
    accelerations
        Unknowns (n,) of accelerations against which the mass resists (m/s2).
    strains
        Unknowns (n,) of displacements whose elastic stress acts beside that of the strain (m).
    """

    element: Ints
    start: Floats
    end: Floats
    force: Floats
    densities: tuple[Density, ...] = ()
    accelerations: tuple[Floats, ...] = ()
    strains: tuple[Floats, ...] = ()

    @classmethod
    def at(cls, element: Ints, position: Floats, force: Floats) -> Self:
        """Return point forces (m, 2) at points (m, 2) of elements (m,)."""
        return cls(element, position, position, force)

    @classmethod
    def of_densities(cls, *densities: Density) -> Self:
        """Return body forces alone."""
        none = np.zeros((0, 2))
        return cls(np.zeros(0, dtype=np.int64), none, none, none, densities)

    @classmethod
    def of_acceleration(cls, acceleration: Floats) -> Self:
        """Return the inertia of an acceleration, unknowns (n,) in body axes, alone."""
        return with_parts(cls.of_densities(), accelerations=(acceleration,))

    @classmethod
    def of_strain(cls, displacement: Floats) -> Self:
        """Return the elastic stress of a displacement, unknowns (n,) in body axes, alone."""
        return with_parts(cls.of_densities(), strains=(displacement,))

    @classmethod
    def on(cls, model: Model, place: Place, force: Floats) -> Self:
        """Return forces (m, 2) at the points of a place; of edges, only those on crack faces."""
        if place.edge is None or place.part is None:
            return cls.at(place.elements, place.position, force)
        kept = model.cut.boundary.crack[place.edge] >= 0
        start, end = np.moveaxis(place.part[kept], 1, 0)
        return cls(place.elements[kept], start, end, force[kept])

    def __len__(self) -> int:
        return len(self.element)

    @staticmethod
    def counts(model: Model, place: Place) -> bool:
        """Whether forces at a place count: within bodies, or on crack faces."""
        if place.edge is None or place.part is None:
            return True
        return bool((model.cut.boundary.crack[place.edge] >= 0).any())

    def take(self, index: Ints | Bools) -> "AppliedForces":
        """Return the selected point forces, without body forces."""
        return AppliedForces(
            self.element[index], self.start[index], self.end[index], self.force[index]
        )


def joined(parts: Iterable[AppliedForces]) -> AppliedForces:
    """Return the forces of several."""
    some = list(parts)
    felt = [one for one in some if len(one)] or [AppliedForces.of_densities()]
    element, start, end, force = (
        np.concatenate([getattr(one, name) for one in felt])
        for name in ("element", "start", "end", "force")
    )
    densities = tuple(density for one in some for density in one.densities)
    accelerations = tuple(field for one in some for field in one.accelerations)
    strains = tuple(field for one in some for field in one.strains)
    return AppliedForces(element, start, end, force, densities, accelerations, strains)


AppliedForcesIn = Callable[[State], AppliedForces]
"""A function that returns the forces in a state."""
