"""Tractions along edges and body forces that are fields of place and time; dead loads."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Self

import numpy as np

from integration.arrays import Bools, Floats, Ints
from integration.triangulation import triangulate
from nmm.assembly.applied_forces import AppliedForces, joined
from nmm.assembly.material_points import material_points
from nmm.assembly.model import Model
from nmm.assembly.places import Place, on_parts
from nmm.assembly.state import State
from nmm.effects.acting_place import edge_place
from nmm.effects.base import Effect, Instant, Setup
from nmm.effects.loading.field_instants import Instants
from nmm.effects.loading.fields import ValueField
from nmm.effects.loading.load_factor import load_factor
from nmm.effects.loading.resolved import cut_at, resolved, rule

if TYPE_CHECKING:
    from nmm.scene.tables.loading.loads import LoadTable

# Degree of the quadrature of a field times a displacement, beyond that of the displacement.
BEYOND_FUNCTIONS = 6
# Share of a load beyond which what its quadrature misses is told.
TOLD = 1e-3


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
    missed
        What its integrals may be off by, as a share of the load.
    """

    place: Place
    share: Floats
    field: ValueField
    factor: Callable[[Instant], float]
    steady: bool
    inside: Bools | None = None
    missed: float = 0.0

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
        instants: Instants | None = None,
    ) -> Self:
        """Return a field of body forces in input regions (N,); None for all.

        ``order`` is the degree of the quadrature; it resolves the field at ``instants``, if given.
        """
        manifold = model.manifold
        inside = np.ones(len(manifold.elements), dtype=bool)
        if regions is not None:
            inside = regions[manifold.element_region]
        triangles, element = triangulate(manifold.elements)
        triangles, element = triangles[inside[element]], element[inside[element]]
        missed = 0.0
        if instants is not None:
            found = resolved(triangles, order, field.sampled(instants.met))
            triangles, element = found.corners, element[found.owner]
            missed = max(found.left, instants.missed(field, triangles, order))
        points, weights = rule(triangles, order)
        owner, position = np.repeat(element, weights.shape[1]), points.reshape(-1, 2)
        share = weights.ravel() * model.thickness
        place = Place(material_points(manifold, owner, position), owner, share, position)
        return cls(place, share, field, factor, steady, inside, missed)


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
    def caution(self) -> str:
        """See `Effect.caution`: fields that vary faster than their quadrature tells."""
        worst = max(self.loads, key=lambda load: load.missed)
        if worst.missed <= TOLD:
            return ""
        return (
            f"the forces of {worst.field.what} may be off by {100 * worst.missed:.2g} %: its field "
            "jumps at places that move with time, or varies within less than a thousandth of where "
            'it acts; give smaller cells, or a load of kind = "moving" for what travels'
        )

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
    instants = Instants.of(setup, field)
    if load.segment is None:
        spread = SpreadLoad.over_volume(model, field, order, regions, factor, steady, instants)
    else:
        place, missed = _along_edges(edge_place(setup, "loads", load, order), setup, field, order)
        share = place.weight * model.thickness
        spread = SpreadLoad(place, share, field, factor, steady, missed=missed)
    field.checked(spread.place.position, setup)
    return spread


def _along_edges(place: Place, setup: Setup, field: ValueField, order: int) -> tuple[Place, float]:
    """Return Gauss points that resolve a field on the pieces of a place, and what they miss."""
    assert place.piece is not None
    assert place.edge is not None
    assert place.part is not None
    instants = Instants.of(setup, field)
    first = np.flatnonzero(np.diff(place.piece, prepend=-1))
    last = np.append(first[1:], len(place)) - 1
    pieces = np.stack([place.part[first, 0], place.part[last, 1]], axis=1)
    parts, piece = cut_at(pieces, field.knots(pieces))
    found = resolved(parts, order, field.sampled(instants.met))
    missed = max(found.left, instants.missed(field, found.corners, order))
    if len(found.corners) == len(pieces):
        return place, missed
    start, end = np.moveaxis(found.corners, 1, 0)
    edge = place.edge[first][piece[found.owner]]
    return on_parts(setup.model.manifold, edge, start, end, order), missed
