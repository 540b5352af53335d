"""The effect: temperature of the blocks during a run, and thermal strain."""

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Self

from covers.scalar.space import ScalarSpace
from integration.arrays import Floats
from nmm.assembly.kept import kept_of_object
from nmm.assembly.laws_at_points import SWELLING
from nmm.assembly.matter import Matter
from nmm.assembly.state import State
from nmm.assembly.weakly import weakly
from nmm.diffusion.course import FieldCourse
from nmm.diffusion.field_effect import FieldEffect, course_of
from nmm.diffusion.from_scene import conductivities, of_elements
from nmm.effects.base import Instant, Setup
from nmm.errors import Fault, SceneError
from nmm.heat.from_scene import heat_problem
from nmm.heat.thermal_strain import ThermalStrain
from nmm.quantity import Quantity

if TYPE_CHECKING:
    from nmm.effects.initial.turning_stress import TurningStress

COLD, AIR = 100.0, (200.0, 400.0)
"""Temperature (K) below which a value is probably a difference, and the range of air and rock."""


class Heat(FieldEffect):
    """Temperature of the blocks."""

    name = "heat"
    _turned: "TurningStress | None" = None

    def __init__(
        self,
        course: FieldCourse,
        strain: ThermalStrain | None,
        conductivity: Floats,
        reference: float = 0.0,
        second: float = 1.0,
        finite: bool = False,
        given: tuple[float, ...] = (),
        at_once: bool = False,
    ) -> None:
        super().__init__(course, strain, conductivity, second)
        self.strain, self._reference, self._given = strain, reference, given
        self._at_once = at_once
        if finite and strain is not None:
            from nmm.effects.initial.turning_stress import TurningStress

            self._turned = TurningStress.of(strain.model, weakly(self.stress_at))

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build from ``[heat]`` and the tables of temperatures, fluxes, sources and convection."""
        table = setup.scene.heat
        assert table is not None
        space = ScalarSpace.of(setup.model.manifold)
        problem, initial = heat_problem(setup, space), None
        second = 1.0 if table.duration is None else table.duration
        if table.transient:
            rise = 0.0 if table.initial is None else table.initial - table.reference
            initial = rise * space.one
        course = course_of(setup, problem, initial, second)
        conductivity = conductivities(setup, "conductivity")
        finite = setup.kinematics.finite
        given = (
            *(one.temperature for one in setup.scene.temperatures),
            *(one.temperature for one in setup.scene.convections),
            *([] if table.initial is None else [table.initial]),
        )
        strain = _strain(setup, space)
        first = setup.scene.stages[0] if setup.scene.stages else setup.scene
        moves = setup.scene.inertia is not None and first.duration is not None
        return cls(course, strain, conductivity, table.reference, second, finite, given, moves)

    @property
    def caution(self) -> str:
        """See `Effect.caution`: temperatures of air beside a reference near 0 K."""
        lowest, highest = (end((self._reference, *self._given)) for end in (min, max))
        if self.strain is None or lowest >= COLD or not AIR[0] <= highest <= AIR[1]:
            return ""
        return (
            f"temperatures from {lowest:g} to {highest:g} K, free of strain at "
            f"{self._reference:g} K: numbers are in K, and so is a reference that is not given, "
            '0 K; write all with their unit, as reference = "20 degC"'
        )

    @property
    def turns_with_bodies(self) -> str:
        """See `Effect.turns_with_bodies`: nothing, as its stress turns with the material."""
        return ""

    def begin(self, state: State) -> State:
        """See `Effect.begin`: in dynamics heat acts at once, on material at rest under it."""
        matter = None if self.strain is None else self.strain.model.matter
        if not (self._at_once and self.strain is not None and isinstance(matter, Matter)):
            return state
        swelling = self.strain.swelling(self.acting(state.time))
        assert swelling is not None
        heated = {**state.history, SWELLING: swelling[:, None]}
        return replace(state, history=matter.update(state.deformation, heated, 0.0).history)

    def swelling(self, state: State, end: Instant) -> Floats | None:
        if self.strain is None:
            return None
        self._begin(state, end)
        return self.strain.swelling(self.acting(end.time))

    def energy(self, state: State) -> float:
        """Energy (J) of the elastic strain minus that of the total strain, ``1/2 e : D e``."""
        if self.strain is None:
            return 0.0
        rise = self.acting(state.time)
        stored = self.strain.energy(rise)
        if self._turned is not None:
            return stored + self._turned.energy(state)
        return stored - float(self.strain.force(rise) @ state.deformation)

    def work(self, before: State, after: State) -> float:
        """Work (J) of the stress on minus the thermal strain, by the mean of both ends."""
        if self.strain is None:
            return 0.0
        first, last = self.acting(before.time), self.acting(after.time)
        if last is first and self.strain.points is None:
            return 0.0
        stored = self.strain.energy(last) - self.strain.energy(first)
        if self._turned is not None:
            return stored + self._turned.work(before, after)
        if self.strain.points is not None:
            stored -= self.strain.model.swollen(before, after)
        push = self.strain.force(last) - self.strain.force(first)
        return stored - float(push @ (before.deformation + after.deformation)) / 2

    def outputs(self, state: State) -> Mapping[str, Quantity]:
        """Return the temperature at vertices and the mean flux of elements."""
        values = self._values(state)
        return {
            "temperature": Quantity("points", values, "K"),
            "flux": Quantity("elements", self.flux(state), "W/m^2"),
        }

    def history(self, state: State) -> Mapping[str, float]:
        """Return extreme temperatures (K), and heat taken up: J since the start, or W if steady."""
        values = self._values(state)
        extremes = {"lowest": float(values.min()), "highest": float(values.max())}
        return {**extremes, **self.amounts(state)}

    def _values(self, state: State) -> Floats:
        return self._at_vertices(self.acting(state.time))

    @kept_of_object
    def _at_vertices(self, rise: Floats) -> Floats:
        """Temperature at the vertices."""
        return self._reference + self.space.vertices @ rise


def _strain(setup: Setup, space: ScalarSpace) -> ThermalStrain | None:
    """Return the thermal strain; None if no material expands.

    Raises
    ------
    SceneError
        The law of a material does not support it, or volumes are projected.
    """
    scene, model = setup.scene, setup.model
    if not any(item.thermal_expansion for item in scene.materials.values()):
        return None
    for number, (name, item) in enumerate(scene.materials.items()):  # a handful of materials
        law = model.laws[number] if model.laws else None
        if item.thermal_expansion and law is not None and not (law.linear or law.swells):
            place = scene.source.place("materials", name, "thermal_expansion")
            found, expected = f'with law "{item.law}"', "a law that knows of it (`Law.swells`)"
            raise SceneError(Fault(place, found, expected, 'use law = "elastic", or remove it'))
    if model.projected and model.pressures is not None:
        place = setup.formulation.source.place("cover", "volumetric")
        found, expected = '"projected" with thermal expansion', '"full"'
        raise SceneError(Fault(place, found, expected, "use degree 1 or 2"))
    return ThermalStrain.of(space, model, of_elements(setup, "thermal_expansion"))
