"""Tractions along edges and body forces that are fields of place and time; dead loads."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Self

import numpy as np

from integration.arrays import Bools, Floats, Ints
from integration.rules import polygon_rule
from nmm.assembly.applied_forces import AppliedForces, joined
from nmm.assembly.material_points import material_points
from nmm.assembly.model import Model
from nmm.assembly.places import Place
from nmm.assembly.state import State
from nmm.effects.acting_place import edge_place
from nmm.effects.base import Effect, Instant, Setup
from nmm.effects.loading.fields import ValueField
from nmm.effects.loading.load_factor import load_factor

if TYPE_CHECKING:
    from nmm.scene.tables.loading.loads import LoadTable

# Degree of the quadrature of a field times a displacement, beyond that of the displacement.
BEYOND_FUNCTIONS = 6


@dataclass(frozen=True)
class SpreadLoad:
    """A field of tractions or body forces at quadrature points.

    Attributes
    ----------
    place, share
        The m points, and the area (m2) or volume (m3) of each (m,).
    field, factor
        Force over area (Pa) or volume (N/m3), and the load factor.
    steady
        Whether both are constant in time.
    inside
        (E,) which elements it acts in; None along edges.
    """

    place: Place
    share: Floats
    field: ValueField
    factor: Callable[[Instant], float]
    steady: bool
    inside: Bools | None = None

    def forces(self, end: Instant) -> Floats:
        """Forces (m, 2) on the points at an instant, in global axes (N)."""
        values = self.field.values(self.place.position, end.time)
        return np.asarray(self.factor(end) * self.share[:, None] * values)

    def applied_forces(self, model: Model, end: Instant) -> AppliedForces:
        """See `Effect.applied_forces`, at an instant."""
        inside = self.inside
        if inside is None:
            return AppliedForces.on(model, self.place, self.forces(end))

        def density(elements: Ints, points: Floats) -> Floats:
            values = self.field.values(points, end.time)
            return np.asarray(self.factor(end) * inside[elements, None] * values)

        return AppliedForces.of_densities(density)

    @classmethod
    def over_volume(
        cls,
        model: Model,
        field: ValueField,
        order: int,
        regions: Bools | None = None,
        factor: Callable[[Instant], float] = lambda end: 1.0,
        steady: bool = True,
    ) -> Self:
        """Return a field of body forces in input regions (N,); None for all.

        ``order`` is the degree of the quadrature.
        """
        manifold = model.manifold
        rule = polygon_rule(manifold.elements, order)
        inside = np.ones(len(manifold.elements), dtype=bool)
        if regions is not None:
            inside = regions[manifold.element_region]
        kept = inside[rule.owner]
        owner, position = rule.owner[kept], rule.points[kept]
        share = rule.weights[kept] * model.thickness
        place = Place(material_points(manifold, owner, position), owner, share, position)
        return cls(place, share, field, factor, steady, inside)


class FieldLoads(Effect):
    """All loads of a scene that are given by fields: dead loads."""

    name = "field loads"

    def __init__(self, loads: list[SpreadLoad], model: Model) -> None:
        self.loads, self._model = loads, model

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build from the ``[[loads]]`` with a field."""
        found = [_load(setup, one) for one in setup.scene.loads if one.field is not None]
        return cls(found, setup.model)

    @property
    def dead(self) -> bool:
        return True

    @property
    def steady(self) -> bool:
        return all(load.steady for load in self.loads)

    def force(self, state: State, end: Instant) -> Floats:
        """Return the load vector (n,) in the axes of the bodies."""
        total = np.zeros(len(state.deformation))
        for load in self.loads:  # a handful of loads
            total += load.place.points.push(state, load.forces(end))
        return total

    def work(self, before: State, after: State) -> float:
        """Work (J) of the mean of the loads at both ends of the step."""
        total = 0.0
        for load in self.loads:
            first, last = (load.forces(Instant.of(state)) for state in (before, after))
            total += load.place.points.work(before, after, (first + last) / 2)
        return total

    def applied_forces(self, state: State) -> AppliedForces:
        now = Instant.of(state)
        return joined(load.applied_forces(self._model, now) for load in self.loads)


def _load(setup: Setup, load: "LoadTable") -> SpreadLoad:
    assert load.field is not None
    model, regions = setup.model, setup.regions(load.block)
    order = model.manifold.degree + BEYOND_FUNCTIONS
    field = ValueField.named(setup, load.field, f"[[loads]] {load.name}")
    steady = load.history is None and not field.varies
    factor = load_factor(setup, load)
    if load.segment is None:
        spread = SpreadLoad.over_volume(model, field, order, regions, factor, steady)
    else:
        place = edge_place(setup, "loads", load, order)
        spread = SpreadLoad(place, place.weight * model.thickness, field, factor, steady)
    field.checked(spread.place.position, setup)
    return spread
