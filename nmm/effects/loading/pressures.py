"""The effect: follower pressure on surfaces, which turns and stretches with them."""

from typing import TYPE_CHECKING, Self

from scipy.sparse import csc_array, csr_array

from integration.arrays import Floats
from nmm.assembly.applied_forces import AppliedForces, joined
from nmm.assembly.model import Model
from nmm.assembly.state import State
from nmm.effects.acting_place import edge_place, traction_order
from nmm.effects.base import Effect, Instant, Setup, Span, StepForce
from nmm.effects.loading.load_factor import load_factor
from nmm.effects.loading.surface_pressure import PressedSurfaces, SurfacePressure, along_surface

if TYPE_CHECKING:
    from nmm.scene.tables.loading.loads import LoadTable


class SurfacePressures(Effect):
    """All pressures of a scene.

    A uniform pressure on a closed surface is self-equilibrated in any deformation. Where axes turn
    with bodies, the load stiffness is that of the start of the step; in finite strain the step is
    solved for the force. In small displacements surfaces keep their reference configuration.
    """

    name = "pressures"

    def __init__(
        self, pressures: list[SurfacePressure], model: Model, finite: bool = False
    ) -> None:
        self.pressures, self._model, self._finite = pressures, model, finite
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
        return all(one.steady for one in self.pressures)

    @property
    def nonlinear(self) -> bool:
        return self._finite

    @property
    def symmetric(self) -> bool:
        """See `Effect.symmetric`: false for open surfaces, whose ends give unsymmetric terms."""
        return not any(one.follows for one in self.pressures)

    def step_force(self, before: State, after: State, span: Span) -> StepForce:
        return self._pressed.step_force(before, after, span)

    def applied_forces(self, state: State) -> AppliedForces:
        """See `Effect.applied_forces`: those on crack faces."""
        now = Instant.of(state)
        felt = (one for one in self.pressures if AppliedForces.counts(self._model, one.place))
        parts = ((one.place, one.forces(state, now)) for one in felt)
        return joined(AppliedForces.on(self._model, place, force) for place, force in parts)

    def force(self, state: State, end: Instant) -> Floats:
        return self._pressed.force(state, end)

    def matrix(self, state: State) -> csc_array:
        """Return the symmetric load stiffness (n, n); the same object for the same factors."""
        now = Instant.of(state)
        factors = tuple(one.factor(now) if one.follows else 0.0 for one in self.pressures)
        if self._kept is None or self._kept[0] != factors:
            none = csc_array((self._n, self._n))
            pairs = zip(factors, self._parts, strict=True)
            self._kept = factors, csc_array(sum((f * part for f, part in pairs), start=none))
        return self._kept[1]

    def forget(self) -> None:
        self._kept = None

    def work(self, before: State, after: State) -> float:
        """Work (J) of the mean of both ends: exact for forces that are linear in the places."""
        total = 0.0
        for one in self.pressures:
            first, last = (one.forces(state, Instant.of(state)) for state in (before, after))
            total += one.place.points.work(before, after, (first + last) / 2)
        return total


def _pressure(setup: Setup, load: "LoadTable") -> SurfacePressure:
    assert load.pressure is not None
    # As many points on a part as the displacement has functions along it.
    order = traction_order(setup, 2 * max(setup.model.manifold.degree, 1) + 1)
    place = edge_place(setup, "loads", load, order)
    size, factor = load.pressure * setup.model.thickness, load_factor(setup, load)
    given = load.name, place, along_surface(place), size, factor, load.history is None
    return SurfacePressure(*given, follows=not setup.small)
