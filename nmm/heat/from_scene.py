"""The heat conduction problem of a scene, in temperatures above the reference."""

from functools import partial

import numpy as np

from covers.scalar.space import ScalarSpace
from integration.arrays import Floats
from nmm.diffusion.from_scene import (
    FieldTables,
    GivenTable,
    conductivities,
    field_problem,
    of_elements,
    sloping,
)
from nmm.diffusion.problem import DiffusionProblem
from nmm.effects.base import Setup

LOOSE = ("heat", "temperature", "add [[temperatures]] or [[convections]], or transient = true")


def heat_problem(setup: Setup, space: ScalarSpace) -> DiffusionProblem:
    """Return the problem of the temperature above the reference.

    Raises
    ------
    SceneError
        A table lies on no edge, or nothing determines the steady temperature of a block.
    """
    scene = setup.scene
    assert scene.heat is not None
    reference, stored = scene.heat.reference, None
    if scene.heat.transient:
        stored = of_elements(setup, "density") * of_elements(setup, "heat_capacity")
    prescribed = [
        GivenTable("temperatures", one, partial(sloping, one, one.temperature - reference))
        for one in scene.temperatures
    ]
    around = [
        GivenTable("convections", one, partial(_even, one.temperature - reference), one.coefficient)
        for one in scene.convections
    ]
    tables = FieldTables(
        conductivity=conductivities(setup, "conductivity"),
        capacity=stored,
        prescribed=prescribed,
        exchanges=around,
        inflows=[GivenTable("heat_fluxes", one, amount=one.flux) for one in scene.heat_fluxes],
        sources=[GivenTable("heat_sources", one, amount=one.power) for one in scene.heat_sources],
        conductance=lambda interface: interface.conductance,
        cracks=[crack.conductance for crack in scene.cracks],
        what=LOOSE,
    )
    return field_problem(setup, space, tables)


def _even(value: float, points: Floats) -> Floats:
    """Return one value (m,) at points (m, 2)."""
    return np.full(len(points), value)
