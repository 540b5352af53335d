"""Flow of water in the pores of blocks, and the effective stress.

By Darcy's law the hydraulic head ``h`` satisfies ``S dh/dt = div (k grad h)``. The pore pressure
``p = w (h - y)``, with the unit weight ``w`` of water, subtracts ``b p`` from the effective normal
stresses (Terzaghi 1936; Biot 1941 for ``b``), and a share of it in plane stress
(`nmm.materials.base.Law.pore_share`). `nmm.water.consolidation` adds the coupling to strain.
"""

from collections.abc import Mapping
from functools import partial
from typing import TYPE_CHECKING, Self

import numpy as np

from covers.scalar.space import ScalarSpace
from integration.arrays import Bools, Floats, Ints
from nmm.assembly.kept import kept_of_object
from nmm.assembly.state import State
from nmm.assembly.weakly import weakly
from nmm.diffusion.course import FieldCourse
from nmm.diffusion.field_effect import FieldEffect, course_of
from nmm.diffusion.field_stress import FieldStress
from nmm.diffusion.from_scene import conductivities, fitted, of_elements
from nmm.effects.base import Instant, Setup
from nmm.errors import Fault, SceneError
from nmm.quantity import Quantity
from nmm.water.head_problem import filling_of, head_problem
from nmm.water.wet_faces import total_contact

if TYPE_CHECKING:
    from nmm.water.free_surface import Filling
    from nmm.water.pore_stress import PoreStress


class PoreWater(FieldEffect):
    """Base of the effects of pore water.

    Parameters
    ----------
    course, stress, conductivity, second
        See `FieldEffect`.
    ground
        (n,) unknowns of the elevation y (m).
    weight
        Unit weight of water (N/m3).
    filling
        Saturation with a free surface; None without.
    finite
        Whether strain is finite.
    """

    _turned: "PoreStress | None" = None
    _caution = ""

    def __init__(
        self,
        course: FieldCourse,
        stress: FieldStress,
        conductivity: Floats,
        ground: Floats,
        weight: float,
        second: float = 1.0,
        filling: "Filling | None" = None,
        finite: bool = False,
    ) -> None:
        super().__init__(course, stress, conductivity, second)
        self._ground, self._weight, self._filling = ground, weight, filling
        if finite:
            from nmm.water.pore_stress import PoreStress

            self._turned = PoreStress(stress.model.finite_matter, weakly(self.stress_at))

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build from ``[seepage]``, ``[[heads]]`` and ``[[inflows]]``."""
        table = setup.scene.seepage
        assert table is not None
        space = ScalarSpace.of(setup.model.manifold)
        filling = filling_of(setup, space) if table.free_surface else None
        problem, initial = head_problem(setup, space, filling), None
        everything: Bools = np.ones(space.n, dtype=bool)
        second = 1.0 if table.duration is None else table.duration
        if table.initial is not None:
            level = table.initial - setup.origin[1]
            initial = level * space.one
            if filling is not None:
                initial = fitted(setup, space, everything, partial(filling.at_rest, level))
        ground = fitted(setup, space, everything, lambda points: points[:, 1])
        pores = _pore_stress(setup)
        stress = FieldStress(space, setup.model, pores, _pore_stress_across(setup, pores))
        course = course_of(setup, problem, initial, second)
        conductivity = conductivities(setup, "hydraulic_conductivity")
        weight = table.unit_weight
        finite = _finite(setup)
        found = cls(course, stress, conductivity, ground, weight, second, filling, finite)
        found._caution = total_contact(setup)
        return found

    @property
    def caution(self) -> str:
        """See `Effect.caution`: contact of porous blocks that knows nothing of their water."""
        return self._caution

    @property
    def turns_with_bodies(self) -> str:
        """See `Effect.turns_with_bodies`: empty in plane strain, where the stress is that of F."""
        return "" if self._turned is not None else super().turns_with_bodies

    def acting(self, time: float) -> Floats:
        """Unknowns (n,) of the pressure (Pa)."""
        return self._pressure(self.here(time).unknowns)

    @kept_of_object
    def _pressure(self, head: Floats) -> Floats:
        return self._weight * (head - self._ground)

    def pore_pressure_at(self, elements: Ints, points: Floats, time: float) -> Floats:
        return np.asarray(self.space.values(elements, points) @ self.acting(time))

    def work(self, before: State, after: State) -> float:
        """Work (J) of the mean pressure of both ends on the strain."""
        if self._turned is not None:
            return self._turned.work(before, after)
        ends = (self.force(one, Instant.of(one)) for one in (before, after))
        return float(sum(ends) @ (after.deformation - before.deformation)) / 2

    def outputs(self, state: State) -> Mapping[str, Quantity]:
        """Return pressure at vertices, mean velocity of elements, and saturation if unconfined."""
        pressure = self.space.vertices @ self.acting(state.time)
        found = {
            "pressure": Quantity("points", pressure, "Pa"),
            "velocity": Quantity("elements", self.flux(state), "m/s"),
        }
        if self._filling is not None:
            filled = self._filling.means(self.here(state.time).unknowns)
            found["filled"] = Quantity("elements", filled, "1")
        return found

    def mean_stress_across(self, state: State) -> Floats:
        """See `Effect.mean_stress_across`: that of the pressure, alike in all directions."""
        if self._turned is not None:
            return self._turned.mean(state)[:, 0]
        return super().mean_stress_across(state)

    def flux(self, state: State) -> Floats:
        """Mean seepage velocity (E, 2) in global axes, zero where unsaturated (m/s)."""
        found = super().flux(state)
        if self._filling is None:
            return found
        empty = 1 - self._filling.means(self.here(state.time).unknowns)
        fall = self._conductivity[:, :, 1] * empty[:, None]
        return found + state.frames.to_global(self.space.manifold.element_body, fall)

    def history(self, state: State) -> Mapping[str, float]:
        """Return extreme pressures (Pa), and the inflow: m3 since the start, or m3/s if steady."""
        values = self.space.vertices @ self.acting(state.time)
        extremes = {"lowest": float(values.min()), "highest": float(values.max())}
        return {**extremes, **self.amounts(state)}


def _pore_stress(setup: Setup) -> Floats:
    """Return the stress (E, 3) that a unit of pore pressure subtracts.

    Raises
    ------
    SceneError
        A nonlinear law in plane stress, which has no out-of-plane stress.
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


def _pore_stress_across(setup: Setup, pores: Floats) -> Floats | None:
    """Return what a unit of pore pressure subtracts across the plane (E,): as much as in it."""
    return None if setup.model.plane == "stress" else pores[:, 0]


def _finite(setup: Setup) -> bool:
    """Whether the pore pressure acts in finite strain: in plane strain, coupled one way.

    In plane stress it would depend on the deformed thickness.
    """
    table = setup.scene.seepage
    assert table is not None
    return setup.kinematics.finite and not table.coupled and setup.scene.plane == "strain"
