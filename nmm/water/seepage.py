"""The effect: water that seeps through blocks, and its pressure in effective stress.

With Darcy's law the head ``h`` obeys ``S dh/dt = div (k grad h)``; the pressure of the pores
``p = w (h - y)``, ``w`` the weight of water, takes ``b p`` from the total normal stresses
(Terzaghi 1936; Biot 1941 for ``b``). One way: what pores gain by strain is left out.
"""

from collections.abc import Mapping
from functools import partial
from typing import Self

import numpy as np

from covers.scalar.space import ScalarSpace
from integration.arrays import Bools, Floats
from nmm.assembly.motion import State
from nmm.diffusion.course import Course
from nmm.diffusion.field_effect import FieldEffect, course_of
from nmm.diffusion.field_stress import EVEN, FieldStress
from nmm.diffusion.from_scene import FieldTables, Given, field_problem, fitted, of_elements, sloping
from nmm.diffusion.problem import DiffusionProblem
from nmm.effects.base import Instant, Setup
from nmm.quantity import Quantity

LOOSE = ("seepage", "head", "add [[heads]], or transient = true")


class Seepage(FieldEffect):
    """Head of the water in the pores; ``ground`` (n,) are the unknowns of the height y itself."""

    name = "seepage"

    def __init__(
        self,
        course: Course,
        stress: FieldStress,
        conductivity: Floats,
        ground: Floats,
        weight: float,
        second: float = 1.0,
    ) -> None:
        super().__init__(course, stress, conductivity, second)
        self._ground, self._weight = ground, weight

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build from ``[seepage]``, ``[[heads]]`` and ``[[inflows]]``."""
        table = setup.scene.seepage
        assert table is not None
        space = ScalarSpace.of(setup.model.manifold)
        problem, initial = _problem(setup, space), None
        second = 1.0 if table.duration is None else table.duration
        if table.initial is not None:
            initial = (table.initial - setup.origin[1]) * space.one
        everything: Bools = np.ones(space.n, dtype=bool)
        ground = fitted(setup, space, everything, lambda points: points[:, 1])
        biot = of_elements(setup, "biot", missing=1.0)
        stress = FieldStress(space, setup.model, biot[:, None] * EVEN)
        course = course_of(setup, problem, initial, second)
        conductivity = of_elements(setup, "hydraulic_conductivity")
        return cls(course, stress, conductivity, ground, table.unit_weight, second)

    def acting(self, time: float) -> Floats:
        """Unknowns (n,) of the pressure (Pa)."""
        return self._weight * (self.here(time).unknowns - self._ground)

    def work(self, before: State, after: State) -> float:
        """Work (J) of the pressure on the strain of the blocks, by the mean of both ends."""
        ends = (self.force(one, Instant.of(one)) for one in (before, after))
        return float(sum(ends) @ (after.deformation - before.deformation)) / 2

    def outputs(self, state: State) -> Mapping[str, Quantity]:
        """Return pressure at the vertices, and the mean velocity of seepage in elements."""
        pressure = self.space.vertices @ self.acting(state.time)
        return {
            "pressure": Quantity("points", pressure, "Pa"),
            "velocity": Quantity("elements", self.flux(state), "m/s"),
        }

    def history(self, state: State) -> Mapping[str, float]:
        """Return extreme pressures (Pa), and water taken up: m3 since the start, or m3/s."""
        values = self.space.vertices @ self.acting(state.time)
        extremes = {"lowest": float(values.min()), "highest": float(values.max())}
        return {**extremes, **self.amounts(state)}


def _problem(setup: Setup, space: ScalarSpace) -> DiffusionProblem:
    """Return the equations of the head, counted from the height of the model's axes."""
    scene = setup.scene
    assert scene.seepage is not None
    stored = of_elements(setup, "specific_storage") if scene.seepage.transient else None
    low = float(setup.origin[1])
    held = [Given("heads", one, partial(sloping, one, one.head - low)) for one in scene.heads]
    inflows = [Given("inflows", one, amount=one.velocity) for one in scene.inflows]
    tables = FieldTables(
        conductivity=of_elements(setup, "hydraulic_conductivity"),
        capacity=stored,
        held=held,
        exchanges=[],
        inflows=inflows,
        sources=[],
        conductance=lambda interface: interface.leakage,
        cracks=[crack.leakage for crack in scene.cracks],
        what=LOOSE,
    )
    return field_problem(setup, space, tables)
