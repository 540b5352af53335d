"""The effect: temperature in the course of a run, and what it does to the blocks.

Temperature acts on displacements and is not acted upon: places and openings are those of the
reference place.
"""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Self

import numpy as np

from covers.scalar.space import ScalarSpace
from integration.arrays import Floats, Ints
from nmm.assembly.motion import State
from nmm.diffusion.carried_field import carried_field
from nmm.diffusion.course import Course, FieldAt
from nmm.diffusion.from_scene import of_elements
from nmm.diffusion.matrices import element_slopes
from nmm.effects.base import Effect, Instant, Setup
from nmm.errors import Fault, SceneError
from nmm.formulation import Diffusion
from nmm.heat.from_scene import heat_problem
from nmm.heat.thermal_strain import ThermalStrain
from nmm.quantity import Quantity

if TYPE_CHECKING:
    from nmm.effects.change import Change


class Heat(Effect):
    """Temperature of the blocks."""

    name = "heat"
    external = False

    def __init__(
        self,
        course: Course,
        strain: ThermalStrain | None,
        conductivity: Floats,
        reference: float = 0.0,
        second: float = 1.0,
    ) -> None:
        self.course, self.strain = course, strain
        self._conductivity, self._reference = conductivity, reference
        # Seconds of heat in a unit of the run's time: statics counts its time by the load factor.
        self._second = second

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build from ``[heat]`` and the tables of what heats and cools."""
        table, asked = setup.scene.heat, setup.formulation.diffusion or Diffusion()
        assert table is not None
        space = ScalarSpace.of(setup.model.manifold)
        problem, start = heat_problem(setup, space), None
        second = 1.0 if table.duration is None else table.duration
        if table.transient:
            initial = 0.0 if table.initial is None else table.initial - table.reference
            time = setup.start.time * second
            unknowns = np.where(problem.free, initial * space.one, problem.held(time))
            start = FieldAt(time, unknowns, {})
        course = Course(problem, start, asked.theta, asked.step)
        conductivity = of_elements(setup, "conductivity")
        return cls(course, _strain(setup, space), conductivity, table.reference, second)

    @property
    def space(self) -> ScalarSpace:
        """Functions of the temperature."""
        return self.course.problem.space

    @property
    def about(self) -> str:
        """See `Effect.about`."""
        how = "steady" if self.course.steady else "transient"
        return f"{how}, {self.space.n} unknowns"

    @property
    def steady(self) -> bool:
        """See `Effect.steady`."""
        return False

    def rise(self, time: float) -> Floats:
        """Unknowns (n,) of the temperature above the reference, at a time of the run."""
        return self.course.at(time * self._second).unknowns

    def force(self, state: State, end: Instant) -> Floats:
        """Return the force of the thermal strain at the end of the step."""
        if end.time > state.time:
            self.course.begin(state.time * self._second)
        unknowns = self.rise(end.time)
        if self.strain is None:
            return np.zeros(len(state.deformation))
        return np.asarray(self.strain.coupling @ unknowns)

    def stress_at(self, elements: Ints, points: Floats, time: float) -> Floats:
        """See `Effect.stress_at`."""
        if self.strain is None:
            return np.zeros((len(elements), 3))
        return self.strain.at(self.rise(time), elements, points)

    def mean_stress(self, state: State) -> Floats:
        """See `Effect.mean_stress`."""
        if self.strain is None:
            return np.zeros((len(self._conductivity), 3))
        mean = self.strain.means @ self.rise(state.time)
        return np.asarray(-mean[:, None] * self.strain.stress)

    def energy(self, state: State) -> float:
        """Energy (J) of the elastic strain beyond that of the whole strain, ``1/2 e : D e``."""
        if self.strain is None:
            return 0.0
        rise = self.rise(state.time)
        push = self.strain.coupling @ rise
        return float(rise @ (self.strain.held @ rise)) / 2 - float(push @ state.deformation)

    def work(self, before: State, after: State) -> float:
        """Work (J) of the stress on minus the thermal strain, by the mean of both ends."""
        if self.strain is None:
            return 0.0
        first, last = self.rise(before.time), self.rise(after.time)
        held = self.strain.held
        stored = float(last @ (held @ last) - first @ (held @ first)) / 2
        push = self.strain.coupling @ (last - first)
        return stored - float(push @ (before.deformation + after.deformation)) / 2

    def outputs(self, state: State) -> Mapping[str, Quantity]:
        """Return temperature at the vertices, and the mean flux of elements."""
        rise = self.rise(state.time)
        slopes = np.stack([rows @ rise for rows in element_slopes(self.space)], axis=1)
        flux = state.frames.to_global(
            self.space.manifold.element_body, -self._conductivity[:, None] * slopes
        )
        return {
            "temperature": Quantity("points", self._reference + self.space.vertices @ rise, "K"),
            "flux": Quantity("elements", flux, "W/m^2"),
        }

    def history(self, state: State) -> Mapping[str, float]:
        """Return extremes, and what was taken up: heat in J since the start, or power in W."""
        here = self.course.at(state.time * self._second)
        values = self._reference + self.space.vertices @ here.unknowns
        found = {"lowest": float(values.min()), "highest": float(values.max())}
        found |= {f"taken:{name}": amount for name, amount in here.taken.items()}
        return found if self.course.steady else {**found, "stored": here.stored}

    def imbalance(self, state: State) -> float:
        """See `Effect.imbalance`."""
        return self.course.at(state.time * self._second).imbalance

    def carried(self) -> Any:
        """See `Effect.carried`."""
        return self.course.carried()

    def carry(self, carried: Any) -> None:
        """See `Effect.carry`."""
        self.course.carry(carried)

    def forget(self) -> None:
        """See `Effect.forget`."""
        self.course.problem.forget()
        if self.strain is not None:
            self.strain.forget()

    def follow(self, change: "Change") -> "Heat":
        """Return heat on the new model; blocks that are new have the initial temperature."""
        new = type(self).from_setup(change.setup)
        if new.course.steady:
            return new
        time = change.state.time * new._second
        here, start = self.course.at(time), new.course.at(time)
        unknowns = carried_field(
            change.parentage, (self.space, new.space), here.unknowns, start.unknowns
        )
        new.course.go_on_from(FieldAt(time, unknowns, here.taken, here.stored))
        return new


def _strain(setup: Setup, space: ScalarSpace) -> ThermalStrain | None:
    """Return what temperature does to the blocks; None where no material expands.

    Raises
    ------
    SceneError
        A material that is not linear, or volumes that are projected.
    """
    scene, model = setup.scene, setup.model
    if not any(item.thermal_expansion for item in scene.materials.values()):
        return None
    for number, (name, item) in enumerate(scene.materials.items()):  # a handful of materials
        if item.thermal_expansion and model.laws and not model.laws[number].linear:
            place = scene.source.place("materials", name, "thermal_expansion")
            found, expected = f'with law "{item.law}"', "a linear law"
            raise SceneError(Fault(place, found, expected, 'use law = "elastic", or remove it'))
    if model.projected and model.pressures is not None:
        place = setup.formulation.source.place("cover", "volumetric")
        found, expected = '"projected" with thermal expansion', '"full"'
        raise SceneError(Fault(place, found, expected, "use degree 1 or 2"))
    expansion = of_elements(setup, "thermal_expansion")
    if scene.plane == "strain":
        expansion = expansion * (1 + of_elements(setup, "poisson_ratio"))
    return ThermalStrain(space, model, expansion)
