"""Water in the pores of blocks, and its pressure in effective stress.

With Darcy's law the head ``h`` obeys ``S dh/dt = div (k grad h)``; the pressure of the pores
``p = w (h - y)``, ``w`` the weight of water, takes ``b p`` from the total normal stresses
(Terzaghi 1936; Biot 1941 for ``b``), and a share of it in plane stress
(`nmm.materials.base.Law.pore_share`). What pores gain by strain `nmm.water.consolidation` adds.
"""

from collections.abc import Mapping
from functools import partial
from typing import TYPE_CHECKING, Self

import numpy as np

from covers.scalar.space import ScalarSpace
from integration.arrays import Bools, Floats, Ints
from nmm.assembly.motion import State
from nmm.assembly.places import Place
from nmm.diffusion.course import FieldCourse
from nmm.diffusion.field_effect import FieldEffect, course_of
from nmm.diffusion.field_stress import FieldStress
from nmm.diffusion.from_scene import (
    FieldTables,
    GivenTable,
    Values,
    field_problem,
    fitted,
    of_elements,
    sloping,
)
from nmm.diffusion.problem import DiffusionProblem
from nmm.effects.base import Instant, Setup
from nmm.errors import Fault, FormulationError, SceneError
from nmm.quantity import Quantity

if TYPE_CHECKING:
    from nmm.scene.tables.seepage import HeadTable
    from nmm.water.free_surface import Filling, FreeSurface
    from nmm.water.pore_stress import PoreStress

LOOSE = ("seepage", "head", "add [[heads]], or transient = true")


class PoreWater(FieldEffect):
    """Head of the water in the pores; ``ground`` (n,) are the unknowns of the height y itself."""

    _turned: "PoreStress | None" = None

    def __init__(
        self,
        course: FieldCourse,
        stress: FieldStress,
        conductivity: Floats,
        ground: Floats,
        weight: float,
        second: float = 1.0,
        filling: "Filling | None" = None,
        bends: bool = False,
    ) -> None:
        super().__init__(course, stress, conductivity, second)
        self._ground, self._weight, self._filling = ground, weight, filling
        if bends:
            from nmm.assembly.finite_strain.finite_matter import finite_matter
            from nmm.water.pore_stress import PoreStress

            self._turned = PoreStress(finite_matter(stress.model), self.stress_at)

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build from ``[seepage]``, ``[[heads]]`` and ``[[inflows]]``."""
        table = setup.scene.seepage
        assert table is not None
        space = ScalarSpace.of(setup.model.manifold)
        filling = _filling(setup, space) if table.free_surface else None
        problem, initial = _problem(setup, space, filling), None
        everything: Bools = np.ones(space.n, dtype=bool)
        second = 1.0 if table.duration is None else table.duration
        if table.initial is not None:
            level = table.initial - setup.origin[1]
            initial = level * space.one
            if filling is not None:
                initial = fitted(setup, space, everything, partial(filling.at_rest, level))
        ground = fitted(setup, space, everything, lambda points: points[:, 1])
        stress = FieldStress(space, setup.model, _pore_stress(setup))
        course = course_of(setup, problem, initial, second)
        conductivity = of_elements(setup, "hydraulic_conductivity")
        weight = table.unit_weight
        bends = _bends(setup)
        return cls(course, stress, conductivity, ground, weight, second, filling, bends)

    @property
    def turns_with_bodies(self) -> str:
        """See `Effect.turns_with_bodies`: the pressure follows the material in plane strain."""
        return "" if self._turned is not None else super().turns_with_bodies

    def acting(self, time: float) -> Floats:
        """Unknowns (n,) of the pressure (Pa)."""
        return self._weight * (self.here(time).unknowns - self._ground)

    def pore_pressure_at(self, elements: Ints, points: Floats, time: float) -> Floats:
        """See `Effect.pore_pressure_at`."""
        return np.asarray(self.space.values(elements, points) @ self.acting(time))

    def work(self, before: State, after: State) -> float:
        """Work (J) of the pressure on the strain of the blocks, by the mean of both ends."""
        if self._turned is not None:
            return self._turned.work(before, after)
        ends = (self.force(one, Instant.of(one)) for one in (before, after))
        return float(sum(ends) @ (after.deformation - before.deformation)) / 2

    def outputs(self, state: State) -> Mapping[str, Quantity]:
        """Return pressure at the vertices, and the mean velocity of seepage in elements."""
        pressure = self.space.vertices @ self.acting(state.time)
        found = {
            "pressure": Quantity("points", pressure, "Pa"),
            "velocity": Quantity("elements", self.flux(state), "m/s"),
        }
        if self._filling is not None:
            filled = self._filling.means(self.here(state.time).unknowns)
            found["filled"] = Quantity("elements", filled, "1")
        return found

    def flux(self, state: State) -> Floats:
        """Mean velocity (E, 2) of the elements in global axes: none where pores are empty."""
        found = super().flux(state)
        if self._filling is None:
            return found
        empty = 1 - self._filling.means(self.here(state.time).unknowns)
        fall = np.stack([np.zeros_like(empty), self._conductivity * empty], axis=1)
        return found + state.frames.to_global(self.space.manifold.element_body, fall)

    def history(self, state: State) -> Mapping[str, float]:
        """Return extreme pressures (Pa), and water taken up: m3 since the start, or m3/s."""
        values = self.space.vertices @ self.acting(state.time)
        extremes = {"lowest": float(values.min()), "highest": float(values.max())}
        return {**extremes, **self.amounts(state)}


def _pore_stress(setup: Setup) -> Floats:
    """Return the stress (E, 3) that a unit of pressure takes.

    Raises
    ------
    SceneError
        Matter in plane stress that is not linear: its laws know of no stress across.
    """
    model, biot = setup.model, of_elements(setup, "biot", missing=1.0)
    for name, law in zip(setup.scene.materials, model.laws, strict=True):  # a handful of materials
        pressed = setup.scene.materials[name].biot != 0
        if model.plane == "stress" and pressed and not law.linear:
            place = setup.scene.source.place("materials", name, "law")
            value = f'"{setup.scene.materials[name].law}" with [seepage] in plane stress'
            remedy = 'use plane = "strain", or an elastic law'
            raise SceneError(Fault(place, value, "matter that is linear", remedy))
    shares = np.array([law.pore_share(model.plane) for law in model.laws])
    return np.asarray(biot[:, None] * shares[model.law])


def _bends(setup: Setup) -> bool:
    """Whether bodies bend by any angle and water in them knows how: in plane strain, one way.

    In plane stress the pores would have to know how thick the plate has become.
    """
    table = setup.scene.seepage
    assert table is not None
    return setup.kinematics.finite and not table.coupled and setup.scene.plane == "strain"


def _filling(setup: Setup, space: ScalarSpace) -> "Filling":
    """Return how far pores are filled.

    Raises
    ------
    SceneError
        A head that changes in time: where its edge is open to the air would, too.
    """
    from nmm.water.free_surface import Filling

    for one in setup.scene.heads:  # a handful
        if one.history is not None:
            place = setup.scene.source.of_name("heads", one.name, "history")
            expected = "a head that stays, with a free_surface"
            raise SceneError(Fault(place, "a history", expected, "remove it"))
    thickness = setup.model.thickness
    return Filling.of(space, thickness * of_elements(setup, "hydraulic_conductivity"))


def _held(
    setup: Setup, one: "HeadTable", filling: "Filling | None", conductivity: Floats
) -> GivenTable:
    """Return a head that is held; above the water it is that of the air, and no water falls in."""
    level: Values = partial(sloping, one, one.head - float(setup.origin[1]))
    if filling is None:
        return GivenTable("heads", one, level)

    def air(points: Floats) -> Floats:
        return np.maximum(level(points), points[:, 1])

    def empty(place: Place) -> Floats:
        assert place.normal is not None
        depth = air(place.position) - place.position[:, 1]
        filled = filling.filled(depth, place.elements)
        return -conductivity[place.elements] * (1 - filled) * place.normal[:, 1]

    return GivenTable("heads", one, air, besides=empty)


def _problem(
    setup: Setup, space: ScalarSpace, filling: "Filling | None" = None
) -> DiffusionProblem:
    """Return the equations of the head, counted from the height of the model's axes."""
    scene = setup.scene
    assert scene.seepage is not None
    stored = of_elements(setup, "specific_storage") if scene.seepage.transient else None
    conductivity = of_elements(setup, "hydraulic_conductivity")
    held = [_held(setup, one, filling, conductivity) for one in scene.heads]
    inflows = [GivenTable("inflows", one, amount=one.velocity) for one in scene.inflows]
    tables = FieldTables(
        conductivity=conductivity,
        capacity=stored,
        held=held,
        exchanges=[],
        inflows=inflows,
        sources=[],
        conductance=lambda interface: interface.leakage,
        cracks=[crack.leakage for crack in scene.cracks],
        what=LOOSE,
    )
    found = field_problem(setup, space, tables)
    if filling is None:
        return found
    from nmm.water.free_surface import FreeSurface

    surface = FreeSurface.of(found, filling)
    return surface if stored is None else _moving(setup, surface)


def _moving(setup: Setup, surface: "FreeSurface") -> DiffusionProblem:
    """Return a surface that rises and falls.

    Raises
    ------
    FormulationError
        Steps that take flows at their start: pores that are empty there say nothing of them.
    """
    from nmm.water.moving_surface import MovingSurface

    asked = setup.formulation.diffusion
    if asked is not None and asked.theta != 1:
        raise FormulationError(
            f"[diffusion] theta: {asked.theta:g} with a free_surface that is transient: expected 1"
        )
    volume = setup.model.thickness * surface.space.manifold.elements.areas
    return MovingSurface.draining(surface, volume * of_elements(setup, "drainable_porosity"))
