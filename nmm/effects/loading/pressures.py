"""Pressure on a surface: it turns with it, and grows where it stretches."""

from typing import TYPE_CHECKING, Self

from scipy.sparse import csc_array, csr_array

from integration.arrays import Floats
from nmm.assembly.applied_forces import AppliedForces, joined
from nmm.assembly.model import Model
from nmm.assembly.motion import State
from nmm.effects.acting_place import edge_place
from nmm.effects.base import Effect, Instant, Setup, Span, StepForce
from nmm.effects.load_factor import load_factor
from nmm.effects.loading.surface_pressure import PressedSurfaces, SurfacePressure, along_surface

if TYPE_CHECKING:
    from nmm.scene.tables.loading.loads import LoadTable


class SurfacePressures(Effect):
    """All pressures of a scene.

    A closed surface under an even pressure is in balance however it turns and bends. Where axes
    turn with bodies what is left of a turn in a step waits for the next solution; under finite
    strain all of it is in the deformation, and steps are solved for it. In small displacements
    surfaces stay as they were laid.
    """

    name = "pressures"

    def __init__(self, pressures: list[SurfacePressure], model: Model, bends: bool = False) -> None:
        self.pressures, self._model, self._bends = pressures, model, bends
        self._n = model.manifold.n_unknowns
        self._pressed = PressedSurfaces(tuple(pressures), self._n)
        self._parts = [csr_array((whole + whole.T) / 2) for whole in self._pressed.stiffness]
        self._kept: tuple[tuple[float, ...], csc_array] | None = None

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build from the ``[[loads]]`` of kind "pressure"."""
        found = [_pressure(setup, one) for one in setup.scene.loads if one.kind == "pressure"]
        return cls(found, setup.model, setup.kinematics.finite)

    @property
    def steady(self) -> bool:
        """See `Effect.steady`."""
        return all(one.steady for one in self.pressures)

    @property
    def nonlinear(self) -> bool:
        """See `Effect.nonlinear`."""
        return self._bends

    @property
    def symmetric(self) -> bool:
        """See `Effect.symmetric`: ends of open surfaces turn and store nothing."""
        return not any(one.follows for one in self.pressures)

    def step_force(self, before: State, after: State, span: Span) -> StepForce:
        """See `Effect.step_force`."""
        return self._pressed.step_force(before, after, span)

    def applied_forces(self, state: State) -> AppliedForces:
        """See `Effect.applied_forces`: those on faces of cracks."""
        now = Instant.of(state)
        parts = ((one.place, one.forces(state, now)) for one in self.pressures)
        return joined(AppliedForces.on(self._model, place, force) for place, force in parts)

    def force(self, state: State, end: Instant) -> Floats:
        """See `Effect.force`."""
        return self._pressed.force(state, end)

    def matrix(self, state: State) -> csc_array:
        """Return how the forces fall with the motion; the same object while the factors stay."""
        now = Instant.of(state)
        factors = tuple(one.factor(now) if one.follows else 0.0 for one in self.pressures)
        if self._kept is None or self._kept[0] != factors:
            none = csc_array((self._n, self._n))
            pairs = zip(factors, self._parts, strict=True)
            self._kept = factors, csc_array(sum((f * part for f, part in pairs), start=none))
        return self._kept[1]

    def forget(self) -> None:
        """See `Effect.forget`."""
        self._kept = None

    def work(self, before: State, after: State) -> float:
        """Mean of the forces at both ends times the way: exact, as they are linear in the place."""
        total = 0.0
        for one in self.pressures:
            first, last = (one.forces(state, Instant.of(state)) for state in (before, after))
            total += one.place.points.work(before, after, (first + last) / 2)
        return total


def _pressure(setup: Setup, load: "LoadTable") -> SurfacePressure:
    assert load.pressure is not None
    # As many points on a piece as functions along it.
    order = 2 * max(setup.model.manifold.degree, 1) + 1
    place = edge_place(setup, "loads", load, order)
    size, factor = load.pressure * setup.model.thickness, load_factor(setup, load)
    given = load.name, place, along_surface(place), size, factor, load.history is None
    return SurfacePressure(*given, follows=not setup.small)
