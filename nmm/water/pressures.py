"""The effect: given water pressures on edges, on faces of joints and cracks, or around blocks.

Pressure and normal are those of the reference configuration and turn with the body, so that the
force is constant in its axes. Edges are divided where the pressure has a kink, at the water table,
and integrated exactly, beside crack tips to 2e-5.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Self

import numpy as np

from integration.arrays import Floats, Ints
from nmm.assembly.applied_forces import AppliedForces, joined
from nmm.assembly.model import Model
from nmm.assembly.places import Place, on_parts
from nmm.assembly.state import State
from nmm.effects.acted.acted_parts import acted_edge_parts
from nmm.effects.acting_place import traction_order
from nmm.effects.base import Effect, Instant, Setup, Span, StepForce
from nmm.effects.loading.load_factor import load_factor
from nmm.errors import Fault, SceneError
from nmm.geometry.places import EdgeParts
from nmm.water.head import Pressure, pressure_of

if TYPE_CHECKING:
    from nmm.effects.loading.surface_pressure import PressedSurfaces, SurfacePressure
    from nmm.scene.tables.water import WaterPressureTable

# Parts shorter than this share of an edge are rounding.
SHORT = 1e-12


@dataclass(frozen=True)
class WaterOnEdges:
    """Water pressure on quadrature points of edges.

    Attributes
    ----------
    name
        Name in the scene.
    place
        Gauss points.
    force
        (m, 2) force on each point at factor 1, in the axes of its body (N).
    unknown
        (n,) load vector at factor 1.
    factor
        Load factor as a function of the instant.
    steady
        Whether it is constant in time.
    surface
        Follower pressure in finite strain; else None.
    """

    name: str
    place: Place
    force: Floats
    unknown: Floats
    factor: Callable[[Instant], float]
    steady: bool
    surface: "SurfacePressure | None" = None

    def forces(self, state: State, end: Instant) -> Floats:
        """Forces (m, 2) in global axes (N)."""
        if self.surface is not None:
            return self.surface.forces(state, end)
        turned = state.frames.to_global(self.place.points.body, self.force)
        return np.asarray(self.factor(end) * turned)


class WaterPressures(Effect):
    """All given water pressures of a scene."""

    name = "water pressures"

    def __init__(self, given: list[WaterOnEdges], model: Model) -> None:
        self.given, self._model = given, model
        self._n = model.manifold.n_unknowns
        surfaces = [one.surface for one in given if one.surface is not None]
        self._surfaces = _pressed(surfaces, self._n) if surfaces else None

    @classmethod
    def beyond_strain(cls) -> bool:
        """See `Effect.beyond_strain`: water presses on faces."""
        return True

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build from the ``[[water_pressures]]``."""
        found = [_water(setup, item) for item in setup.scene.water_pressures]
        return cls(found, setup.model)

    @property
    def steady(self) -> bool:
        return all(one.steady for one in self.given)

    @property
    def nonlinear(self) -> bool:
        """See `Effect.nonlinear`: true in finite strain."""
        return self._surfaces is not None

    @property
    def symmetric(self) -> bool:
        return self._surfaces is None

    def step_force(self, before: State, after: State, span: Span) -> StepForce:
        assert self._surfaces is not None
        return self._surfaces.step_force(before, after, span)

    def applied_forces(self, state: State) -> AppliedForces:
        """See `Effect.applied_forces`: those on crack faces."""
        now = Instant.of(state)
        felt = (one for one in self.given if AppliedForces.counts(self._model, one.place))
        pairs = ((one.place, one.forces(state, now)) for one in felt)
        return joined(AppliedForces.on(self._model, place, force) for place, force in pairs)

    def force(self, state: State, end: Instant) -> Floats:
        """Return the load vector (n,) in the axes of the bodies."""
        if self._surfaces is not None:
            return self._surfaces.force(state, end)
        total = np.zeros(self._n)
        for one in self.given:  # a handful
            total += one.factor(end) * one.unknown
        return total

    def work(self, before: State, after: State) -> float:
        """Work (J) of the mean of the forces at both ends of the step."""
        total = 0.0
        for one in self.given:  # a handful
            first, last = (one.forces(state, Instant.of(state)) for state in (before, after))
            total += one.place.points.work(before, after, (first + last) / 2)
        return total

    def history(self, state: State) -> Mapping[str, float]:
        """Return the resultant of each (N)."""
        now, found = Instant.of(state), {}
        for one in self.given:  # a handful
            total = one.forces(state, now).sum(axis=0)
            found[f"{one.name}:x"], found[f"{one.name}:y"] = float(total[0]), float(total[1])
        return found


def _water(setup: Setup, item: "WaterPressureTable") -> WaterOnEdges:
    manifold, pressure = setup.model.manifold, pressure_of(item, setup.origin)
    edge, start, end = _divided(acted_edge_parts(setup, item), pressure)
    if not len(edge):
        where = setup.scene.source.of_name("water_pressures", item.name)
        found = str(item.segment or item.crack or item.block)
        raise SceneError(Fault(where, found, "an edge of a block", "move it onto one"))
    finite = setup.kinematics.finite
    order = 2 * max(manifold.degree, 1) + 3 if finite else manifold.degree + 1
    place = on_parts(manifold, edge, start, end, traction_order(setup, order))
    assert place.normal is not None
    there = pressure.pressure(place.position)
    size = there * place.weight * setup.model.thickness
    force = -size[:, None] * place.normal
    unknown = place.points.rows.spread(force, manifold.n_unknowns)
    factor = load_factor(setup, item)
    steady = item.history is None
    water = WaterOnEdges(item.name, place, force, unknown, factor, steady)
    return replace(water, surface=_surface(setup, water, there)) if finite else water


def _surface(setup: Setup, water: WaterOnEdges, pressure: Floats) -> "SurfacePressure":
    """Return the follower pressure of pressures (m,) (Pa) at the points of edges."""
    from nmm.effects.loading.surface_pressure import SurfacePressure, along_surface

    slopes = along_surface(water.place)
    varies = pressure.reshape(slopes.shape[:2])[:, :, None] * slopes
    thickness = setup.model.thickness
    return SurfacePressure(water.name, water.place, varies, thickness, water.factor, water.steady)


def _pressed(surfaces: "list[SurfacePressure]", n: int) -> "PressedSurfaces":
    from nmm.effects.loading.surface_pressure import PressedSurfaces

    return PressedSurfaces(tuple(surfaces), n)


def _divided(parts: EdgeParts, pressure: Pressure) -> tuple[Ints, Floats, Floats]:
    """Divide parts of edges where the pressure has a kink."""
    edge, start, end = parts.edge, parts.start, parts.end
    shares = [pressure.crossings(a, b) for a, b in zip(start, end, strict=True)]
    whole = np.repeat(np.arange(len(edge)), [len(one) - 1 for one in shares])
    low = np.concatenate([[], *(one[:-1] for one in shares)])
    high = np.concatenate([[], *(one[1:] for one in shares)])
    kept = high - low > SHORT
    whole, low, high = whole[kept], low[kept, None], high[kept, None]
    way = end[whole] - start[whole]
    return edge[whole], start[whole] + low * way, start[whole] + high * way
